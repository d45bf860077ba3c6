//! One `[[joint]]` table.

use core::ops::Range;

use ::toml::Spanned;
use ::toml::de::DeValue;

use super::super::dimension::Dimension;
use super::super::draft::{Cell, DraftJoint};
use super::super::model::Motion;
use super::beam;
use super::fields::Fields;
use super::reader::Reader;

const KEYS: &[&str] = &[
    "type",
    "name",
    "theta",
    "d",
    "a",
    "alpha",
    "beta",
    "stiffness",
    "mass",
    "com",
    "limits",
    "source",
    "beam",
];

const TYPES: [(&str, Motion); 2] =
    [("revolute", Motion::Revolute), ("prismatic", Motion::Prismatic)];

/// Reads all joints, base to tip.
pub(super) fn read_all(
    reader: &mut Reader<'_>,
    value: &Spanned<DeValue<'_>>,
) -> Vec<DraftJoint<Range<usize>>> {
    let mut joints = Vec::new();
    for value in reader.tables(value, "joint") {
        if let Some(fields) = Fields::of(reader, value, "[[joint]]", KEYS) {
            joints.push(read(reader, &fields));
        }
    }
    joints
}

fn read(reader: &mut Reader<'_>, fields: &Fields<'_, '_>) -> DraftJoint<Range<usize>> {
    let motion = match fields.required(reader, "type", "write type = \"revolute\" or \"prismatic\"")
    {
        Some(value) => reader.choice(value, &TYPES),
        None => Cell::broken(fields.at()),
    };
    let length = Dimension::Length;
    DraftJoint {
        at: fields.at(),
        name: fields.get("name").map(|v| reader.string(v)),
        theta: fields.get("theta").map(|v| reader.angle(v)),
        d: fields.get("d").map(|v| reader.value(v, length)),
        a: fields.get("a").map(|v| reader.value(v, length)),
        alpha: fields.get("alpha").map(|v| reader.angle(v)),
        beta: fields.get("beta").map(|v| reader.angle(v)),
        // What these measure depends on a type that is not known: they are left unread. A rigid joint
        // may say so instead of leaving its stiffness out.
        stiffness: fields.get("stiffness").filter(|v| v.as_ref().as_str() != Some("rigid")).map(
            |v| match motion.value {
                Some(motion) => reader.value(v, Dimension::stiffness(motion)),
                None => Cell::broken(v.span()),
            },
        ),
        mass: fields.get("mass").map(|v| reader.value(v, Dimension::Mass)),
        com: fields.get("com").map(|v| (v.span(), reader.values(v, length))),
        limits: fields.get("limits").map(|v| match motion.value {
            Some(motion) => reader.limits(v, motion),
            None => Cell::broken(v.span()),
        }),
        source: fields.get("source").map(|v| reader.string(v)),
        beam: fields.get("beam").and_then(|v| beam::read(reader, v)),
        motion,
    }
}
