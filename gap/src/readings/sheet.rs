//! Bytes into cells: text with whatever separates its cells, or a sheet of a workbook.

use csv::StringRecord;

use super::{ImportError, Map, names};
use crate::measurement::table;

/// A file as it was read.
#[derive(Clone, Debug)]
pub struct Sheet {
    file: String,
    bytes: Vec<u8>,
}

/// One row of cells and its line in the file (of a sheet, its row), from 1.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cells {
    pub line: u64,
    pub cells: Vec<String>,
}

/// The cells below a header.
#[derive(Clone, Debug)]
pub(super) struct Table {
    pub file: String,
    pub header: Cells,
    /// From a row of units; empty where there is none.
    pub units: Vec<String>,
    pub rows: Vec<Cells>,
    pub said: Vec<String>,
}

/// What may separate cells, the commonest last: of equally many the later wins.
const SEPARATORS: [char; 4] = ['|', ',', '\t', ';'];

/// A zip archive, which an xlsx or ods file is.
const ZIP: &[u8] = b"PK\x03\x04";

impl Sheet {
    /// The bytes of a file; `file` is what messages call it.
    pub fn new(file: impl Into<String>, bytes: Vec<u8>) -> Sheet {
        Sheet { file: file.into(), bytes }
    }

    pub(super) fn table(&self, map: &Map) -> Result<Table, ImportError> {
        let mut said = Vec::new();
        let mut rows = match self.bytes.starts_with(ZIP) {
            true => self.workbook(map, &mut said)?,
            false => self.text(map, &mut said)?,
        };
        let at = header(&rows, map).ok_or_else(|| match map.header {
            Some(line) => ImportError::HeaderLine { file: self.file.clone(), line },
            None => ImportError::NoHeader { file: self.file.clone() },
        })?;
        let mut body = rows.split_off(at + 1);
        let header = rows.remove(at);
        if let Some(title) = rows.iter().find(|row| !row.is_blank()) {
            said.push(format!(
                "what stands above line {} is left out: `{}` …",
                header.line,
                title.cells.join(" ").trim()
            ));
        }
        let units = match body.first() {
            Some(first) if first.are_units() => body.remove(0).cells,
            _ => Vec::new(),
        };
        let empty = body.iter().filter(|row| row.is_blank()).count();
        body.retain(|row| !row.is_blank());
        if empty > 0 {
            said.push(format!("{empty} empty rows are left out"));
        }
        Ok(Table { file: self.file.clone(), header, units, rows: body, said })
    }

    #[cfg(not(feature = "xlsx"))]
    fn workbook(&self, _: &Map, _: &mut Vec<String>) -> Result<Vec<Cells>, ImportError> {
        Err(ImportError::NotBuilt { file: self.file.clone() })
    }

    #[cfg(feature = "xlsx")]
    fn workbook(&self, map: &Map, said: &mut Vec<String>) -> Result<Vec<Cells>, ImportError> {
        use std::io::Cursor;

        use calamine::{Data, Reader, open_workbook_auto_from_rs};

        let wrong = |reason: calamine::Error| ImportError::Workbook {
            file: self.file.clone(),
            reason: reason.to_string(),
        };
        let mut book = open_workbook_auto_from_rs(Cursor::new(&self.bytes)).map_err(wrong)?;
        let known = book.sheet_names();
        let sheet = map.sheet.clone().or_else(|| known.first().cloned()).unwrap_or_default();
        if !known.contains(&sheet) {
            return Err(ImportError::NoSheet { file: self.file.clone(), sheet, known });
        }
        if known.len() > 1 {
            said.push(format!("sheet `{sheet}` of {}", known.join(", ")));
        }
        let range = book.worksheet_range(&sheet).map_err(wrong)?;
        let first = range.start().map_or(0, |(row, _)| u64::from(row));
        let cell = |data: &Data| match data {
            Data::Empty | Data::Error(_) => String::new(),
            other => other.to_string().trim().to_owned(),
        };
        let rows = range.rows().zip(first + 1..);
        Ok(rows.map(|(row, line)| Cells { line, cells: row.iter().map(cell).collect() }).collect())
    }

    fn text(&self, map: &Map, said: &mut Vec<String>) -> Result<Vec<Cells>, ImportError> {
        let text = table::text(&self.bytes).map_err(|not| ImportError::NotText {
            file: self.file.clone(),
            not: not.to_string(),
        })?;
        let separator = map.separator.unwrap_or_else(|| separator(text));
        let records = table::records(text, u8::try_from(separator).unwrap_or(b','));
        let cells = |cells: &StringRecord| cells.iter().map(str::to_owned).collect();
        let mut rows: Vec<Cells> =
            records.map(|r| Cells { line: r.line, cells: cells(&r.cells) }).collect();
        let comma =
            |row: &Cells| row.cells.iter().any(|c| c.contains(',') && number(c, ',').is_some());
        let found = separator != ',' && rows.iter().any(comma);
        let decimal = map.decimal.unwrap_or(if found { ',' } else { '.' });
        if decimal == ',' {
            said.push("a comma begins the decimals".to_owned());
            for cell in rows.iter_mut().flat_map(|row| &mut row.cells) {
                if number(cell, ',').is_some() {
                    *cell = cell.replace(',', ".");
                }
            }
        }
        if separator != ',' {
            let name = if separator == '\t' { "tabs".to_owned() } else { format!("`{separator}`") };
            said.push(format!("cells are separated by {name}"));
        }
        Ok(rows)
    }
}

/// A finite number with `decimal` before its decimals.
fn number(cell: &str, decimal: char) -> Option<f64> {
    let plain = if decimal == ',' && !cell.contains('.') {
        cell.replacen(',', ".", 1)
    } else {
        cell.to_owned()
    };
    plain.parse().ok().filter(|x: &f64| x.is_finite())
}

/// What separates the cells: of the candidates the one that most lines have most often.
fn separator(text: &str) -> char {
    let lines = || text.lines().filter(|line| !line.starts_with('#')).take(50);
    // A decimal comma stands within cells: where anything else separates, commas do not.
    let count = |c: char| lines().filter(|line| line.contains(c)).count();
    let most = SEPARATORS.into_iter().max_by_key(|c| (count(*c), *c != ',')).unwrap_or(',');
    if count(most) == 0 { ',' } else { most }
}

/// The row of names: where the map says, else the first with at least two words, no number, and a
/// number below it.
fn header(rows: &[Cells], map: &Map) -> Option<usize> {
    if let Some(line) = map.header {
        return rows.iter().position(|row| row.line == line && !row.is_blank());
    }
    let numbers = |row: &Cells| row.cells.iter().filter(|c| number(c, '.').is_some()).count();
    let words = |row: &Cells| row.cells.iter().filter(|c| !c.is_empty()).count();
    let body = rows.iter().position(|row| numbers(row) >= 2 && 2 * numbers(row) >= words(row))?;
    (0..body).rev().find(|k| words(&rows[*k]) >= 2 && !rows[*k].are_units())
}

impl Cells {
    fn is_blank(&self) -> bool {
        self.cells.iter().all(String::is_empty)
    }

    /// Whether every cell that says anything names a unit.
    fn are_units(&self) -> bool {
        let mut said = self.cells.iter().filter(|c| !c.is_empty()).peekable();
        said.peek().is_some() && said.all(|c| names::unit(c).is_some())
    }
}
