//! What went wrong, in one line.

use datafusion::error::DataFusionError;
use stiffarm_cli::Failure;

/// A command's failure in one line: what was found and expected, where, and what mends it.
pub fn sentence(failure: &Failure) -> String {
    match failure {
        Failure::Plain { message, help } => with_help(message, help.as_deref()),
        Failure::File(remarks) => {
            let each = remarks.iter().map(|remark| {
                let said = with_help(&remark.message, remark.help.as_deref());
                match remark.place() {
                    Some((file, line, column)) => format!("{file}:{line}:{column}: {said}"),
                    None => said,
                }
            });
            each.collect::<Vec<_>>().join("; ")
        }
    }
}

fn with_help(message: &str, help: Option<&str>) -> String {
    let said = help.map_or_else(|| message.to_owned(), |help| format!("{message}; {help}"));
    said.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The engine's error in one line, without the layers that passed it on.
pub fn of_engine(error: &DataFusionError) -> String {
    let text = error.find_root().strip_backtrace();
    let mut text = text.trim();
    // A cluster passes errors on as text, a prefix for each of its parts.
    for prefix in ["Execution error: ", "External error: ", "Error during planning: "] {
        text = text.strip_prefix(prefix).unwrap_or(text);
    }
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
