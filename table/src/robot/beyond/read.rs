//! An `[[effect]]` table as kernels understand it: its place, its form, its numbers.

use super::super::model::{Effect, Entry, Joint, Motion, Quantity as Given, Robot, Value};
use super::super::suggest::advice;
use super::fold::has_centre;
use super::motion::is_of_motion;
use super::{EffectError, Place, Quantity};

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

/// The effects, one to a line: `identifier at place, the key of its form: keys`. Of a key what it is, at a prismatic joint
/// behind `|` where that is something else, and `>= 0` where it may not be negative.
macro_rules! effects {
    ($($id:ident at $at:ident $(, $form:ident)?: $($key:ident $of:ident $(| $other:ident)? $(>= $zero:tt)?),*;)*) => {
        /// What kernels can be made of: identifier, place, the key of its form, its keys.
        const EFFECTS: &[(&str, At, Option<&str>, &[Key])] = &[$((
            stringify!($id),
            At::$at,
            effects!(@form $($form)?),
            &[$((stringify!($key), effects!(@of $of $($other)?), effects!(@bound $($zero)?))),*],
        )),*];
    };
    (@form) => { None };
    (@form $form:ident) => { Some(stringify!($form)) };
    (@of $of:ident) => { [Quantity::$of; 2] };
    (@of $of:ident $other:ident) => { [Quantity::$of, Quantity::$other] };
    (@bound) => { false };
    (@bound 0) => { true };
}

effects! {
    joint_offset at Joint: offset Angle | Length;
    joint_compliance at Joint: compliance AnglePerMoment | LengthPerForce;
    backlash at Joint: width Angle | Length >= 0;
    joint_ratio at Joint: ratio Ratio;
    friction_hysteresis at Joint: windup AnglePerMoment | LengthPerForce >= 0;
    joint_hardening at Joint: cubic AnglePerMomentCubed | LengthPerForceCubed;
    transmission_error at Revolute, order: cos Angle, sin Angle;
    joint_coupling at Joint, joint: ratio Ratio;
    link_compliance at Link: bending Flexibility, torsion Flexibility;
    bearing_compliance at Joint: tilt_x AnglePerMoment >= 0, tilt_y AnglePerMoment >= 0;
    link_weight at Link: mass Mass;
    wrench_scale at Tool: scale Ratio;
    payload_com at Tool: x Length, y Length, z Length;
    link_com at Heavy: x Length, y Length, z Length;
    gravity_tilt at Base: x Angle, y Angle;
    base_compliance at Base: rock_x AnglePerMoment >= 0, rock_y AnglePerMoment >= 0,
        rock AnglePerMoment >= 0, give LengthPerForce >= 0;
    thermal_growth at Arm: expansion PerKelvin;
    joint_warming at Joint: rate AnglePerKelvin | LengthPerKelvin;
    link_geometry at Link: theta Angle, d Length, a Length, alpha Angle, beta Angle;
    base_frame at Base: x Length, y Length, z Length, rx Angle, ry Angle, rz Angle;
    tool_frame at Tool: x Length, y Length, z Length, rx Angle, ry Angle, rz Angle;
}

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
        let Some((id, at, form, keys)) = EFFECTS.iter().find(|(id, ..)| id == name) else {
            let known: Vec<&str> = EFFECTS.iter().map(|(id, ..)| *id).collect();
            let help = Some(advice(name, &known));
            return Err(wrong(&table.id.at, format!("unknown effect `{name}`"), help));
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
                let known: Vec<&str> = keys.iter().map(|key| key.0).collect();
                return Err(wrong(&number.at, message, Some(advice(&number.key, &known))));
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

/// What is taken away at most of what the table has: nothing is stiffer than rigid, nor lighter than
/// nothing.
fn least(id: &str, key: &str, joint: &Joint) -> f64 {
    let beam = joint.beam.as_ref();
    let of = |stiffness: Option<f64>| stiffness.map_or(0.0, |k| -1.0 / k);
    match (id, key) {
        ("joint_compliance", _) => of(joint.stiffness.as_ref().map(Value::or_zero)),
        ("link_weight", _) => -joint.mass.as_ref().map_or(0.0, Value::or_zero),
        ("link_compliance", "bending") => of(beam.map(|b| {
            b.youngs_modulus.or_zero() * b.section.iy.or_zero().max(b.section.iz.or_zero())
        })),
        ("link_compliance", _) => {
            of(beam.map(|b| b.shear_modulus.or_zero() * b.section.j.or_zero()))
        }
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
        (Motion::Revolute, Motion::Prismatic) => Quantity::AnglePerLength,
        (Motion::Prismatic, Motion::Revolute) => Quantity::LengthPerAngle,
        _ => Quantity::Ratio,
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
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            let help = Some(advice(found, &names));
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
