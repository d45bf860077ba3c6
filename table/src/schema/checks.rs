//! What single values cannot tell: names that stand twice, parameters that are two quantities, masses that are missing.

use std::collections::HashMap;

use super::cells::Reader;
use super::read::{Record, TENSOR};
use crate::number::Number;
use crate::robot::inertia::unphysical;
use crate::robot::names::{no_module, refused};
use crate::robot::problem::{Place, Problem};
use crate::robot::{Dimension, Joint, Motion, Value};

/// More joints than any arm has; a bound on the work that a file can ask for.
const MOST_JOINTS: usize = 64;

/// The number of joints.
pub(super) fn count<L: Place>(joints: &[Record<L>], reader: &mut Reader<'_, L>) {
    if let Some(joint) = joints.get(MOST_JOINTS) {
        let message = format!("joint {} of at most {MOST_JOINTS}", MOST_JOINTS + 1);
        reader.refuse(&joint.at, message, "");
    }
}

/// Names that are there and stand once.
pub(super) fn names<'n, L: Place>(
    what: &str,
    names: impl Iterator<Item = &'n str>,
    records: &[Record<L>],
    reader: &mut Reader<'_, L>,
) {
    let mut seen: Vec<&str> = Vec::new();
    for (name, record) in names.zip(records) {
        let Some(at) = record.whole("name") else { continue };
        if name.trim().is_empty() {
            reader.refuse(at, format!("a {what} without a name"), "");
        } else if seen.contains(&name) {
            reader.refuse(at, format!("two {what}s are called `{name}`"), "");
        }
        seen.push(name);
    }
}

/// A frame's name becomes a module's.
pub(super) fn module<L: Place>(name: &str, record: &Record<L>, reader: &mut Reader<'_, L>) {
    let no = no_module(name);
    if let (Some(at), Some((message, help))) = (record.whole("name"), no) {
        reader.refuse(at, message, help);
    }
}

/// Parameters that can be fields of a struct, each of one quantity. The joint variable is misplaced wherever it stands;
/// another name is refused once.
pub(super) fn parameters<L: Place>(reader: &mut Reader<'_, L>) {
    let mut seen: HashMap<String, Dimension> = HashMap::new();
    for each in core::mem::take(&mut reader.uses) {
        let no = refused(&each.name);
        match seen.get(&each.name).filter(|_| each.name != "q") {
            None => {
                if let Some((message, help)) = no {
                    reader.refuse(&each.at, message, help);
                }
                seen.insert(each.name, each.dimension);
            }
            Some(first) if *first != each.dimension && no.is_none() => {
                let (name, here) = (&each.name, each.dimension);
                let message = format!("`{name}` is {first} where it first stands, and {here} here");
                reader.refuse(&each.at, message, "one parameter is one quantity: use two names");
            }
            Some(_) => {}
        }
    }
}

/// What a row says of its link.
pub(super) fn joint<L: Place>(joint: &Joint, record: &Record<L>, reader: &mut Reader<'_, L>) {
    let parts = [("com", "a centre of mass"), ("inertia", "moments of inertia")];
    for (key, what) in parts.into_iter().filter(|_| record.at("mass").is_none()) {
        if let Some(at) = record.whole(key) {
            let help = format!("give the link's `mass` too, or leave `{key}` out");
            reader.refuse(at, format!("{what} without a mass"), help);
        }
    }
    inertia(joint.inertia.as_ref(), record, "the row's", reader);
    // A beam needs a chord from frame origin to frame origin: its length is √(a² + d²) in both conventions. What could
    // not be read is not known to be zero.
    let zero = |key: &str, value: &Value| match record.at(key) {
        Some(_) => record.whole(key).is_some() && value.is_zero(),
        None => true,
    };
    let turns = record.whole("type").is_some() && joint.motion == Motion::Revolute;
    if let Some(at) = record.at("beam").filter(|_| joint.beam.is_some() && turns)
        && zero("a", &joint.a)
        && zero("d", &joint.d)
    {
        let help = "put the beam on the joint whose row has the link's length";
        reader.refuse(at, "a beam of no length: `a` and `d` of this joint are both zero", help);
    }
}

/// A beam on a joint whose motion the reader knows.
pub(super) fn beam<L: Place>(record: &Record<L>, reader: &mut Reader<'_, L>) {
    let slides = reader.motion == Some(Motion::Prismatic);
    if let Some(at) = record.at("density").filter(|_| slides) {
        let message = "a density on a prismatic joint's beam: its length changes";
        reader.refuse(at, message, "give the link's `mass` and `com` instead");
    }
}

/// Lengths of an arm that are told in metres. No arm is longer than the longest concrete pump, whose boom reaches 101 m:
/// where numbers without a unit add up to more, they are millimetres.
pub(super) fn size<L: Place>(reader: &mut Reader<'_, L>) {
    const LONGEST: f64 = 101.0;
    let lengths = core::mem::take(&mut reader.lengths);
    let sum: f64 = lengths.iter().map(|(_, length, _)| length).sum();
    let largest = lengths.into_iter().rev().max_by(|a, b| a.1.total_cmp(&b.1));
    if let Some((shown, _, at)) = largest.filter(|_| sum > LONGEST) {
        let message = format!(
            "the lengths of this arm add up to {sum:.0} m, more than any has: for millimetres write {shown} mm"
        );
        let help = format!("a length without a unit is in metres; if these are, write {shown} m");
        reader.report.warn(Problem::new(at, message).help(help));
    }
}

/// Moments of inertia that some body has, where all are numbers.
pub(super) fn inertia<L: Place>(
    tensor: Option<&[Value; 6]>,
    record: &Record<L>,
    axes: &str,
    reader: &mut Reader<'_, L>,
) {
    let (Some(entries), Some(at)) = (tensor, record.whole("inertia")) else { return };
    let numbers: Vec<f64> =
        entries.iter().filter_map(|entry| entry.number().map(Number::to_f64)).collect();
    let Ok(numbers) = <[f64; 6]>::try_from(numbers) else { return };
    if let Some(message) = unphysical(numbers) {
        let help = format!("`inertia` is {TENSOR} about the centre of mass, in {axes} axes");
        reader.refuse(at, message, help);
    }
}
