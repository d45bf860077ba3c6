//! A table of a document.

/// Rows under heads.
#[derive(Debug, Default)]
pub struct Table {
    /// One for each column.
    pub heads: Vec<String>,
    /// As many cells each, or fewer.
    pub rows: Vec<Row>,
    /// What is said below it on a page.
    pub caption: String,
}

/// The cells of a row; the first names it.
pub type Row = Vec<Cell>;

/// What stands in a cell.
#[derive(Clone, Debug)]
pub enum Cell {
    /// Words.
    Text(String),
    /// A number, aligned to the right.
    Number(String),
    /// A part of the whole, drawn.
    Bar(f64),
    /// What is as it should be, or is not.
    Judged(bool, String),
    /// A number, the darker the larger its part, −1 to 1, is.
    Shade(f64, String),
}

impl Table {
    /// A table without rows.
    pub fn new<const N: usize>(heads: [&str; N]) -> Table {
        Table { heads: heads.map(str::to_owned).to_vec(), ..Table::default() }
    }
}

impl Table {
    /// How many columns, and which of them are numbers.
    pub(super) fn columns(&self) -> Vec<bool> {
        let is_number = |column: usize| {
            let mut cells = self.rows.iter().filter_map(|row| row.get(column));
            cells.any(|cell| matches!(cell, Cell::Number(_)))
        };
        let count = self.rows.iter().map(Vec::len).chain([self.heads.len()]).max().unwrap_or(0);
        (0..count).map(is_number).collect()
    }
}

impl<T: Into<String>> From<T> for Cell {
    fn from(text: T) -> Cell {
        Cell::Text(text.into())
    }
}

impl Cell {
    /// A number as it is to be read.
    pub fn number(text: impl Into<String>) -> Cell {
        Cell::Number(text.into())
    }
}
