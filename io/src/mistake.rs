//! What can be wrong with a file: each mistake has a place, and says what was found, what was expected and
//! how to mend it.

use core::fmt;

/// A file that could not be read, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadError {
    /// The file as it was named.
    pub file: String,
    /// At most [`MOST_MISTAKES`], in the order of the file.
    pub mistakes: Vec<Mistake>,
    /// How many more there are.
    pub more: usize,
}

/// Mistakes that one reading reports; the rest are counted.
pub const MOST_MISTAKES: usize = 20;

/// One mistake: where it stands and what it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Mistake {
    /// Line of the file, from 1; `None` where the whole file is meant, or a file that has no lines.
    pub line: Option<u64>,
    /// Column of the table; `None` where the whole line or file is meant.
    pub column: Option<Column>,
    /// What was found, what was expected, how to mend it.
    pub fault: Fault,
}

/// A column of the table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// From 1.
    pub number: usize,
    /// As its header has it, unit included; empty if that is not known.
    pub header: String,
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// What was found.
    pub found: String,
    /// What was expected; empty where what was found says it.
    pub expected: Box<str>,
    /// How to mend it; empty where what was expected says it.
    pub help: Box<str>,
    /// Whether a reading is missing, and nothing is wrong with the others.
    pub is_hole: bool,
}

impl Fault {
    /// What was found, what was expected, how to mend it.
    pub fn new(
        found: impl Into<String>,
        expected: impl Into<Box<str>>,
        help: impl Into<Box<str>>,
    ) -> Fault {
        let (found, expected, help) = (found.into(), expected.into(), help.into());
        Fault { found, expected, help, is_hole: false }
    }

    /// A reading that is missing.
    pub fn hole(
        found: impl Into<String>,
        expected: impl Into<Box<str>>,
        help: impl Into<Box<str>>,
    ) -> Fault {
        Fault { is_hole: true, ..Fault::new(found, expected, help) }
    }

    /// A row that is not as long as the header.
    pub fn ragged(found: usize, expected: usize) -> Fault {
        let help = match found > expected {
            true => "remove the surplus (a decimal comma makes one: write 1.5, not 1,5)",
            false => "add the missing",
        };
        Fault::new(format!("{found} cells"), format!("{expected} as in the header"), help)
    }

    /// A kind of file that only a feature of the build reads.
    pub fn not_built(kind: &str, feature: &str) -> Fault {
        let help = format!(
            "this build of stiffarm reads no other, and one with the feature `{feature}` does: cargo \
             install --path cli --features {feature}"
        );
        Fault::new(kind, "text", help)
    }

    /// In this line, and in this column of it.
    pub fn at(self, line: u64, column: Option<Column>) -> Mistake {
        self.within(Some(line), column)
    }

    /// The same where a file may have no lines.
    pub fn within(self, line: Option<u64>, column: Option<Column>) -> Mistake {
        Mistake { line, column, fault: self }
    }

    /// The only one of a file, as a whole.
    pub fn of(self, file: &str) -> ReadError {
        Mistake::from(self).of(file)
    }
}

impl From<Fault> for Mistake {
    /// Of a whole file.
    fn from(fault: Fault) -> Mistake {
        Mistake { line: None, column: None, fault }
    }
}

impl Mistake {
    /// The only one of a file.
    pub fn of(self, file: &str) -> ReadError {
        ReadError { file: file.to_owned(), mistakes: vec![self], more: 0 }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "found {}", self.found)?;
        if !self.expected.is_empty() {
            write!(f, ", expected {}", self.expected)?;
        }
        if !self.help.is_empty() {
            write!(f, ": {}", self.help)?;
        }
        Ok(())
    }
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let line = self.line.map(|line| format!("line {line}"));
        let column = self.column.as_ref().map(|c| match c.header.as_str() {
            "" => format!("column {}", c.number),
            header => format!("column {} `{header}`", c.number),
        });
        let place: Vec<String> = line.into_iter().chain(column).collect();
        if !place.is_empty() {
            write!(f, "{}: ", place.join(", "))?;
        }
        write!(f, "{}", self.fault)
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let each = self.mistakes.iter().map(ToString::to_string);
        let rest = (self.more > 0).then(|| format!("and {} more mistakes", self.more));
        let lines: Vec<String> =
            each.chain(rest).map(|told| format!("{}: {told}", self.file)).collect();
        f.write_str(&lines.join("\n"))
    }
}

impl core::error::Error for ReadError {}

/// Collects mistakes up to the limit.
#[derive(Debug, Default)]
pub struct Mistakes {
    kept: Vec<Mistake>,
    more: usize,
}

impl Extend<Mistake> for Mistakes {
    fn extend<T: IntoIterator<Item = Mistake>>(&mut self, mistakes: T) {
        for mistake in mistakes {
            if self.kept.len() < MOST_MISTAKES {
                self.kept.push(mistake);
            } else {
                self.more += 1;
            }
        }
    }
}

impl Mistakes {
    /// Notes one more.
    pub fn add(&mut self, mistake: Mistake) {
        self.extend([mistake]);
    }

    /// Whether none was noted.
    pub fn is_empty(&self) -> bool {
        self.kept.is_empty()
    }

    /// An error of `file` if any was noted.
    pub fn check(self, file: &str) -> Result<(), ReadError> {
        let Mistakes { kept: mut mistakes, more } = self;
        if mistakes.is_empty() {
            return Ok(());
        }
        mistakes.sort_by_key(|m| (m.line, m.column.as_ref().map_or(0, |c| c.number)));
        Err(ReadError { file: file.to_owned(), mistakes, more })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistake_names_file_line_and_column() {
        let mut mistakes = Mistakes::default();
        let column = Column { number: 3, header: "q3[deg]".to_owned() };
        mistakes.add(Fault::new("`2`", "1", "").at(7, Some(column)));
        mistakes.add(Fault::new("no rows", "", "add them").at(2, None));
        mistakes.add(Fault::new("a folder", "a file", "").into());
        let text = mistakes.check("run.csv").unwrap_err().to_string();
        let expected = "run.csv: found a folder, expected a file\n\
                        run.csv: line 2: found no rows: add them\n\
                        run.csv: line 7, column 3 `q3[deg]`: found `2`, expected 1";
        assert_eq!(text, expected);
    }

    #[test]
    fn the_rest_are_counted() {
        let mut mistakes = Mistakes::default();
        mistakes.extend((0..25).map(|line| Fault::new("nothing", "", "").at(line, None)));
        let text = mistakes.check("a").unwrap_err().to_string();
        assert_eq!(text.lines().count(), MOST_MISTAKES + 1);
        assert!(text.ends_with("a: and 5 more mistakes"), "{text}");
    }
}
