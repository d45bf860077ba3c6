//! An `[[effect]]` table as kernels understand it: its place, its form, its numbers.

use super::super::model::{Effect, Entry, Joint, Motion, Quantity as Given, Robot, Value};
use super::super::suggest::closest;
use super::fold::has_centre;
use super::motion::is_of_motion;
use super::{EffectError, Place, Quantity};
use crate::number::Number;

/// The largest order of a periodic effect.
const MOST_ORDERS: usize = 1000;

/// A table that was understood.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Found {
    pub id: &'static str,
    pub place: Place,
    /// The order, or the other joint from 0.
    pub form: usize,
    /// Its keys and their numbers, SI.
    pub values: Vec<(&'static str, f64)>,
}

/// Where an effect may act.
#[derive(Clone, Copy, PartialEq)]
enum At {
    Joint,
    Revolute,
    Link,
    /// A link with a mass.
    Heavy,
    Base,
    Tool,
    Arm,
}

/// A key, what it is at a revolute and at a prismatic joint, and whether it may not be negative.
type Key = (&'static str, [Quantity; 2], bool);

use Quantity::{
    Angle, AnglePerKelvin, AnglePerLength, AnglePerMoment, AnglePerMomentCubed, Flexibility,
    Length, LengthPerAngle, LengthPerForce, LengthPerForceCubed, LengthPerKelvin, Mass, PerKelvin,
    Ratio,
};

const SIX: &[Key] = &[
    ("x", [Length; 2], false),
    ("y", [Length; 2], false),
    ("z", [Length; 2], false),
    ("rx", [Angle; 2], false),
    ("ry", [Angle; 2], false),
    ("rz", [Angle; 2], false),
];
const POINT: &[Key] =
    &[("x", [Length; 2], false), ("y", [Length; 2], false), ("z", [Length; 2], false)];

/// What kernels can be made of: identifier, place, the key of its form, its keys.
const EFFECTS: &[(&str, At, Option<&str>, &[Key])] = &[
    ("joint_offset", At::Joint, None, &[("offset", [Angle, Length], false)]),
    (
        "joint_compliance",
        At::Joint,
        None,
        &[("compliance", [AnglePerMoment, LengthPerForce], false)],
    ),
    ("backlash", At::Joint, None, &[("width", [Angle, Length], true)]),
    ("joint_ratio", At::Joint, None, &[("ratio", [Ratio; 2], false)]),
    ("friction_hysteresis", At::Joint, None, &[("windup", [AnglePerMoment, LengthPerForce], true)]),
    (
        "joint_hardening",
        At::Joint,
        None,
        &[("cubic", [AnglePerMomentCubed, LengthPerForceCubed], false)],
    ),
    (
        "transmission_error",
        At::Revolute,
        Some("order"),
        &[("cos", [Angle; 2], false), ("sin", [Angle; 2], false)],
    ),
    ("joint_coupling", At::Joint, Some("joint"), &[("ratio", [Ratio; 2], false)]),
    (
        "link_compliance",
        At::Link,
        None,
        &[("bending", [Flexibility; 2], false), ("torsion", [Flexibility; 2], false)],
    ),
    (
        "bearing_compliance",
        At::Joint,
        None,
        &[("tilt_x", [AnglePerMoment; 2], true), ("tilt_y", [AnglePerMoment; 2], true)],
    ),
    ("link_weight", At::Link, None, &[("mass", [Mass; 2], false)]),
    ("wrench_scale", At::Tool, None, &[("scale", [Ratio; 2], false)]),
    ("payload_com", At::Tool, None, POINT),
    ("link_com", At::Heavy, None, POINT),
    ("gravity_tilt", At::Base, None, &[("x", [Angle; 2], false), ("y", [Angle; 2], false)]),
    (
        "base_compliance",
        At::Base,
        None,
        &[
            ("rock_x", [AnglePerMoment; 2], true),
            ("rock_y", [AnglePerMoment; 2], true),
            ("rock", [AnglePerMoment; 2], true),
            ("give", [LengthPerForce; 2], true),
        ],
    ),
    ("thermal_growth", At::Arm, None, &[("expansion", [PerKelvin; 2], false)]),
    ("joint_warming", At::Joint, None, &[("rate", [AnglePerKelvin, LengthPerKelvin], false)]),
    (
        "link_geometry",
        At::Link,
        None,
        &[
            ("theta", [Angle; 2], false),
            ("d", [Length; 2], false),
            ("a", [Length; 2], false),
            ("alpha", [Angle; 2], false),
            ("beta", [Angle; 2], false),
        ],
    ),
    ("base_frame", At::Base, None, SIX),
    ("tool_frame", At::Tool, None, SIX),
];

/// What no kernel can be made of, and why.
const REFUSED: &[(&str, &str)] = &[
    ("settling_lag", "it depends on the move before, which a set-point does not tell"),
    ("latency", "it is of the clocks of one session, not of the arm"),
    ("drift", "it belongs to the session of its measurements"),
    ("slip", "it belongs to the session of its measurements"),
    ("instrument_scale", "it is the instrument's, not the arm's"),
    ("geometric_stiffness", "it is what another simulator leaves out, not what the arm does"),
    ("loaded_backlash", "the flank on which a joint rests turns over with its torque"),
    ("soft_zone", "a stiffness of two pieces is no formula"),
    ("counterbalance", "its torque turns with the angle at which the joint comes to rest"),
    ("motor_error", "its order is no whole number"),
    ("bearing_wobble", "an axis that tilts as it turns is no row of a table"),
    ("geometry", "it is the table itself"),
];

/// The same of any other effect of motion.
const IN_MOTION: &str = "it is of the arm in motion, of which rows hold `coulomb`, `viscous`, `rotor_inertia` and bodies";

impl Found {
    /// Reads a table of `robot`, which has no symbols.
    pub fn read(table: &Effect, robot: &Robot) -> Result<Found, EffectError> {
        let name = &table.id.value;
        let place = &table.place.value;
        let motion = is_of_motion(table).then_some(IN_MOTION);
        let refused = REFUSED.iter().find(|(id, _)| id == name).map(|(_, because)| *because);
        if let Some(because) = refused.or(motion) {
            let name = name.replace('_', " ");
            let message = format!("no kernel is made of the {name} at {place}: {because}");
            let help = "take the [[effect]] out of a copy of the file to go on without it";
            return Err(wrong(&table.at, message, Some(help.to_owned())));
        }
        let known = || EFFECTS.iter().map(|(id, ..)| *id);
        let Some((id, at, form, keys)) = EFFECTS.iter().find(|(id, ..)| id == name) else {
            return Err(wrong(
                &table.id.at,
                format!("unknown effect `{name}`"),
                advice(name, known()),
            ));
        };
        let place = at.place(id, table, robot)?;
        if *id == "link_weight" && !has_centre(&robot.joints[place.row()], robot.convention) {
            let message = format!(
                "no kernel is made of the link weight at {place}: the middle of a link without `mass` moves in \
                 this row's frame"
            );
            let help =
                Some("give the row `mass` and `com`, and the effect is put into them".to_owned());
            return Err(wrong(&table.at, message, help));
        }
        let form = match form {
            Some("order") => order(table)?,
            Some(_) => other(table, place, robot)?,
            None => 0,
        };
        let motion = robot.joints[place.row()].motion;
        let keys: Vec<Key> =
            keys.iter().filter(|key| entry_of(id, key.0, motion)).copied().collect();
        let mut values: Vec<_> = keys.iter().map(|key| (key.0, 0.0)).collect();
        for number in table.numbers.iter().filter(|n| !is_form(id, &n.key)) {
            let Some(index) = keys.iter().position(|key| key.0 == number.key) else {
                let message = format!("unknown number `{}` of {id} at {place}", number.key);
                return Err(wrong(
                    &number.at,
                    message,
                    advice(&number.key, keys.iter().map(|k| k.0)),
                ));
            };
            let (key, quantity, positive) = keys[index];
            let quantity = match id {
                &"joint_coupling" => coupling(motion, robot.joints[form].motion),
                _ => Quantity::of(motion, quantity),
            };
            let found = value(number, quantity)?;
            let least = if positive { 0.0 } else { least(id, key, &robot.joints[place.row()]) };
            if found < least {
                let least = least + 0.0;
                let message = format!("`{key}` is {found:e}: below {least} it is not physical");
                return Err(wrong(&number.at, message, None));
            }
            values[index].1 = found;
        }
        Ok(Found { id, place, form, values })
    }
}

fn wrong(at: &super::Spot, message: String, help: Option<String>) -> EffectError {
    EffectError { at: at.clone(), message, help }
}

/// The nearest of some words, else all of them.
fn advice<'n>(found: &str, known: impl Iterator<Item = &'n str> + Clone) -> Option<String> {
    let all = || format!("known here: {}", known.clone().collect::<Vec<_>>().join(", "));
    Some(closest(found, known.clone()).map_or_else(all, |near| format!("did you mean `{near}`?")))
}

/// What is taken away at most of what the table has: nothing is stiffer than rigid, nor lighter than
/// nothing.
fn least(id: &str, key: &str, joint: &Joint) -> f64 {
    let double = |value: &Value| value.number().map_or(0.0, Number::to_f64);
    let beam = joint.beam.as_ref();
    let of = |stiffness: Option<f64>| stiffness.map_or(0.0, |k| -1.0 / k);
    match (id, key) {
        ("joint_compliance", _) => of(joint.stiffness.as_ref().map(double)),
        ("link_weight", _) => -joint.mass.as_ref().map_or(0.0, double),
        ("link_compliance", "bending") => of(beam
            .map(|b| double(&b.youngs_modulus) * double(&b.section.iy).max(double(&b.section.iz)))),
        ("link_compliance", _) => of(beam.map(|b| double(&b.shear_modulus) * double(&b.section.j))),
        _ => f64::NEG_INFINITY,
    }
}

/// Of a row's lengths and angles the one that the joint moves is its zero, not the link's.
fn entry_of(id: &str, key: &str, motion: Motion) -> bool {
    let moved = if motion == Motion::Revolute { "theta" } else { "d" };
    id != "link_geometry" || key != moved
}

fn is_form(id: &str, key: &str) -> bool {
    matches!((id, key), ("transmission_error", "order") | ("joint_coupling", "joint"))
}

fn coupling(this: Motion, other: Motion) -> Quantity {
    match (this, other) {
        (Motion::Revolute, Motion::Prismatic) => AnglePerLength,
        (Motion::Prismatic, Motion::Revolute) => LengthPerAngle,
        _ => Ratio,
    }
}

impl At {
    fn place(self, id: &str, table: &Effect, robot: &Robot) -> Result<Place, EffectError> {
        let numbers = 1..=robot.dof();
        let joint = |k: &usize| &robot.joints[k - 1];
        let places: Vec<Place> = match self {
            At::Joint => numbers.map(Place::Joint).collect(),
            At::Revolute => {
                let turns = |k: &usize| joint(k).motion == Motion::Revolute;
                numbers.filter(turns).map(Place::Joint).collect()
            }
            At::Link => numbers.map(Place::Link).collect(),
            At::Heavy => numbers.filter(|k| joint(k).mass.is_some()).map(Place::Link).collect(),
            At::Base => vec![Place::Base],
            At::Tool => vec![Place::Tool],
            At::Arm => vec![Place::Arm],
        };
        let found = &table.place.value;
        found.parse().ok().filter(|place| places.contains(place)).ok_or_else(|| {
            let names: Vec<String> = places.iter().map(Place::to_string).collect();
            let help = advice(found, names.iter().map(String::as_str));
            wrong(&table.place.at, format!("`{found}` is no place of {id}"), help)
        })
    }
}

/// The whole number that stands under a key; the place of what stands there, else of the table.
fn whole<'t>(table: &'t Effect, key: &str) -> (Option<usize>, &'t super::Spot) {
    let entry = table.numbers.iter().find(|number| number.key == key);
    let given = entry.and_then(|entry| match &entry.value {
        Given::Si(x) => Some(*x),
        Given::Text(text) => text.trim().parse().ok(),
    });
    let whole = given.filter(|x| x.fract() == 0.0 && (0.0..1e9).contains(x)).map(|x| x as usize);
    (whole, entry.map_or(&table.at, |entry| &entry.at))
}

fn order(table: &Effect) -> Result<usize, EffectError> {
    let (order, at) = whole(table, "order");
    order.filter(|order| (1..=MOST_ORDERS).contains(order)).ok_or_else(|| {
        let message =
            format!("`order` of transmission_error: an order of 1 to {MOST_ORDERS} is expected");
        wrong(at, message, Some("write order = 1".to_owned()))
    })
}

fn other(table: &Effect, place: Place, robot: &Robot) -> Result<usize, EffectError> {
    let (joint, at) = whole(table, "joint");
    let another = |joint: &usize| (1..=robot.dof()).contains(joint) && joint - 1 != place.row();
    joint.filter(another).map(|joint| joint - 1).ok_or_else(|| {
        let message =
            format!("`joint` of joint_coupling: another joint, 1 to {}, is expected", robot.dof());
        wrong(at, message, None)
    })
}

fn value(number: &Entry<Given>, quantity: Quantity) -> Result<f64, EffectError> {
    match &number.value {
        Given::Si(x) => Ok(*x),
        Given::Text(text) => quantity.read(text).ok_or_else(|| {
            let message = format!("`{text}` is no number and its unit: {}", quantity.units());
            let help = format!("a number without a unit is in {}", quantity.unit());
            wrong(&number.at, message, Some(help))
        }),
    }
}
