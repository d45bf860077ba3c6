//! Mistakes of a robot file, located: file, line, column, the line itself, and advice.

use core::fmt;
use core::ops::Range;

use super::model::Spot;
use super::problem::{Problem, Report};

/// One remark on a robot file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Located {
    /// The file's name, as given to the reader.
    pub path: String,
    /// The bytes of the file that the remark is about.
    pub span: Range<usize>,
    /// The line of the first of them, from 1.
    pub line: usize,
    /// Its column in characters, from 1.
    pub column: usize,
    /// The text of that line.
    pub source: String,
    /// What was found and what was expected.
    pub message: String,
    /// How to mend it, where that is known.
    pub help: Option<String>,
}

/// Something in a robot file that is used as written but is probably not meant.
pub type Warning = Located;

/// A robot file that cannot be read: every mistake in it, in the order in which they stand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileError {
    /// The file's name, as given to the reader.
    pub path: String,
    /// The file's text, into which the spans point.
    pub text: String,
    /// At least one mistake.
    pub errors: Vec<Located>,
    /// What else is doubtful in the file.
    pub warnings: Vec<Warning>,
}

impl Located {
    /// A remark on what stands at a place of a file.
    pub fn at(path: &str, text: &str, spot: &Spot, message: String, help: Option<String>) -> Self {
        let problem = Problem { help, ..Problem::new(spot.span.clone(), message) };
        Located::new(path, text, problem)
    }

    /// A mistake where it stands.
    pub fn new(path: &str, text: &str, problem: Problem<Range<usize>>) -> Self {
        let end = text.len();
        let start = floor_boundary(text, problem.at.start.min(end));
        let stop = floor_boundary(text, problem.at.end.clamp(start, end));
        let line_start = text[..start].rfind('\n').map_or(0, |i| i + 1);
        let source = text[line_start..].lines().next().unwrap_or_default();
        Located {
            path: path.to_owned(),
            span: start..stop,
            line: text[..start].matches('\n').count() + 1,
            column: text[line_start..start].chars().count() + 1,
            source: source.to_owned(),
            message: problem.message,
            help: problem.help,
        }
    }

    /// A remark on a file as a whole.
    pub fn on_file(path: &str, text: &str, message: &str) -> Self {
        Located::new(path, text, Problem::new(0..0, message))
    }

    /// Sorted by place. The same remark twice is one, and so is what one habit has made many times: it is told at its
    /// first place, with the lines of the others.
    pub(crate) fn all(
        path: &str,
        text: &str,
        mut problems: Vec<Problem<Range<usize>>>,
    ) -> Vec<Self> {
        problems.sort_by_key(|p| (p.at.start, p.at.end));
        let mut told: Vec<(&str, Located, Vec<usize>)> = Vec::new();
        for problem in problems {
            let cause = problem.cause;
            let new = Located::new(path, text, problem);
            let same = |(known, first, _): &&mut (&str, Located, _)| match cause {
                "" => {
                    known.is_empty() && (&first.message, &first.help) == (&new.message, &new.help)
                }
                cause => *known == cause,
            };
            match told.iter_mut().find(same) {
                Some((_, first, lines)) if first.line != new.line => lines.push(new.line),
                Some(_) => {}
                None => told.push((cause, new, Vec::new())),
            }
        }
        told.into_iter().map(|(_, first, lines)| first.repeated(lines)).collect()
    }

    /// The same remark on further lines.
    fn repeated(mut self, mut lines: Vec<usize>) -> Self {
        lines.dedup();
        let numbers: Vec<String> = lines.iter().map(usize::to_string).collect();
        if let Some((last, before)) = numbers.split_last() {
            let lines = match before.is_empty() {
                true => format!("line {last}"),
                false => format!("lines {} and {last}", before.join(", ")),
            };
            let help = self.help.take().map(|help| help + "; ").unwrap_or_default();
            self.help = Some(format!("{help}the same stands in {lines}"));
        }
        self
    }
}

/// The last character boundary at or before a byte.
fn floor_boundary(text: &str, at: usize) -> usize {
    (0..=at).rev().find(|i| text.is_char_boundary(*i)).unwrap_or(0)
}

impl FileError {
    pub(crate) fn new(path: &str, text: &str, report: Report<Range<usize>>) -> Self {
        FileError {
            path: path.to_owned(),
            text: text.to_owned(),
            errors: Located::all(path, text, report.errors),
            warnings: Located::all(path, text, report.warnings),
        }
    }
}

impl fmt::Display for Located {
    /// `file:line:column: message`, the line with a caret under the place, and `help: …`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}:{}:{}: {}", self.path, self.line, self.column, self.message)?;
        let number = self.line.to_string();
        writeln!(f, "{number} | {}", self.source)?;
        // Tabs stay tabs, so that the caret stands under its place whatever their width.
        let before = self.source.chars().take(self.column - 1);
        let margin: String = before.map(|c| if c == '\t' { '\t' } else { ' ' }).collect();
        let marked = self.source.chars().skip(self.column - 1).scan(0, |bytes, c| {
            *bytes += c.len_utf8();
            Some(*bytes)
        });
        let width = marked.take_while(|bytes| *bytes <= self.span.len()).count().max(1);
        write!(f, "{} | {margin}{}", " ".repeat(number.len()), "^".repeat(width))?;
        if let Some(help) = &self.help {
            write!(f, "\nhelp: {help}")?;
        }
        Ok(())
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, error) in self.errors.iter().enumerate() {
            if i > 0 {
                f.write_str("\n")?;
            }
            error.fmt(f)?;
        }
        Ok(())
    }
}

impl core::error::Error for Located {}
impl core::error::Error for FileError {}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "name = \"é\"\n\ta = \"350 kg\"\n";

    #[test]
    fn a_remark_shows_its_place() {
        let at = TEXT.find("350").unwrap();
        let problem = Problem::new(at..at + 6, "no length").help("use mm");
        let located = Located::new("arm.toml", TEXT, problem);
        assert_eq!((located.line, located.column), (2, 7));
        assert_eq!(
            located.to_string(),
            "arm.toml:2:7: no length\n2 | \ta = \"350 kg\"\n  | \t     ^^^^^^\nhelp: use mm"
        );
    }

    #[test]
    fn columns_count_characters_and_places_are_clamped() {
        let after = Located::new("x", TEXT, Problem::new(10..11, "after é"));
        assert_eq!((after.line, after.column), (1, 10));
        let within = Located::new("x", TEXT, Problem::new(9..9, "within é"));
        assert_eq!(within.span, 8..8);
        let beyond = Located::new("x", "ab", Problem::new(7..9, "beyond"));
        assert_eq!((beyond.line, beyond.column, beyond.span), (1, 3, 2..2));
        assert_eq!(Located::new("x", "", Problem::new(0..0, "empty")).line, 1);
    }

    #[test]
    fn errors_are_sorted() {
        let mut report = Report::new();
        report.error(Problem::new(13..14, "second"));
        report.error(Problem::new(0..4, "first"));
        let error = FileError::new("arm.toml", TEXT, report);
        assert_eq!(error.errors[0].message, "first");
        let shown = error.to_string();
        assert!(shown.starts_with("arm.toml:1:1: first\n1 | name"), "{shown}");
        assert!(shown.contains("\narm.toml:2:2: second\n"), "{shown}");
    }
}
