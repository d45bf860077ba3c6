//! A beam's cross-section: a tube, a box, or its constants.

use super::cells::{Expected, Language, Reader};
use super::field::keys;
use super::fields::SECTION;
use super::node::Node;
use crate::number::Number;
use crate::robot::problem::Place;
use crate::robot::{Dimension, Section};

const SIDES: &str = "[b, h] (along the beam's y, along its z)";
/// The keys of a tube.
pub(crate) const TUBE: &[&str] = &["shape", "outer_diameter", "inner_diameter"];
/// The keys of a box.
pub(crate) const BOX: &[&str] = &["shape", "outer", "inner"];

/// Reads a section; reported if `None`.
pub(super) fn read<L: Place>(reader: &mut Reader<'_, L>, node: &Node<L>) -> Option<Section> {
    match node.table().and_then(|table| table.get("shape")) {
        None => constants(reader, node),
        Some(shape) => match reader.choice(shape, &[("tube", true), ("box", false)])? {
            true => tube(reader, node),
            false => rectangle(reader, node),
        },
    }
}

fn constants<L: Place>(reader: &mut Reader<'_, L>, node: &Node<L>) -> Option<Section> {
    let mut known = keys(SECTION);
    known.extend(Some("shape").filter(|_| reader.language == Language::File));
    let (table, meant) = reader.open(&known, "section", node)?;
    if meant.contains(&"shape") {
        return None;
    }
    let mut section = Section::default();
    let mut whole = true;
    for field in SECTION {
        let value = table.get(field.name);
        match value {
            Some(value) => whole &= reader.fill(field, value, &mut section),
            None => {
                let (opened, help) = ((table, meant.clone()), super::fields::SHAPES);
                reader.missing(field.name, "section", node, help, &opened);
            }
        }
        whole &= value.is_some();
    }
    whole.then_some(section)
}

fn size<L: Place>(reader: &mut Reader<'_, L>, node: &Node<L>) -> Option<Number> {
    let reason = "to keep a section symbolic give its area, iy, iz and j";
    let expected = Expected { dimension: Dimension::Length, number: Some(reason) };
    reader.value(node, expected)?.number()
}

fn sides<L: Place>(reader: &mut Reader<'_, L>, node: &Node<L>) -> Option<[Number; 2]> {
    let [b, h] = reader.list::<2>(node, SIDES)?;
    let (b, h) = (size(reader, b), size(reader, h));
    Some([b?, h?])
}

/// The outer size, which must be there, and the inner one, which may.
fn sizes<L: Place, T>(
    reader: &mut Reader<'_, L>,
    node: &Node<L>,
    (what, known, help): (&str, &'static [&'static str], &str),
    size: fn(&mut Reader<'_, L>, &Node<L>) -> Option<T>,
) -> Option<(T, Option<T>)> {
    let opened = reader.open(known, what, node)?;
    let (outer, inner) = (opened.0.get(known[1]), opened.0.get(known[2]));
    if outer.is_none() {
        reader.missing(known[1], what, node, help, &opened);
    }
    let inner = inner.map(|inner| size(reader, inner));
    let outer = outer.and_then(|outer| size(reader, outer));
    Some((outer?, inner.map_or(Some(None), |inner| inner.map(Some))?))
}

fn tube<L: Place>(reader: &mut Reader<'_, L>, node: &Node<L>) -> Option<Section> {
    let help = "for example outer_diameter = \"200 mm\"";
    let (outer, inner) = sizes(reader, node, ("a tube's section", TUBE, help), size)?;
    let inner = inner.unwrap_or(Number::ZERO);
    let section = Section::tube(outer, inner);
    if section.is_none() {
        let message = format!(
            "a tube of outer diameter {outer} m and inner diameter {inner} m: the outer one must \
             be above the inner one, and neither below zero"
        );
        reader.refuse(&node.at, message, "");
    }
    section
}

fn rectangle<L: Place>(reader: &mut Reader<'_, L>, node: &Node<L>) -> Option<Section> {
    let help = "for example outer = [\"100 mm\", \"80 mm\"]";
    let (outer, inner) = sizes(reader, node, ("a box's section", BOX, help), sides)?;
    let hollow = inner.filter(|sides| !sides.iter().all(|side| side.is_zero()));
    let section = Section::rectangle(outer, hollow);
    if section.is_none() {
        let message = "a box's sides must be above zero, and each inner side below its outer side";
        reader.refuse(&node.at, message, "");
    }
    section
}
