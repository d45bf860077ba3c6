//! One `[[joint]]` table.

use core::ops::Range;

use ::toml::Spanned;
use ::toml::de::DeValue;

use super::super::dimension::Dimension;
use super::super::draft::{Cell, DraftDrive, DraftJoint};
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
    "inertia",
    "gear",
    "rotor_inertia",
    "coulomb",
    "viscous",
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
    // What these measure depends on a type that may not be known: they are then left unread. A rigid joint
    // may say so instead of leaving its stiffness out.
    let by_motion = |key: &str, dimension: fn(Motion) -> Dimension, reader: &mut Reader<'_>| {
        let rigid =
            |v: &&Spanned<DeValue<'_>>| key == "stiffness" && v.as_ref().as_str() == Some("rigid");
        fields.get(key).filter(|v| !rigid(v)).map(|v| match motion.value {
            Some(motion) => reader.value(v, dimension(motion)),
            None => Cell::broken(v.span()),
        })
    };
    DraftJoint {
        at: fields.at(),
        name: fields.get("name").map(|v| reader.string(v)),
        theta: fields.get("theta").map(|v| reader.angle(v)),
        d: fields.get("d").map(|v| reader.value(v, length)),
        a: fields.get("a").map(|v| reader.value(v, length)),
        alpha: fields.get("alpha").map(|v| reader.angle(v)),
        beta: fields.get("beta").map(|v| reader.angle(v)),
        stiffness: by_motion("stiffness", Dimension::stiffness, reader),
        mass: fields.get("mass").map(|v| reader.value(v, Dimension::Mass)),
        com: fields.get("com").map(|v| (v.span(), reader.values(v, length))),
        inertia: fields.get("inertia").map(|v| (v.span(), reader.inertia(v))),
        drive: DraftDrive {
            gear: by_motion("gear", Dimension::gear, reader),
            rotor_inertia: fields.get("rotor_inertia").map(|v| reader.value(v, Dimension::Inertia)),
            coulomb: by_motion("coulomb", Dimension::load, reader),
            viscous: by_motion("viscous", Dimension::damping, reader),
        },
        limits: fields.get("limits").map(|v| match motion.value {
            Some(motion) => reader.limits(v, motion),
            None => Cell::broken(v.span()),
        }),
        source: fields.get("source").map(|v| reader.string(v)),
        beam: fields.get("beam").and_then(|v| beam::read(reader, v)),
        motion,
    }
}
