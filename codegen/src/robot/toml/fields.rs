//! The keys of one table: which are known, which are missing, which are misspelt.

use core::ops::Range;

use ::toml::Spanned;
use ::toml::de::{DeTable, DeValue};

use super::super::problem::Problem;
use super::super::suggest::{advice, closest};
use super::reader::Reader;

/// An open table, with its unknown keys already reported.
pub(super) struct Fields<'t, 'i> {
    table: &'t DeTable<'i>,
    at: Range<usize>,
    /// What the table is, for messages: `[[joint]]`.
    what: &'static str,
    /// Known keys that an unknown one was probably meant to be: these are not also missing.
    meant: Vec<&'static str>,
}

impl<'t, 'i> Fields<'t, 'i> {
    /// Opens a value that must be a table; `None` (and an error) if it is not.
    pub fn of(
        reader: &mut Reader<'_>,
        value: &'t Spanned<DeValue<'i>>,
        what: &'static str,
        keys: &'static [&'static str],
    ) -> Option<Self> {
        match value.get_ref() {
            DeValue::Table(table) => Some(Fields::open(reader, table, value.span(), what, keys)),
            other => {
                let found = super::reader::kind(other);
                let message = format!("{found} stands where the table {what} is expected");
                reader.report.error(Problem::new(value.span(), message));
                None
            }
        }
    }

    /// Opens a table and reports its unknown keys.
    pub fn open(
        reader: &mut Reader<'_>,
        table: &'t DeTable<'i>,
        at: Range<usize>,
        what: &'static str,
        keys: &'static [&'static str],
    ) -> Self {
        let mut meant = Vec::new();
        for (key, _) in table.iter() {
            let name: &str = key.get_ref();
            if keys.contains(&name) {
                continue;
            }
            meant.extend(closest(name, keys.iter().copied()));
            let problem = Problem::new(key.span(), format!("unknown key `{name}` in {what}"));
            reader.report.error(problem.help(advice(name, keys)));
        }
        Fields { table, at, what, meant }
    }

    /// Where the table (its header, or an inline table) stands.
    pub fn at(&self) -> Range<usize> {
        self.at.clone()
    }

    /// Whether an unknown key was probably meant to be this one.
    pub fn misspelt(&self, key: &str) -> bool {
        self.meant.contains(&key)
    }

    /// The value of a key, if the table has it.
    pub fn get(&self, key: &str) -> Option<&'t Spanned<DeValue<'i>>> {
        self.table.iter().find(|(k, _)| k.get_ref() == key).map(|(_, value)| value)
    }

    /// The value of a key that must be there.
    pub fn required(
        &self,
        reader: &mut Reader<'_>,
        key: &str,
        help: &str,
    ) -> Option<&'t Spanned<DeValue<'i>>> {
        let found = self.get(key);
        if found.is_none() && !self.misspelt(key) {
            let message = format!("`{key}` is missing in {}", self.what);
            reader.report.error(Problem::new(self.at(), message).help(help));
        }
        found
    }
}
