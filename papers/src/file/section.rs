//! A table of a data file with the place of everything in it; each mistake is noted and reading
//! goes on.

use core::ops::Range;

use ::toml::Spanned;
use ::toml::de::{DeTable, DeValue};

use crate::latex::formula::Piece;
use crate::latex::mistake::Mistake;

/// Mistakes found so far, and the file's text.
pub struct Notes<'t> {
    /// The file.
    pub text: &'t str,
    /// What is wrong with it.
    pub mistakes: Vec<Mistake>,
}

impl Notes<'_> {
    /// Notes a mistake.
    pub fn wrong(&mut self, at: Range<usize>, message: impl Into<String>) {
        self.mistakes.push(Mistake::new(at, message));
    }
}

/// A table.
pub struct Section<'t, 'i> {
    table: &'t DeTable<'i>,
    at: Range<usize>,
}

type Value<'t, 'i> = &'t Spanned<DeValue<'i>>;

impl<'t, 'i> Section<'t, 'i> {
    /// A table of which only `keys` are known.
    pub fn open(
        table: &'t DeTable<'i>,
        at: Range<usize>,
        keys: &[&str],
        notes: &mut Notes<'_>,
    ) -> Self {
        for (key, _) in table.iter() {
            let name: &str = key.get_ref();
            if !keys.is_empty() && !keys.contains(&name) {
                let message = format!("`{name}` is no key here: {}", keys.join(", "));
                notes.wrong(key.span(), message);
            }
        }
        Section { table, at }
    }

    /// Where the table stands.
    pub fn at(&self) -> Range<usize> {
        self.at.clone()
    }

    fn get(&self, key: &str) -> Option<Value<'t, 'i>> {
        self.table.get(key)
    }

    /// All keys, of which the quotes are no part, and values.
    pub fn entries(&self) -> Vec<(Piece, Value<'t, 'i>)> {
        let key = |key: &Spanned<_>| {
            let text = ToString::to_string(key.get_ref());
            let quoted = usize::from(key.span().len() > text.len());
            Piece { at: key.span().start + quoted, text }
        };
        self.table.iter().map(|(k, v)| (key(k), v)).collect()
    }

    /// A string.
    pub fn string(&self, key: &str, notes: &mut Notes<'_>) -> Option<Piece> {
        string(self.get(key)?, notes)
    }

    /// A string that must be there.
    pub fn required(&self, key: &str, notes: &mut Notes<'_>) -> Option<Piece> {
        if self.get(key).is_none() {
            notes.wrong(self.at(), format!("`{key}` is missing here"));
        }
        self.string(key, notes)
    }

    /// A list of strings.
    pub fn strings(&self, key: &str, notes: &mut Notes<'_>) -> Option<Vec<Piece>> {
        let values = list(self.get(key)?, notes)?;
        Some(values.iter().filter_map(|v| string(v, notes)).collect())
    }

    /// A table.
    pub fn section(
        &self,
        key: &str,
        keys: &[&str],
        notes: &mut Notes<'_>,
    ) -> Option<Section<'t, 'i>> {
        section(self.get(key)?, keys, notes)
    }

    /// A list of tables.
    pub fn sections(
        &self,
        key: &str,
        keys: &[&str],
        notes: &mut Notes<'_>,
    ) -> Vec<Section<'t, 'i>> {
        let Some(values) = self.get(key).and_then(|v| list(v, notes)) else { return Vec::new() };
        values.iter().filter_map(|v| section(v, keys, notes)).collect()
    }

    /// Rows of cells, each as it is written in the file.
    pub fn rows(&self, key: &str, notes: &mut Notes<'_>) -> Vec<Vec<Piece>> {
        let Some(rows) = self.get(key).and_then(|v| list(v, notes)) else { return Vec::new() };
        let mut out = Vec::new();
        for row in rows {
            let Some(cells) = list(row, notes) else { continue };
            out.push(cells.iter().filter_map(|cell| string(cell, notes)).collect());
        }
        out
    }
}

/// A number as a double, with its spelling.
pub fn number(value: &Spanned<DeValue<'_>>, notes: &mut Notes<'_>) -> Option<f64> {
    let span = value.span();
    let spelt = notes.text.get(span.clone()).unwrap_or_default().replace('_', "");
    match value.get_ref() {
        DeValue::Integer(_) | DeValue::Float(_) => spelt.parse().ok(),
        _ => {
            notes.wrong(span, "a number is expected here");
            None
        }
    }
}

/// A string and where its text begins.
pub fn string(value: &Spanned<DeValue<'_>>, notes: &mut Notes<'_>) -> Option<Piece> {
    let span = value.span();
    let DeValue::String(text) = value.get_ref() else {
        notes.wrong(span, "a string is expected here");
        return None;
    };
    let raw = notes.text.get(span.clone()).unwrap_or_default();
    // Literal strings stand in the file as they are; in others only the first escape moves places.
    let at = span.start + raw.find(text.as_ref()).unwrap_or(0);
    Some(Piece { text: text.to_string(), at })
}

fn list<'t, 'i>(
    value: Value<'t, 'i>,
    notes: &mut Notes<'_>,
) -> Option<&'t ::toml::de::DeArray<'i>> {
    match value.get_ref() {
        DeValue::Array(values) => Some(values),
        _ => {
            notes.wrong(value.span(), "a list is expected here");
            None
        }
    }
}

fn section<'t, 'i>(
    value: Value<'t, 'i>,
    keys: &[&str],
    notes: &mut Notes<'_>,
) -> Option<Section<'t, 'i>> {
    match value.get_ref() {
        DeValue::Table(table) => Some(Section::open(table, value.span(), keys, notes)),
        _ => {
            notes.wrong(value.span(), "a table is expected here");
            None
        }
    }
}
