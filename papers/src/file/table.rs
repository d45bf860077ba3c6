//! A printed table: its rows, and the formula of each column that can be worked out.

use std::collections::HashMap;

use ::serde::Deserialize;

use super::formulas::{symbol, tree, values};
use super::notes::{Named, Notes, Text, plain};
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

/// A table as it is written in the file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Written {
    number: Text,
    #[serde(default)]
    column: Vec<WrittenColumn>,
    #[serde(default)]
    rows: Vec<Vec<Text>>,
    #[serde(default)]
    values: Named<f64>,
    note: Option<Text>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenColumn {
    name: Text,
    symbol: Option<Text>,
    degrees: Option<Text>,
    formula: Option<Text>,
    #[serde(default)]
    equations: Named<Text>,
    rounded: Option<Text>,
    computed: Option<Text>,
    why: Option<Text>,
    note: Option<Text>,
}

pub(super) fn read(written: Written, notation: &Notation, notes: &mut Notes<'_>) -> Table {
    let rows = written.rows.iter();
    let mut out = Table {
        number: written.number.get_ref().clone(),
        note: plain(written.note),
        rows: rows.map(|row| row.iter().map(|cell| notes.piece(cell)).collect()).collect(),
        ..Table::default()
    };
    for column in written.column {
        let mut named = |text: &Text| symbol(&notes.piece(text), notation, notes);
        let mut equations = Vec::new();
        for (name, number) in &column.equations {
            equations.extend(named(name).map(|name| (name, number.get_ref().clone())));
        }
        let (symbol, rounded) = (
            column.symbol.as_ref().and_then(&mut named),
            column.rounded.as_ref().and_then(&mut named),
        );
        let formula = column.formula.map(|formula| notes.piece(&formula));
        out.columns.push(Column {
            name: column.name.into_inner(),
            symbol,
            degrees: plain(column.degrees).as_deref() == Some("yes"),
            formula: formula.and_then(|formula| tree(&formula, notation, notes)),
            equations,
            rounded,
            computed: plain(column.computed),
            why: plain(column.why),
            note: plain(column.note),
        });
    }
    out.values = values(&written.values, notation, notes);
    for row in out.rows.iter().filter(|row| row.len() != out.columns.len()) {
        let at = row.first().map_or(written.number.span(), Piece::place);
        let message = format!("this row has {} cells for {} columns", row.len(), out.columns.len());
        notes.wrong(at, message);
    }
    out
}
