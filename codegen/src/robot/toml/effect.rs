//! `[[effect]]` tables: what the real arm does beyond the table, as it stands in the file.
//!
//! Which effects there are, where they act and what their numbers are is the catalogue's to say; here
//! a table has an `id`, a `place`, and else numbers and texts.

use core::ops::Range;

use ::toml::Spanned;
use ::toml::de::{DeTable, DeValue};

use super::super::model::{Effect, Entry, Quantity};
use super::super::names;
use super::super::problem::Problem;
use super::reader::{Reader, kind};

/// Reads all of them.
pub(super) fn read_all(reader: &mut Reader<'_>, value: &Spanned<DeValue<'_>>) -> Vec<Effect> {
    let mut effects = Vec::new();
    for value in reader.tables(value, "effect") {
        match value.get_ref() {
            DeValue::Table(table) => effects.extend(read(reader, table, value.span())),
            other => {
                let message =
                    format!("{} stands where the table [[effect]] is expected", kind(other));
                reader.report.error(Problem::new(value.span(), message));
            }
        }
    }
    effects
}

/// One table; `None` if it lacks its id or its place.
fn read(reader: &mut Reader<'_>, table: &DeTable<'_>, at: Range<usize>) -> Option<Effect> {
    let mut entries = Vec::new();
    for (key, value) in table.iter() {
        if let Some(found) = quantity(reader, value) {
            let at = reader.spot(value.span());
            entries.push(Entry { key: key.get_ref().to_string(), value: found, at });
        }
    }
    // The parser has them by name.
    entries.sort_by_key(|entry| entry.at.span.start);
    let mut text = |name: &str, help: &str| {
        let index = entries.iter().position(|entry| entry.key == name);
        let (place, problem) = match index.map(|index| entries.remove(index)) {
            Some(Entry { key, value: Quantity::Text(value), at }) => {
                return Some(Entry { key, value, at });
            }
            Some(entry) => (entry.at.span, "a number stands where a string is expected".to_owned()),
            None => (at.clone(), format!("`{name}` is missing in [[effect]]")),
        };
        // A value that is neither has been reported.
        if index.is_some() || !table.iter().any(|(key, _)| key.get_ref() == name) {
            reader.report.error(Problem::new(place, problem).help(help));
        }
        None
    };
    let id = text("id", "write id = \"backlash\", or another effect of `docs/gap.md`");
    let place = text("place", "write place = \"joint 2\", \"link 3\", \"base\", \"tool\", \"arm\"");
    let at = reader.spot(at);
    Some(Effect { at, id: id?, place: place?, numbers: entries })
}

/// A finite number, or a text.
fn quantity(reader: &mut Reader<'_>, value: &Spanned<DeValue<'_>>) -> Option<Quantity> {
    let number = |text: &str| text.replace('_', "").parse::<f64>().ok().filter(|x| x.is_finite());
    let read = match value.get_ref() {
        DeValue::String(text) => {
            names::plain(text, &value.span(), &mut reader.report);
            return Some(Quantity::Text(text.clone().into_owned()));
        }
        DeValue::Integer(n) if n.radix() == 10 => number(n.as_str()),
        DeValue::Float(x) => number(x.as_str()),
        _ => None,
    };
    if read.is_none() {
        let message = "a number in SI units, or a string with a number and its unit, is expected";
        reader.report.error(Problem::new(value.span(), message));
    }
    read.map(Quantity::Si)
}
