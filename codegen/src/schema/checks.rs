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

#[cfg(test)]
mod tests {
    use crate::robot::Robot;

    fn messages(joint: &str) -> Vec<String> {
        let text = format!("name = \"x\"\nconvention = \"modified\"\n[[joint]]\n{joint}");
        match Robot::from_toml(&text, "x.toml") {
            Ok(_) => Vec::new(),
            Err(error) => error.errors.into_iter().map(|e| e.message).collect(),
        }
    }

    fn revolute(lines: &str) -> Vec<String> {
        messages(&format!("type = \"revolute\"\n{lines}\n"))
    }

    const BEAM: &str = "[joint.beam]\nyoungs_modulus = 1\nshear_modulus = 1\n\
                        section = { area = 1, iy = 1, iz = 1, j = 1 }\n";

    #[test]
    fn signs_of_numbers() {
        assert_eq!(revolute("stiffness = 0"), ["the stiffness is 0.0: it must be above zero"]);
        assert_eq!(revolute("stiffness = -2"), ["the stiffness is -2.0: it must be above zero"]);
        assert_eq!(revolute("mass = -1"), ["the mass is -1.0: it must not be below zero"]);
        assert!(revolute("mass = 0\ncom = [1, 0, 0]").is_empty());
        assert_eq!(
            revolute(
                "a = 1\n[joint.beam]\nyoungs_modulus = 0\nshear_modulus = -1\ndensity = -1\n\
                 shear_coefficient = 0\nsection = { area = 0, iy = 0, iz = 0, j = -1 }"
            ),
            [
                "youngs_modulus is 0.0: it must be above zero",
                "shear_modulus is -1.0: it must be above zero",
                "the density is -1.0: it must not be below zero",
                "shear_coefficient is 0.0: it must be above zero",
                "the section's area is 0.0: it must be above zero",
                "the section's iy is 0.0: it must be above zero",
                "the section's iz is 0.0: it must be above zero",
                "the section's j is -1.0: it must be above zero",
            ]
        );
    }

    #[test]
    fn a_tensor_of_inertia_is_that_of_some_body() {
        let with = |inertia: &str| revolute(&format!("mass = 1\ninertia = {inertia}"));
        assert!(with("[0.3, 0.01, 0, 0.4, 0, 0.2]").is_empty());
        // A disc, whose third moment is the sum of the others, and a rod.
        assert!(with("[0.1, 0, 0, 0.2, 0, 0.3]").is_empty());
        assert!(with("[0.2, 0, 0, 0.2, 0, 0]").is_empty());
        assert_eq!(
            with("[0.1, 0, 0, 0.2, 0, 0.4]"),
            [
                "the principal moments of inertia are 0.1, 0.2 and 0.4: no body has one that is larger than \
              the sum of the others"
            ]
        );
        assert_eq!(
            with("[0.1, 0.2, 0, 0.1, 0, 0.1]"),
            ["the principal moments of inertia are -0.1, 0.1 and 0.3: none can be below zero"]
        );
        let weightless = "moments of inertia without a mass";
        assert_eq!(revolute("inertia = [1, 0, 0, 1, 0, 1]"), [weightless]);
        assert_eq!(revolute("mass = 1\ninertia = [1, 0, 0]").len(), 1);
    }

    #[test]
    fn friction_and_gears_have_signs() {
        assert_eq!(
            revolute("gear = 0\nrotor_inertia = -1\ncoulomb = -2\nviscous = -3"),
            [
                "the gear is 0.0: it must be above zero",
                "the rotor's inertia is -1.0: it must not be below zero",
                "the dry friction is -2.0: it must not be below zero",
                "the viscous friction is -3.0: it must not be below zero",
            ]
        );
    }

    #[test]
    fn limits_are_in_order() {
        assert_eq!(
            revolute("limits = [1, 1]"),
            ["the lower limit 1.0 is not below the upper limit 1.0"]
        );
    }

    #[test]
    fn a_centre_of_mass_needs_a_mass() {
        assert_eq!(revolute("com = [1, 0, 0]"), ["a centre of mass without a mass"]);
        assert_eq!(
            revolute("com = [1, 0, 0]\nmass = \"x kg\""),
            ["`x kg` is an expression: a cell holds one number or one parameter"]
        );
    }

    #[test]
    fn a_beam_needs_a_length_that_stays() {
        let none = "a beam of no length: `a` and `d` of this joint are both zero";
        assert_eq!(revolute(BEAM), [none]);
        assert!(revolute(&format!("d = \"d1\"\n{BEAM}")).is_empty());
        assert_eq!(
            messages(&format!("type = \"prismatic\"\n{BEAM}density = 1\n")),
            ["a density on a prismatic joint's beam: its length changes"]
        );
    }

    #[test]
    fn the_number_of_joints_is_bounded() {
        let joints = "type = \"revolute\"\n[[joint]]\n".repeat(64) + "type = \"revolute\"\n";
        assert_eq!(messages(&joints), ["joint 65 of at most 64"]);
    }
}
