//! What can be wrong with a measurement file: each mistake has a place and its own message.

use std::fmt;

use super::unit::Dimension;

/// A measurement file that could not be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file could not be opened or read at all.
    #[error("{file}: {source}: expected a measurement file (CSV)")]
    Open {
        /// The file as it was named.
        file: String,
        /// What the system says.
        source: std::io::Error,
    },
    /// The file was read, and is wrong in these places.
    #[error("{}", listing(file, mistakes, *more))]
    Mistakes {
        /// The file as it was named.
        file: String,
        /// At most [`MOST_MISTAKES`], in the order of the file.
        mistakes: Vec<Mistake>,
        /// How many more there are.
        more: usize,
    },
}

/// Mistakes that one reading reports; the rest are counted.
pub const MOST_MISTAKES: usize = 20;

/// One mistake: where it stands and what it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Mistake {
    /// Line of the file, from 1.
    pub line: u64,
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

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}", self.line)?;
        match &self.column {
            Some(c) if c.header.is_empty() => write!(f, ", column {}", c.number)?,
            Some(c) => write!(f, ", column {} `{}`", c.number, c.header)?,
            None => {}
        }
        write!(f, ": {}", self.fault)
    }
}

fn listing(file: &str, mistakes: &[Mistake], more: usize) -> String {
    let mut lines: Vec<String> = mistakes.iter().map(|m| format!("{file}: {m}")).collect();
    if more > 0 {
        lines.push(format!("{file}: and {more} more mistakes"));
    }
    lines.join("\n")
}

/// Collects mistakes up to the limit.
#[derive(Debug, Default)]
pub(crate) struct Mistakes {
    kept: Vec<Mistake>,
    more: usize,
}

impl Mistakes {
    pub(crate) fn add(&mut self, line: u64, column: Option<Column>, fault: Fault) {
        self.extend([Mistake { line, column, fault }]);
    }

    pub(crate) fn extend(&mut self, mistakes: impl IntoIterator<Item = Mistake>) {
        for mistake in mistakes {
            if self.kept.len() < MOST_MISTAKES {
                self.kept.push(mistake);
            } else {
                self.more += 1;
            }
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.kept.is_empty()
    }

    pub(crate) fn into_error(self, file: &str) -> ReadError {
        let Mistakes { mut kept, more } = self;
        kept.sort_by_key(|m| (m.line, m.column.as_ref().map_or(0, |c| c.number)));
        ReadError::Mistakes { file: file.to_owned(), mistakes: kept, more }
    }
}

fn suggest(suggestion: Option<&str>) -> String {
    suggestion.map_or_else(String::new, |s| format!("; did you mean `{s}`?"))
}

fn known_names(table: &str, names: &[String]) -> String {
    if names.is_empty() {
        format!("the robot file has no [[{table}]]")
    } else {
        format!("the robot file has {}", names.join(", "))
    }
}

/// What is wrong: found, expected, how to mend it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the message beside each variant and field says what it is")]
pub enum Fault {
    #[error("found byte 0x{byte:02x}, expected UTF-8 text: save the file as UTF-8")]
    NotUtf8 { byte: u8 },
    #[error("found a UTF-16 byte order mark, expected UTF-8 text: save the file as UTF-8")]
    Utf16,
    #[error(
        "found nothing, expected a header row: begin with one such as `q1[deg],q2[deg],dz[mm]`"
    )]
    EmptyFile,
    #[error(
        "found the number `{found}`, expected a header row: name the columns in the first row, \
         such as `q1[deg],q2[deg],dz[mm]`"
    )]
    HeaderMissing { found: String },
    #[error("found columns separated by {separator}, expected commas: export with commas")]
    Separator { separator: &'static str },
    #[error(
        "found no name, expected `name` or `name[unit]`: name the column or remove it \
         (a trailing comma makes one)"
    )]
    NoName,
    #[error("found `{found}`, expected `name` or `name[unit]`: mend the brackets")]
    Brackets { found: String },
    #[error("`{name}` stands in column {first} already: remove or rename one of the two")]
    Repeated { name: String, first: usize },
    #[error(
        "found the unknown unit `{found}`, expected one of {}{}", expected.units(),
        suggest(*suggestion)
    )]
    UnknownUnit { found: String, expected: Dimension, suggestion: Option<&'static str> },
    #[error(
        "found `{found}`, the unit of {is}, expected {expected}: write one of {}",
        expected.units()
    )]
    WrongUnit { found: String, is: Dimension, expected: Dimension },
    #[error("found the unit `{found}`, expected none: write `{name}`")]
    UnitOnPlain { name: String, found: String },
    #[error(
        "found joint number {found}, expected {}: joints are numbered from 1 at the base, \
         without leading zeros",
        if *joints == 1 { "1".to_owned() } else { format!("1 to {joints}") }
    )]
    UnknownJoint { found: String, joints: usize },
    #[error(
        "found no column {missing}, expected a reading of every joint: add it{}",
        suggestion.as_ref().map_or_else(String::new, |s| format!(
            " (`{s}` is not it: names are case-sensitive and exact)"
        ))
    )]
    MissingJoint { missing: String, suggestion: Option<String> },
    #[error(
        "found no measured column, expected any of `x y z` (a position), any of \
         `dx dy dz drx dry drz` (a displacement) or `distance`: add what was measured"
    )]
    NothingMeasured,
    #[error(
        "found both {is} (`{found}`) and {other_is} (`{other}`) that were measured, expected one \
         kind: split the file in two"
    )]
    TwoKinds { found: String, is: &'static str, other: String, other_is: &'static str },
    #[error(
        "found `{found}` without {missing}, expected all of x, y, z beside an orientation: it is \
         that of the tool at a position"
    )]
    PositionIncomplete { found: String, missing: String },
    #[error(
        "found `{found}` without {missing}, expected all of {all} or none: an orientation is a \
         rotation vector with three components"
    )]
    OrientationIncomplete { found: String, missing: String, all: &'static str },
    #[error(
        "found `{found}`, {is}, in a file that measures {measures}, expected `{expected}`: \
         predict what is measured"
    )]
    SimOfOtherKind { found: String, is: &'static str, measures: &'static str, expected: String },
    #[error(
        "found `{found}` without {missing}, expected all of from_x, from_y, from_z or none: the \
         point from which a distance is measured has three coordinates"
    )]
    FromIncomplete { found: String, missing: String },
    #[error(
        "found `{found}` in a file that measures no distance, expected a column `distance`: add it, \
         or remove the point"
    )]
    FromWithout { found: String },
    #[error(
        "found both a point's name (`from`) and its place (`{found}`), expected one of them: a point \
         with a name alone is fitted"
    )]
    FromTwice { found: String },
    #[error(
        "found session `{found}` again, expected another: its rows end in line {ended}: bring the \
         rows of a session together, in the order of measuring, or give what was measured later \
         another name"
    )]
    SessionAgain { found: String, ended: u64 },
    #[error("found {found}, expected a distance: it is not below zero")]
    Negative { found: String },
    #[error(
        "found the unknown payload `{found}`, {}{}: name one of them, or `none`, or add it to the \
         robot file",
        known_names("payload", known), suggest(suggestion.as_deref())
    )]
    UnknownPayload { found: String, known: Vec<String>, suggestion: Option<String> },
    #[error(
        "found no rows, expected at least one measurement below the header: add the measurements"
    )]
    NoRows,
    #[error(
        "found more than {} rows, expected no more: thin the file out, or split it",
        super::MOST_ROWS
    )]
    TooManyRows,
    #[error(
        "found {found} cells, expected {expected} as in the header: {}",
        if found > expected {
            "remove the surplus (a decimal comma makes one: write 1.5, not 1,5)"
        } else {
            "add the missing"
        }
    )]
    Ragged { found: usize, expected: usize },
    #[error("found an empty row of commas, expected a measurement: remove the row")]
    EmptyRow,
    #[error("found an empty cell, expected {expected}: fill it in, or remove the row")]
    EmptyCell { expected: String },
    #[error(
        "found `{found}`, expected {expected}: write a plain number{}",
        if found.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) {
            "; a unit belongs in the header, `name[unit]`"
        } else {
            ""
        }
    )]
    NotANumber { found: String, expected: String },
    #[error("found `{found}`, a decimal comma: write 1.5, not 1,5")]
    DecimalComma { found: String },
    #[error("found `{found}`, not a number, expected {expected}: remove the row or measure again")]
    Nan { found: String, expected: String },
    #[error("found `{found}`, infinity, expected {expected}: remove the row or measure again")]
    Infinity { found: String, expected: String },
    #[error("found `{found}`, too large for a double, expected {expected}: mend the exponent")]
    TooLarge { found: String, expected: String },
    #[error(
        "found `{found}`, expected -1, 0 or 1: the direction from which the joint came to rest"
    )]
    Direction { found: String },
    #[error(
        "found the unknown marker `{found}`, {}{}: name one of them or add it to the robot file",
        known_names("marker", known), suggest(suggestion.as_deref())
    )]
    UnknownMarker { found: String, known: Vec<String>, suggestion: Option<String> },
}

impl Fault {
    /// Whether a reading is missing, and nothing is wrong with the others.
    pub(crate) fn is_hole(&self) -> bool {
        matches!(self, Fault::EmptyCell { .. } | Fault::Nan { .. } | Fault::EmptyRow)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistake_names_file_line_and_column() {
        let mut mistakes = Mistakes::default();
        let column = Column { number: 3, header: "q3[deg]".to_owned() };
        mistakes.add(7, Some(column), Fault::Direction { found: "2".to_owned() });
        mistakes.add(2, None, Fault::NoRows);
        let text = mistakes.into_error("run.csv").to_string();
        let lines: Vec<_> = text.lines().collect();
        assert!(lines[0].starts_with("run.csv: line 2: found no rows"), "{text}");
        assert!(lines[1].starts_with("run.csv: line 7, column 3 `q3[deg]`: found `2`"), "{text}");
    }

    #[test]
    fn the_rest_are_counted() {
        let mut mistakes = Mistakes::default();
        for line in 0..25 {
            mistakes.add(line, None, Fault::EmptyRow);
        }
        let text = mistakes.into_error("a").to_string();
        assert_eq!(text.lines().count(), MOST_MISTAKES + 1);
        assert!(text.ends_with("a: and 5 more mistakes"), "{text}");
    }
}
