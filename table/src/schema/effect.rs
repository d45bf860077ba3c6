//! `[[effect]]` tables, the error model of the arm, as they stand in the file.
//!
//! Which effects there are, where they act and what their numbers are is the catalogue's to say; here
//! a table has an `id`, a `place`, and else numbers and texts.

use super::cells::Reader;
use super::node::{Content, Node};
use crate::robot::lexeme::show;
use crate::robot::names::plain;
use crate::robot::problem::Place;
use crate::robot::{Effect, Entry, Quantity};

/// One table; `None` if it lacks its id or its place.
pub(super) fn read<L: Place>(reader: &mut Reader<'_, L>, node: &Node<L>) -> Option<Effect> {
    let Some(table) = node.table() else {
        reader.expected(node, "the table [[effect]]");
        return None;
    };
    let mut text = |name: &str, help: &str| {
        let Some(value) = table.get(name) else {
            reader.refuse(&node.at, format!("`{name}` is missing in [[effect]]"), help);
            return None;
        };
        match quantity(reader, value)? {
            Quantity::Text(text) => {
                Some(Entry { key: name.to_owned(), value: text, at: value.at.spot() })
            }
            Quantity::Si(_) => {
                reader.refuse(&value.at, "a number stands where a string is expected", help);
                None
            }
        }
    };
    let id = text("id", "write id = \"backlash\", or another effect of `docs/gap.md`");
    let place = text("place", "write place = \"joint 2\", \"link 3\", \"base\", \"tool\", \"arm\"");
    let others = table.pairs.iter().filter(|pair| !["id", "place"].contains(&pair.key.as_str()));
    let numbers = others.filter_map(|pair| {
        let value = quantity(reader, &pair.value)?;
        Some(Entry { key: pair.key.clone(), value, at: pair.value.at.spot() })
    });
    let numbers = numbers.collect();
    Some(Effect { at: node.at.spot(), id: id?, place: place?, numbers })
}

/// A finite number, or a text.
fn quantity<L: Place>(reader: &mut Reader<'_, L>, node: &Node<L>) -> Option<Quantity> {
    if let Content::Text(text) = &node.content {
        plain(text, &node.at, reader.report);
        return Some(Quantity::Text(text.clone()));
    }
    let number = |text: String| text.replace('_', "").parse().ok();
    let read = node.words.as_deref().and_then(|words| number(show(words)));
    let finite = read.filter(|x: &f64| x.is_finite());
    if finite.is_none() {
        let message = "a number in SI units, or a string with a number and its unit, is expected";
        reader.refuse(&node.at, message, "");
    }
    finite.map(Quantity::Si)
}
