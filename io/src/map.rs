//! What a user says of the columns of a file (`--map`).
//!
//! ```toml
//! separator = ";"              # else found
//! decimal = ","                # else found
//! sheet = "Run 1"              # of a workbook; else the first
//! header = 3                   # the line of the names; else found
//! orientation = "zyx"          # of three angles; else by their names
//! ignore = ["Operator"]        # columns that are not kept
//! gravity = [0, 0, -9.80665]   # base axes, m/s²: which way a payload pulls
//!
//! [columns]                    # ours = theirs
//! q1 = "A1"
//! q2 = { column = "A2", unit = "deg", factor = -1, offset = 90 }   # factor · theirs + offset
//! x = { column = "Pos X", unit = "mm" }
//! mass = { column = "Last", unit = "kg" }
//!
//! [set]                        # columns that the table has not, the same in every row
//! point = "front:{file}"       # the file's name without its end
//! "from_x[mm]" = 1200
//! ```

use std::collections::BTreeMap;

use serde::Deserialize;

use super::convention::Convention;
use super::mistake::{Fault, Mistake, ReadError};
use super::source::from_toml;
use super::table::Separator;

/// What is said of a table.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Map {
    /// The file as it was named, for messages.
    #[serde(skip)]
    pub file: String,
    /// Between cells.
    pub separator: Option<char>,
    /// `.` or `,`.
    pub decimal: Option<char>,
    /// Of a workbook.
    pub sheet: Option<String>,
    /// The line of the names, from 1.
    pub header: Option<u64>,
    /// How the numbers of an orientation are written.
    pub orientation: Option<Convention>,
    /// Their names, with or without unit: they are not kept.
    pub ignore: Vec<String>,
    /// Base axes, m/s²; −z where nothing is said.
    pub gravity: Option<[f64; 3]>,
    /// Ours, and what they call it.
    pub columns: BTreeMap<String, Theirs>,
    /// Ours with its unit, and what stands in all rows of a table that lacks it.
    pub set: BTreeMap<String, Cell>,
}

/// What stands in a cell: a text, or a number as one writes it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(from = "Value")]
pub struct Cell(pub String);

#[derive(Deserialize)]
#[serde(untagged)]
enum Value {
    Text(String),
    Number(f64),
}

impl From<Value> for Cell {
    fn from(value: Value) -> Cell {
        match value {
            Value::Text(text) => Cell(text),
            Value::Number(number) => Cell(number.to_string()),
        }
    }
}

/// A column of theirs: a name, or more.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(from = "Written")]
pub struct Theirs {
    /// Its name, with or without the unit that stands in it.
    pub column: String,
    /// Its unit; else the one in its name, else the measurement file's.
    pub unit: Option<String>,
    /// Ours = factor · theirs + offset, in the unit.
    pub factor: f64,
    /// In the unit.
    pub offset: f64,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Written {
    Name(String),
    #[serde(rename_all = "snake_case")]
    More {
        column: String,
        unit: Option<String>,
        factor: Option<f64>,
        offset: Option<f64>,
    },
}

impl From<String> for Theirs {
    /// A column as it stands.
    fn from(column: String) -> Theirs {
        Theirs { column, unit: None, factor: 1.0, offset: 0.0 }
    }
}

impl From<Written> for Theirs {
    fn from(written: Written) -> Theirs {
        match written {
            Written::Name(column) => column.into(),
            Written::More { column, unit, factor, offset } => Theirs {
                column,
                unit,
                factor: factor.unwrap_or(1.0),
                offset: offset.unwrap_or(0.0),
            },
        }
    }
}

impl Map {
    /// What separates cells, if it is said.
    pub fn separator(&self) -> Option<Separator> {
        self.separator.map(Separator::of)
    }

    /// There is no header where the map says.
    pub fn no_header(line: u64) -> Mistake {
        Fault::new("no header", "a row of names there, as the map says", "").at(line, None)
    }

    /// Reads a map; `file` is what messages call it.
    ///
    /// # Errors
    /// [`ReadError`]: what is no map, with the line and what was expected.
    pub fn read(file: &str, text: &str) -> Result<Map, ReadError> {
        let wrong = |found: String, expected: &str| Fault::new(found, expected, "").of(file);
        let map: Map = from_toml(file, text, "no map")?;
        if let Some(c) = map.separator.filter(|c| !c.is_ascii()) {
            return Err(wrong(format!("`separator = \"{c}\"`"), "a character of ASCII"));
        }
        match map.decimal {
            Some(c) if c != '.' && c != ',' => {
                return Err(wrong(format!("`decimal = \"{c}\"`"), "\".\" or \",\""));
            }
            Some(c) if map.separator == Some(c) => {
                let found = format!("`{c}` to separate cells and to begin decimals");
                return Err(wrong(found, "two characters"));
            }
            _ => {}
        }
        let finite = |x: &f64| x.is_finite();
        if !map.columns.values().all(|t| finite(&t.factor) && t.factor != 0.0 && finite(&t.offset))
        {
            let found = "a factor of zero, or a number that is not finite, of a column";
            return Err(wrong(found.to_owned(), "finite numbers"));
        }
        if !map.gravity.iter().flatten().all(finite) {
            return Err(wrong("a gravity that is not finite".to_owned(), "finite numbers"));
        }
        Ok(Map { file: file.to_owned(), ..map })
    }
}
