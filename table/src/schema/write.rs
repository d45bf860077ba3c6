//! Writes a robot by the schema as a robot file that reads back as the same robot.

use super::field::{Absent, Field, Slot};
use super::fields::{BEAM, FRAME, JOINT, MARKER, PAYLOAD, ROBOT, SECTION};
use super::read::{CONVENTIONS, MOTIONS};
use crate::robot::pi::{exact_multiple, spell};
use crate::robot::{Angle, Effect, Frame, Motion, Quantity, Robot, Value, decimal};

impl Robot {
    /// The robot as a robot file. Reading it back gives the same robot: parameters by name, exact
    /// multiples of π as such, every number as the same double.
    pub fn to_toml(&self) -> String {
        let mut robot = self.clone();
        for (index, joint) in robot.joints.iter_mut().enumerate() {
            // The label of a row without one.
            if joint.name == format!("joint {}", index + 1) {
                joint.name.clear();
            }
        }
        table(ROBOT, &mut robot)
    }
}

/// The keys of a table and the tables in it.
fn table<T>(fields: &[Field<T>], of: &mut T) -> String {
    let mut text = String::new();
    for field in fields {
        let always = (field.written)(of) || matches!(field.absent, Absent::Mistake(_));
        match (field.slot)(of) {
            Slot::Frame(frame, fields, name) if *frame != Frame::default() => {
                text += &format!("\n{name}\n{}", table(fields, frame));
            }
            Slot::Joints(joints) => text += &tables("joint", JOINT, joints),
            Slot::Frames(frames) => text += &tables("frame", FRAME, frames),
            Slot::Markers(markers) => text += &tables("marker", MARKER, markers),
            Slot::Payloads(payloads) => text += &tables("payload", PAYLOAD, payloads),
            Slot::Effects(effects) => effects.iter().for_each(|each| text += &effect(each)),
            Slot::Beam(Some(beam)) => text += &format!("\n[joint.beam]\n{}", table(BEAM, beam)),
            slot => {
                if let Some(value) = value(slot, always) {
                    text += &format!("{} = {value}\n", field.name);
                }
            }
        }
    }
    text
}

fn tables<T>(name: &str, fields: &[Field<T>], each: &mut [T]) -> String {
    each.iter_mut().map(|one| format!("\n[[{name}]]\n{}", table(fields, one))).collect()
}

/// The value of a key; `None` where it need not be written.
fn value(slot: Slot<'_>, always: bool) -> Option<String> {
    let values = |values: &[Value]| list(values.iter().map(number));
    Some(match slot {
        Slot::Text(text) if always || !text.is_empty() => quoted(text),
        Slot::MaybeText(text) => quoted(text.as_deref()?),
        Slot::Convention(convention) => word(&CONVENTIONS, convention)?,
        Slot::Motion(motion) => word(&MOTIONS, motion)?,
        Slot::Side(side) => quoted(side.as_deref()?),
        Slot::Angle(of) if always || !of.is_zero() => angle(of),
        Slot::Value(of) if always || !of.is_zero() => number(of),
        Slot::Maybe(of) => number(of.as_ref()?),
        Slot::Vector(of) if always => values(of),
        Slot::MaybeVector(of) => values(of.as_ref()?),
        Slot::Tensor(of) => values(of.as_ref()?),
        Slot::Rotation(of) => list(of.iter().map(angle)),
        Slot::Limits(of, motion) => list(of.as_ref()?.iter().map(|x| limit(motion, *x))),
        Slot::Row(row) => format!("{}", *row + 1),
        Slot::Section(section) => {
            let constants = table(SECTION, section);
            format!("{{ {} }}", constants.lines().collect::<Vec<_>>().join(", "))
        }
        Slot::Outputs(robot) => {
            let asked = robot.asked();
            let names = (!asked.is_empty()).then(|| list(asked.iter().map(|name| quoted(name))));
            names?
        }
        _ => return None,
    })
}

fn effect(effect: &Effect) -> String {
    let (id, place) = (quoted(&effect.id.value), quoted(&effect.place.value));
    let mut text = format!("\n[[effect]]\nid = {id}\nplace = {place}\n");
    for number in &effect.numbers {
        // A whole number is the number of something.
        let value = match &number.value {
            Quantity::Si(x) if x.fract() == 0.0 && x.abs() < 1e9 => format!("{x:.0}"),
            Quantity::Si(x) => format!("{x:?}"),
            Quantity::Text(text) => quoted(text),
        };
        text += &format!("{} = {value}\n", key(&number.key));
    }
    text
}

/// A key as it may stand, in quotes if it must.
fn key(name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
    if !name.is_empty() && name.chars().all(bare) { name.to_owned() } else { quoted(name) }
}

fn word<T: PartialEq>(words: &[(&str, T)], of: &T) -> Option<String> {
    words.iter().find(|(_, one)| one == of).map(|(word, _)| quoted(word))
}

fn list(entries: impl Iterator<Item = String>) -> String {
    format!("[{}]", entries.collect::<Vec<_>>().join(", "))
}

fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

fn number(value: &Value) -> String {
    match value {
        Value::Number(n) => decimal::write(*n),
        Value::Symbol(name) => quoted(name),
    }
}

fn angle(angle: &Angle) -> String {
    match angle {
        Angle::Pi(r) if *r.numer() == 0 => "0.0".to_owned(),
        Angle::Pi(r) => quoted(&spell(*r)),
        Angle::Radians(n) => decimal::write(*n),
        Angle::Symbol(name) => quoted(name),
    }
}

fn limit(motion: Motion, x: f64) -> String {
    match (motion, exact_multiple(x)) {
        // Written as a multiple only where that reads back as the same double.
        (Motion::Revolute, Some(r)) if Angle::Pi(r).radians() == Some(x) => angle(&Angle::Pi(r)),
        _ => format!("{x:?}"),
    }
}
