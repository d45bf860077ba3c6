//! What keeps a command from its work, and how it is said: a sentence and advice, or the mistakes
//! of a file, each at its place.

use std::io::{ErrorKind, Write as _};
use std::ops::Range;
use std::path::Path;

use annotate_snippets::{AnnotationKind, Element, Level, Renderer, Snippet};
use console::style;
use stiffarm_codegen::robot::Located;
use stiffarm_document::text::clipped;

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
    /// What was found and what was expected.
    pub message: String,
    /// How to mend it.
    pub help: Option<String>,
    /// Used as it is, but probably not meant.
    doubt: bool,
    /// The file's name, its text, and the bytes that are meant.
    place: Option<(String, String, Range<usize>)>,
}

impl Failure {
    /// A sentence without advice.
    pub fn new(message: impl Into<String>) -> Failure {
        Failure::Plain { message: clipped(&message.into()), help: None }
    }

    /// A sentence with advice.
    pub fn with_help(message: impl Into<String>, help: impl Into<String>) -> Failure {
        Failure::Plain { message: clipped(&message.into()), help: Some(help.into()) }
    }

    /// A file that could not be read or written.
    pub fn io(doing: &str, path: &Path, error: &std::io::Error) -> Failure {
        Failure::new(format!("cannot {doing} {}: {}", path.display(), reason(error)))
    }

    /// Prints it to standard error; where that is closed there is no one to tell.
    pub fn print(&self) {
        let _ = std::io::stderr().write_all(self.text().as_bytes());
    }

    /// All of it, as it is printed.
    pub fn text(&self) -> String {
        match self {
            Failure::Plain { message, help } => {
                let blue = |text| style(text).for_stderr().blue().bright().bold();
                let head = style("error").for_stderr().red().bright().bold();
                let advice = help.as_ref().map_or_else(String::new, |help| {
                    format!("  {} {}: {help}\n", blue("="), style("help").for_stderr().bold())
                });
                format!("{head}: {message}\n{advice}")
            }
            Failure::File(remarks) => {
                remarks.iter().map(Remark::text).collect::<Vec<_>>().join("\n")
            }
        }
    }
}

/// Errors of the libraries, whose sentences say all: each is a failure as it is.
macro_rules! plain {
    ($($error:ty),+ $(,)?) => {$(
        impl From<$error> for Failure {
            fn from(error: $error) -> Failure {
                Failure::new(error.to_string())
            }
        }
    )+};
}

plain!(
    stiffarm_codegen::emit::SymbolicTable,
    stiffarm_study::dexterity::DexterityError,
    stiffarm_study::dexterity::design::SuspectError,
    stiffarm_document::PageError,
    stiffarm_gap::diagnose::DiagnoseError,
    stiffarm_study::excite::ExciteError,
    stiffarm_gap::identify::measured::MeasuredError,
    stiffarm_gap::io::ReadError,
    stiffarm_gap::log::Refused,
    stiffarm_plant::course::LimitsError,
    stiffarm_plant::PlantError,
    stiffarm_plant::TruthError,
    stiffarm_plant::motion::MotionError,
    stiffarm_gap::robot::RobotError,
    stiffarm_study::withhold::WithholdError,
);

/// What the system says, in words.
pub fn reason(error: &std::io::Error) -> String {
    let known = match error.kind() {
        ErrorKind::NotFound => "no such file or folder",
        ErrorKind::PermissionDenied => "permission denied",
        ErrorKind::IsADirectory => "it is a folder",
        ErrorKind::NotADirectory => "part of the path is no folder",
        ErrorKind::StorageFull => "no space left",
        ErrorKind::ReadOnlyFilesystem => "the file system is read-only",
        _ => return error.to_string(),
    };
    known.to_owned()
}

/// Lines longer than this are not shown.
pub const LONGEST: usize = 300;

impl Remark {
    /// A mistake in `text`, the content of `file`, at some of its bytes; where the text has no such
    /// place the message names the file.
    pub fn error(
        message: String,
        help: Option<String>,
        file: &str,
        text: &str,
        span: Option<Range<usize>>,
    ) -> Remark {
        let span = span.filter(|s| s.start < text.len() && s.end <= text.len());
        let message = clipped(&message);
        let message = if span.is_some() { message } else { format!("{file}: {message}") };
        let place = span.map(|span| (file.to_owned(), text.to_owned(), span));
        Remark { message, help, doubt: false, place }
    }

    /// A remark of the robot file's reader: a mistake, or a doubt.
    pub fn located(located: &Located, text: &str, doubt: bool) -> Remark {
        let Located { path, line, column, message, .. } = located;
        let shown = located.source.chars().count() <= LONGEST && located.span.start < text.len();
        let (span, message) = match shown {
            true => (Some(located.span.clone()), message.clone()),
            false => (None, format!("line {line}, column {column}: {message}")),
        };
        Remark { doubt, ..Remark::error(message, located.help.clone(), path, text, span) }
    }

    /// File, line and column (from 1), where it is about a place in one.
    pub fn place(&self) -> Option<(&str, usize, usize)> {
        let (file, text, span) = self.place.as_ref()?;
        let before = text.get(..span.start)?;
        let line = before.rsplit('\n').next().unwrap_or_default();
        Some((file, before.matches('\n').count() + 1, line.chars().count() + 1))
    }

    /// As it is printed.
    pub(crate) fn text(&self) -> String {
        let level = if self.doubt { Level::WARNING } else { Level::ERROR };
        let mut group = level.primary_title(&self.message).elements(None::<Element<'_>>);
        if let Some((file, text, span)) = &self.place {
            let meant = AnnotationKind::Primary.span(span.clone());
            group = group.element(Snippet::source(text).path(file).annotation(meant));
        }
        if let Some(help) = &self.help {
            group = group.element(Level::HELP.message(help));
        }
        let renderer = match console::colors_enabled_stderr() {
            true => Renderer::styled(),
            false => Renderer::plain(),
        };
        renderer.render(&[group]) + "\n"
    }
}
