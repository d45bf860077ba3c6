//! Readings as people have them, made into a measurement file.
//!
//! A table comes in as its program wrote it: any separator, a decimal comma, an xlsx sheet, a title
//! above the header, a row of units below it, columns called `J1` or `A1`, three angles or a
//! quaternion, a payload in kilograms. Out goes the text of a measurement file
//! ([`crate::measurement`]), and in sentences what was done.
//!
//! 1. `file`, `sheet`: bytes into cells, each with its line. A file on disk is gone through several times and never held.
//! 2. [`Map`]: what the user says of the columns; what is said is not guessed.
//! 3. `names`: what a column is by its name where the map says nothing.
//! 4. `columns`: which column is what, in which unit.
//! 5. `turn`: orientations into rotation vectors.
//! 6. `join`: the columns of a second table beside those of the first.
//! 7. `rests`: of a joint log the postures that were held.
//! 8. `write`: the rows as our columns, times of day (`clock`) as seconds.
//!
//! Only units that no number of the column could have are doubted (a joint at 175 is in degrees, a
//! tool at 1,200 in millimetres), and then it is said.

mod clock;
mod columns;
mod file;
mod join;
mod names;
mod rests;
mod sheet;
mod turn;
#[cfg(feature = "xlsx")]
mod workbook;
mod write;

pub use file::Sheet;
pub use join::By;
pub use rests::rests;

use std::io::{self, Write};

use crate::io::{Fault, Map, ReadError, map};

/// A measurement file, and what was done to make it.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// The text of the file.
    pub csv: String,
    /// What each column became, what was assumed, what is kept as it is: a sentence each.
    pub said: Vec<String>,
}

fn counted(rows: usize) -> String {
    format!("{rows} row{}", if rows == 1 { "" } else { "s" })
}

/// Why no measurement file was written.
#[derive(Debug, thiserror::Error)]
pub enum Stopped {
    /// What stands in the way, and where.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// What takes it takes no more.
    #[error(transparent)]
    Write(#[from] io::Error),
}

/// Makes a table into a measurement file, if need be with the columns of another one beside its own.
///
/// # Errors
/// [`ReadError`]: what stands in the way, and where.
pub fn import(
    sheet: &Sheet,
    other: Option<(&Sheet, &By)>,
    map: &Map,
) -> Result<Imported, ReadError> {
    let mut csv = Vec::new();
    let said = with(sheet, other, map, &mut |write| write(&mut csv));
    let said = said.map_err(|stopped| match stopped {
        Stopped::Read(error) => error,
        Stopped::Write(error) => Fault::new(error.to_string(), "memory", "").of(sheet.file()),
    })?;
    Ok(Imported { csv: String::from_utf8(csv).unwrap_or_default(), said })
}

/// The same into a sink, row by row: what was done, in sentences. Nothing is written before all rows are read without a
/// mistake.
///
/// # Errors
/// [`Stopped`]: what stands in the way, or a sink that takes no more.
pub fn import_into(
    sheet: &Sheet,
    other: Option<(&Sheet, &By)>,
    map: &Map,
    sink: &mut dyn Write,
) -> Result<Vec<String>, Stopped> {
    with(sheet, other, map, &mut |write| {
        write(&mut io::sink())?;
        write(sink)
    })
}

/// Writes the rows into a sink, and says what was done.
type Writes<'w> = dyn Fn(&mut dyn Write) -> Result<Vec<String>, Stopped> + 'w;

/// Does something with what writes a table.
fn with(
    sheet: &Sheet,
    other: Option<(&Sheet, &By)>,
    map: &Map,
    then: &mut dyn FnMut(&Writes<'_>) -> Result<Vec<String>, Stopped>,
) -> Result<Vec<String>, Stopped> {
    let mut said = Vec::new();
    let text = sheet.text(map, &mut said)?;
    let table = sheet::Table::of(sheet.file(), &text, map, said)?;
    let (plain, mut beside) = (Map::default(), Vec::new());
    let text = other.map(|(other, _)| other.text(&plain, &mut beside)).transpose()?;
    let table = match other.zip(text.as_ref()) {
        None => table,
        Some(((other, by), text)) => {
            let other = sheet::Table::of(other.file(), text, &plain, beside)?;
            join::join(table, &other, by)?
        }
    };
    let columns = columns::Columns::of(&table, map)?;
    let turn = turn::Turn::of(&table, &columns, map)?;
    then(&|sink| write::write(&table, &columns, turn.as_ref(), map, sink))
}
