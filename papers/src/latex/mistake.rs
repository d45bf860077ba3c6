//! What cannot be read in a paper's file, and where.

use core::ops::Range;

use stiffarm_codegen::robot::{FileError, Located};

/// One mistake: the place, what was found and what was expected, and advice where there is any.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// Bytes of the text that was read.
    pub at: Range<usize>,
    /// What was found and what was expected.
    pub message: String,
    /// How to mend it, where that is known.
    pub help: Option<String>,
}

impl Mistake {
    /// A mistake at a place.
    pub fn new(at: Range<usize>, message: impl Into<String>) -> Self {
        Mistake { at, message: message.into(), help: None }
    }

    /// The same with advice.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// The same mistake in a text in which the one that was read begins at `offset`.
    pub fn moved(mut self, offset: usize) -> Self {
        self.at = self.at.start + offset..self.at.end + offset;
        self
    }

    /// With the file's name, line and column.
    pub fn located(self, path: &str, text: &str) -> Located {
        let boundary =
            |at: usize| (0..=at.min(text.len())).rev().find(|i| text.is_char_boundary(*i));
        let start = boundary(self.at.start).unwrap_or(0);
        let stop = boundary(self.at.end).unwrap_or(0).max(start);
        let line_start = text[..start].rfind('\n').map_or(0, |i| i + 1);
        Located {
            path: path.to_owned(),
            span: start..stop,
            line: text[..start].matches('\n').count() + 1,
            column: text[line_start..start].chars().count() + 1,
            source: text[line_start..].lines().next().unwrap_or_default().to_owned(),
            message: self.message,
            help: self.help,
        }
    }
}

/// All mistakes of a file, in the order in which they stand.
pub(crate) fn file_error(path: &str, text: &str, mut mistakes: Vec<Mistake>) -> FileError {
    mistakes.sort_by_key(|m| (m.at.start, m.at.end));
    mistakes.dedup();
    FileError {
        path: path.to_owned(),
        text: text.to_owned(),
        errors: mistakes.into_iter().map(|m| m.located(path, text)).collect(),
        warnings: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistake_points_at_its_character() {
        let text = "latex = 'é +'\n";
        let mistake = Mistake::new(1..2, "no").help("write one").moved(11);
        let shown = mistake.located("a.toml", text).to_string();
        assert!(shown.starts_with("a.toml:1:12: no\n1 | latex"), "{shown}");
        assert!(shown.ends_with("^\nhelp: write one"), "{shown}");
        assert_eq!(Mistake::new(90..95, "end").located("x", "ab").column, 3);
    }
}
