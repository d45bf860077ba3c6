//! `stiffarm papers`: printed equations and tables against what can be derived.

use std::path::{Path, PathBuf};

use stiffarm_papers::jweeg::figure;
use stiffarm_papers::{Ledger, Paper, built_in, column, read};

use crate::Verdict;
use crate::input::source;
use crate::terminal::failure::{Failure, Remark};
use crate::terminal::output::{Target, print};

const EXAMPLES: &str = "\
Examples:
  stiffarm papers                        the ledger of the five built-in papers
  stiffarm papers --report ledger.html
  stiffarm papers my_paper/*.toml        another paper's equations
  stiffarm papers --figure growth --svg growth.svg";

/// Each printed equation and table cell of a paper: agrees, misprint and its correction, reproduced
///
/// Without files, the five papers that stiffarm was built on. A file holds equations in LaTeX as
/// they are printed, and what each is an equation of.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Files of printed equations (TOML)
    files: Vec<PathBuf>,
    /// Write the ledger as Markdown to OUT (standard output if there is no OUT)
    #[arg(long, value_name = "OUT", num_args = 0..=1, default_missing_value = "-")]
    #[arg(conflicts_with_all = ["html", "json"])]
    markdown: Option<Target>,
    /// Write it as one self-contained page
    #[arg(long = "report", visible_alias = "html", value_name = "OUT.html")]
    #[arg(num_args = 0..=1, default_missing_value = "-")]
    #[arg(conflicts_with = "json")]
    html: Option<Target>,
    /// Write it as JSON
    #[arg(long, value_name = "OUT", num_args = 0..=1, default_missing_value = "-")]
    json: Option<Target>,
    /// Instead of the ledger, what a paper says of but does not show, as a table
    #[arg(long, value_enum, conflicts_with_all = ["files", "markdown", "html", "json"])]
    figure: Option<Figure>,
    /// Write the figure as a picture
    #[arg(long, value_name = "OUT", num_args = 0..=1, default_missing_value = "-")]
    #[arg(requires = "figure")]
    svg: Option<Target>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Figure {
    /// Jweeg & Al-Khafaji: how the error of the approximate kinematics grows with flexibility
    Growth,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`]: a file's mistakes, or an output that cannot be written.
pub fn run(args: &Args) -> Result<Verdict, Failure> {
    if let Some(Figure::Growth) = args.figure {
        match &args.svg {
            Some(target) => target.write(&figure::svg())?,
            None => print(&figure::table())?,
        }
        return Ok(Verdict::Good);
    }
    let papers = match args.files.as_slice() {
        [] => built_in().map_err(|error| Failure::new(error.to_string()))?,
        files => from_files(files)?,
    };
    let ledger = Ledger::with(&papers, &column);
    let (target, text) = match (&args.markdown, &args.html, &args.json) {
        (Some(target), _, _) => (target, ledger.to_markdown()),
        (_, Some(target), _) => (target, ledger.to_html()),
        (_, _, Some(target)) => (target, ledger.to_json()),
        _ => (&Target::Stdout, ledger.to_text()),
    };
    target.write(&text)?;
    Ok(Verdict::Good)
}

/// Reads every file; the mistakes of all of them are reported together.
fn from_files(files: &[PathBuf]) -> Result<Vec<Paper>, Failure> {
    let mut papers = Vec::new();
    let mut remarks = Vec::new();
    for file in files {
        match paper(file)? {
            Ok(paper) => papers.push(paper),
            Err(mistakes) => remarks.extend(mistakes),
        }
    }
    if remarks.is_empty() { Ok(papers) } else { Err(Failure::File(remarks)) }
}

fn paper(path: &Path) -> Result<Result<Paper, Vec<Remark>>, Failure> {
    let text = source::text(path)?;
    let remarks =
        |located: &stiffarm_codegen::robot::Located| Remark::located(located, &text, false);
    let read = read(&text, &path.to_string_lossy());
    Ok(read.map_err(|error| error.errors.iter().map(remarks).collect()))
}
