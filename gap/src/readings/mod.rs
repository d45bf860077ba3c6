//! Readings as people have them, made into a measurement file.
//!
//! A table comes in as its program wrote it: any separator, a decimal comma, an xlsx sheet, a title
//! above the header, a row of units below it, columns called `J1` or `A1`, three angles or a
//! quaternion, a payload in kilograms. Out goes the text of a measurement file
//! ([`crate::measurement`]), and in sentences what was done.
//!
//! 1. [`sheet`]: bytes into cells, each with its line.
//! 2. [`map`]: what the user says of the columns; what is said is not guessed.
//! 3. `names`: what a column is by its name where the map says nothing.
//! 4. `columns`: which column is what, in which unit.
//! 5. `turn`: orientations into rotation vectors.
//! 6. `write`: the rows as our columns.
//!
//! Only units that no number of the column could have are doubted (a joint at 175 is in degrees, a
//! tool at 1,200 in millimetres), and then it is said.

mod columns;
pub mod map;
mod names;
pub mod sheet;
#[cfg(test)]
mod tests;
mod turn;
mod write;

pub use map::Map;
pub use sheet::Sheet;

/// A measurement file, and what was done to make it.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// The text of the file.
    pub csv: String,
    /// What each column became, what was assumed, what is kept as it is: a sentence each.
    pub said: Vec<String>,
}

/// Why a table cannot be made into a measurement file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the message beside each variant and field says what it is")]
pub enum ImportError {
    #[error("{file}: {not}, or as an xlsx file")]
    NotText { file: String, not: String },
    #[error("{file}: the workbook cannot be read: {reason}")]
    Workbook { file: String, reason: String },
    #[error(
        "{file}: found a workbook, expected text: this build of stiffarm reads no other, and one with \
         the feature `xlsx` does: cargo install --path cli --features xlsx"
    )]
    NotBuilt { file: String },
    #[error("{file}: found no sheet `{sheet}`, expected one of {}", known.join(", "))]
    NoSheet { file: String, sheet: String, known: Vec<String> },
    #[error(
        "{file}: found no header, expected a row of names above rows of numbers: give its line in \
         the map, `header = 3`"
    )]
    NoHeader { file: String },
    #[error("{file}: line {line} has no header, expected a row of names there, as the map says")]
    HeaderLine { file: String, line: u64 },
    #[error("{map}: {message}")]
    Map { map: String, message: String },
    #[error(
        "{map}: found no column `{column}` in {file}{}, expected the one that is {ours}",
        suggestion.as_ref().map_or_else(String::new, |s| format!("; did you mean `{s}`?"))
    )]
    NoColumn { map: String, file: String, column: String, ours: String, suggestion: Option<String> },
    #[error(
        "{file}: found both `{first}` and `{second}`, expected one column that is {ours}: say which \
         in the map"
    )]
    Twice { file: String, first: String, second: String, ours: String },
    #[error("{file}: found the unit `{unit}` of `{column}`, expected one of {known}")]
    Unit { file: String, column: String, unit: String, known: String },
    #[error("{file}: found {found}, expected {expected}")]
    Orientation { file: String, found: String, expected: &'static str },
    #[error("{file}: line {line}, column `{column}`: found `{found}`, expected a number")]
    NotANumber { file: String, line: u64, column: String, found: String },
    #[error("{file}: found no {what}, expected {expected}: name its columns in the map")]
    Missing { file: String, what: &'static str, expected: &'static str },
}

/// Makes a table into a measurement file.
///
/// # Errors
/// [`ImportError`]: what stands in the way, and where.
pub fn import(sheet: &Sheet, map: &Map) -> Result<Imported, ImportError> {
    let table = sheet.table(map)?;
    let columns = columns::Columns::of(&table, map)?;
    let turn = turn::Turn::of(&table.file, &columns, map)?;
    write::write(&table, &columns, turn, map)
}
