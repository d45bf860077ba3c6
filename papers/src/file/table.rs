//! A printed table: its rows, and the formula of each column that can be worked out.

use std::collections::HashMap;

use super::formulas::{symbol, tree};
use super::section::{Notes, Section, number};
use crate::latex::formula::Piece;
use crate::latex::notation::Notation;
use crate::latex::tree::Tree;

/// A printed table.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// The paper's number.
    pub number: String,
    /// What the columns hold.
    pub columns: Vec<Column>,
    /// Cells as printed.
    pub rows: Vec<Vec<Piece>>,
    /// Values of symbols in this table.
    pub values: HashMap<String, f64>,
    /// A remark for the ledger.
    pub note: Option<String>,
}

/// A column of a printed table.
#[derive(Clone, Debug, Default)]
pub struct Column {
    /// Its heading.
    pub name: String,
    /// The symbol that its cells are values of, where they are given.
    pub symbol: Option<String>,
    /// Whether the cells are degrees.
    pub degrees: bool,
    /// The formula that the cells should follow.
    pub formula: Option<Tree>,
    /// Derived values of names in the formula: name, equation number.
    pub equations: Vec<(String, String)>,
    /// The symbol for the cell as it is printed, where `symbol` is the computed value.
    pub rounded: Option<String>,
    /// The name of a method that works the cells out, where no formula does.
    pub computed: Option<String>,
    /// Why the cells cannot be reproduced.
    pub why: Option<String>,
    /// A remark on the column.
    pub note: Option<String>,
}

impl Column {
    /// Whether its cells are given rather than results.
    pub fn is_given(&self) -> bool {
        self.formula.is_none() && self.computed.is_none() && self.why.is_none()
    }
}

pub(super) const KEYS: &[&str] = &["number", "column", "rows", "values", "note"];
const COLUMN: &[&str] =
    &["name", "symbol", "degrees", "formula", "equations", "rounded", "computed", "why", "note"];

pub(super) fn read(
    section: &Section<'_, '_>,
    notation: &Notation,
    notes: &mut Notes<'_>,
) -> Option<Table> {
    let mut out = Table {
        number: section.required("number", notes)?.text,
        note: section.string("note", notes).map(|w| w.text),
        rows: section.rows("rows", notes),
        ..Table::default()
    };
    for column in section.sections("column", COLUMN, notes) {
        let formula = column.string("formula", notes);
        let mut equations = Vec::new();
        if let Some(names) = column.section("equations", &[], notes) {
            for (name, value) in names.entries() {
                let name = symbol(&name, notation, notes);
                let number = super::section::string(value, notes);
                equations.extend(name.zip(number.map(|w| w.text)));
            }
        }
        let rounded = column.string("rounded", notes);
        let named = column.string("symbol", notes);
        let flag = |key: &str, notes: &mut Notes<'_>| {
            column.string(key, notes).is_some_and(|w| w.text == "yes")
        };
        out.columns.push(Column {
            name: column.required("name", notes)?.text,
            symbol: named.and_then(|w| symbol(&w, notation, notes)),
            degrees: flag("degrees", notes),
            formula: formula.and_then(|w| tree(&w, notation, notes)),
            equations,
            rounded: rounded.and_then(|w| symbol(&w, notation, notes)),
            computed: column.string("computed", notes).map(|w| w.text),
            why: column.string("why", notes).map(|w| w.text),
            note: column.string("note", notes).map(|w| w.text),
        });
    }
    if let Some(values) = section.section("values", &[], notes) {
        for (name, value) in values.entries() {
            let name = symbol(&name, notation, notes);
            out.values.extend(name.zip(number(value, notes)));
        }
    }
    for row in &out.rows {
        if row.len() != out.columns.len() {
            let at = row.first().map_or(section.at(), Piece::place);
            let message =
                format!("this row has {} cells for {} columns", row.len(), out.columns.len());
            notes.wrong(at, message);
        }
    }
    Some(out)
}
