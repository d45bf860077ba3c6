//! What keeps a command from its work, and how it is said: a sentence and advice, or the mistakes of
//! a file, each at its place.

use std::fmt;
use std::io::Write as _;
use std::path::Path;

use console::{Term, style};
use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, Severity,
    SourceCode,
};
use stiffarm_codegen::robot::Located;

/// Why a command could not do its work: exit status 2.
#[derive(Debug)]
pub enum Failure {
    /// A sentence, and advice where there is some.
    Plain {
        /// What was found and what was expected.
        message: String,
        /// How to mend it.
        help: Option<String>,
    },
    /// The mistakes of a file.
    File(Vec<Remark>),
}

/// Something to say about a place in a file.
#[derive(Debug)]
pub struct Remark {
    message: String,
    help: Option<String>,
    severity: Severity,
    source: Option<NamedSource<String>>,
    span: Option<LabeledSpan>,
}

impl Failure {
    /// A sentence without advice.
    pub fn new(message: impl Into<String>) -> Failure {
        Failure::Plain { message: message.into(), help: None }
    }

    /// A sentence with advice.
    pub fn with_help(message: impl Into<String>, help: impl Into<String>) -> Failure {
        Failure::Plain { message: message.into(), help: Some(help.into()) }
    }

    /// A file that could not be read or written.
    pub fn io(doing: &str, path: &Path, error: &std::io::Error) -> Failure {
        Failure::new(format!("cannot {doing} {}: {}", path.display(), reason(error)))
    }

    /// Prints it to standard error; where that is closed there is no one to tell.
    pub fn print(&self) {
        let text = match self {
            Failure::Plain { message, help } => {
                let head = style("error:").for_stderr().red().bold();
                let advice = help.as_ref().map_or_else(String::new, |help| {
                    format!("{} {help}\n", style(" help:").for_stderr().cyan())
                });
                format!("{head} {message}\n{advice}")
            }
            Failure::File(remarks) => remarks.iter().map(Remark::render).collect(),
        };
        let _ = std::io::stderr().write_all(text.as_bytes());
    }
}

/// What the system says, without its number.
pub fn reason(error: &std::io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or_default().to_lowercase()
}

impl Remark {
    /// A mistake in `text`, the content of `file`, at some of its bytes; without a snippet if the
    /// text has no such place.
    pub fn error(
        message: String,
        help: Option<String>,
        file: &str,
        text: &str,
        span: Option<std::ops::Range<usize>>,
    ) -> Remark {
        let span = span.filter(|s| s.start < text.len() && s.end <= text.len());
        let source = span.as_ref().map(|_| NamedSource::new(file, text.to_owned()));
        let span = span.map(|s| LabeledSpan::new_primary_with_span(None, s));
        Remark { message, help, severity: Severity::Error, source, span }
    }

    /// A remark of the robot file's reader.
    pub fn located(located: &Located, text: &str, severity: Severity) -> Remark {
        let Located { path, span, line, column, message, help, .. } = located;
        let shown = located.source.chars().count() <= LONGEST;
        let at = Some(span.clone()).filter(|_| shown);
        let mut remark = Remark::error(message.clone(), help.clone(), path, text, at);
        if remark.span.is_none() {
            remark.message = format!("{path}: line {line}, column {column}: {message}");
        }
        Remark { severity, ..remark }
    }

    fn render(&self) -> String {
        let theme = match console::colors_enabled_stderr() {
            true => GraphicalTheme::unicode(),
            false => GraphicalTheme::unicode_nocolor(),
        };
        let term = Term::stderr();
        let handler = GraphicalReportHandler::new_themed(theme).with_context_lines(1);
        let handler = match term.size_checked().filter(|_| term.is_term()) {
            Some((_, width)) => handler.with_width(usize::from(width).clamp(40, 120)),
            None => handler.with_wrap_lines(false),
        };
        let mut text = String::new();
        match handler.render_report(&mut text, self) {
            Ok(()) => text,
            Err(fmt::Error) => format!("{}\n", self.message),
        }
    }

    /// Prints a warning to standard error.
    pub fn print(&self) {
        let _ = std::io::stderr().write_all(self.render().as_bytes());
    }
}

/// Lines longer than this are not shown.
pub const LONGEST: usize = 300;

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Remark {}

impl Diagnostic for Remark {
    fn severity(&self) -> Option<Severity> {
        Some(self.severity)
    }

    fn help(&self) -> Option<Box<dyn fmt::Display + '_>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.span.as_ref().map(|span| Box::new(std::iter::once(span.clone())) as Box<_>)
    }
}
