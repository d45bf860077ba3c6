//! What may be missing from the model of a moving arm: one file each.

mod asymmetric_friction;
mod backlash;
mod catalogue;
mod coulomb_friction;
mod counterbalance;
mod friction_curve;
mod gravity_direction;
mod joint_coupling;
mod joint_elasticity;
mod latency;
mod link_inertia;
mod load_friction;
mod payload;
mod presliding;
mod rotor_inertia;
mod servo_droop;
mod stribeck;
mod torque_latency;
mod torque_offset;
mod torque_ripple;
mod torque_saturation;
mod torque_scale;
mod tracking_lag;
mod viscous_friction;
mod warm_up;

use std::fmt;

use stiffarm_kernels::generic::Arm;

pub use catalogue::Catalogue;

use super::pace::Pace;
use super::read::TorqueSide;
use super::scene::{Column, Domain, Scene};
use crate::effects::{About, Place, RobotFile};

/// Where an effect of a log acts; joints count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spot {
    /// A joint.
    Joint(usize),
    /// A motor that turns with the sum of two joints' values (1) or with their difference (−1).
    Pair(usize, usize, i8),
    /// A link.
    Link(usize),
    /// What the arm stands on.
    Base,
    /// What the last link carries in a run.
    Tool(usize),
    /// All joints.
    Arm,
    /// Between the controller and the arm.
    Interface,
}

impl fmt::Display for Spot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Spot::Joint(joint) => write!(f, "joint {}", joint + 1),
            Spot::Pair(a, b, sum) => {
                let sign = if *sum > 0 { "+" } else { "−" };
                write!(f, "joints {} {sign} {}", a + 1, b + 1)
            }
            Spot::Link(link) => write!(f, "link {}", link + 1),
            Spot::Base => f.write_str("the base"),
            Spot::Tool(run) => write!(f, "the tool in run {}", run + 1),
            Spot::Arm => f.write_str("every joint"),
            Spot::Interface => f.write_str("the interface"),
        }
    }
}

impl Spot {
    /// Every place that an arm of so many joints has.
    pub fn all(joints: usize) -> Vec<Spot> {
        let pairs = (1..joints).map(|b| (b - 1, b));
        let pairs = pairs.flat_map(|(a, b)| [Spot::Pair(a, b, 1), Spot::Pair(a, b, -1)]);
        let rows = (0..joints).flat_map(|row| [Spot::Joint(row), Spot::Link(row)]);
        rows.chain(pairs).chain([Spot::Base, Spot::Arm, Spot::Interface]).collect()
    }

    /// The joints of a pair.
    pub fn pair(self) -> Option<[usize; 2]> {
        if let Spot::Pair(a, b, _) = self { Some([a, b]) } else { None }
    }

    /// Whether both act on one joint.
    pub fn meets(self, other: Spot) -> bool {
        let joints = |spot| match spot {
            Spot::Joint(joint) => Some([joint, joint]),
            Spot::Pair(a, b, _) => Some([a, b]),
            _ => None,
        };
        match (joints(self), joints(other)) {
            (Some(mine), Some(theirs)) => mine.iter().any(|joint| theirs.contains(joint)),
            _ => true,
        }
    }
}

/// What a link carries beyond what is known of it.
pub struct Carried {
    /// The link, from 0.
    pub link: usize,
    /// The run in which it does; `None` is all.
    pub run: Option<usize>,
    /// Ten numbers of the link, in its frame, per unit of each of the effect's.
    pub numbers: Vec<[f64; 10]>,
}

/// A number of an effect and its SI unit.
pub type Number = (&'static str, &'static str);

/// An effect of reality on a moving arm.
pub trait LogEffect: Sync {
    /// The identifier that files and options use.
    fn identifier(&self) -> &'static str;

    /// What those who record logs are to know of it.
    fn about(&self) -> About;

    /// The rows that it is seen in.
    fn domain(&self) -> Domain {
        Domain::Torque
    }

    /// Where on this arm it may act.
    fn spots(&self, scene: &Scene<'_>) -> Vec<Spot> {
        joints(scene)
    }

    /// Its numbers; all zero is no effect. Currents stand in place of torques where they drive.
    fn numbers(&self) -> &'static [Number];

    /// Its change of the rows per unit of each number, where they have these values.
    fn columns(&self, scene: &Scene<'_>, spot: Spot, values: &[f64]) -> Vec<Column>;

    /// Its change of the rows where they have these values, if that is not in proportion to them: it
    /// [`LogEffect::bends`].
    fn value(&self, _: &Scene<'_>, _: Spot, _: &[f64]) -> Column {
        Column::default()
    }

    /// Whether its change of the rows is not in proportion to its numbers.
    fn bends(&self) -> bool {
        false
    }

    /// Values about which its own are sought.
    fn probes(&self, _: &Scene<'_>, _: Spot) -> Vec<Vec<f64>> {
        vec![vec![0.0; self.numbers().len()]]
    }

    /// What it changes of the rigid links' numbers, if that is all that it does: it has no columns of its
    /// own then.
    fn carried(&self, _: &Arm, _: Spot) -> Option<Carried> {
        None
    }

    /// For how many numbers it counts: a direction, and a body, count once.
    fn things(&self) -> usize {
        self.numbers().len()
    }

    /// Whether a thing of this kind may have such values.
    fn may_be(&self, _: &[f64]) -> bool {
        true
    }

    /// The effect that must stand at the same place before: what this one adds to.
    fn beside(&self) -> Option<&'static str> {
        None
    }

    /// Effects that each of its joints has of its own on any such arm, large or small: they stand beside it even
    /// where the log does not tell them from zero, and it does not take their part.
    fn along(&self) -> &'static [&'static str] {
        &[]
    }

    /// Whether the robot file has it at a spot, and it is in the torques: what adds to it may be there.
    fn in_file(&self, _: &Scene<'_>, _: Spot) -> bool {
        false
    }

    /// Why this log cannot show it; `None` if it may.
    fn excluded(&self, _: &Scene<'_>) -> Option<String> {
        None
    }

    /// Why a log is too slow for it at a spot, where these values are `found`; `None` if it is not.
    fn too_slow(&self, _: &Pace<'_>, _: Spot, _found: Option<&[f64]>) -> Option<String> {
        None
    }

    /// Adds its values at a spot to the file's own entries, and names them; `None` if these hold no such
    /// thing: it stands in an `[[effect]]` table then. Torques only: currents have no entries.
    fn write(&self, _: &mut RobotFile<'_>, _: Spot, _: &[f64]) -> Option<String> {
        None
    }
}

/// All that are known, in the order in which `stiffarm` lists them.
pub static CATALOGUE: [&dyn LogEffect; 25] = [
    &coulomb_friction::CoulombFriction,
    &viscous_friction::ViscousFriction,
    &friction_curve::FrictionCurve,
    &stribeck::Stribeck,
    &presliding::Presliding,
    &load_friction::LoadFriction,
    &torque_saturation::TorqueSaturation,
    &asymmetric_friction::AsymmetricFriction,
    &torque_offset::TorqueOffset,
    &torque_scale::TorqueScale,
    &rotor_inertia::RotorInertia,
    &link_inertia::LinkInertia,
    &payload::Payload,
    &gravity_direction::GravityDirection,
    &counterbalance::Counterbalance,
    &joint_coupling::JointCoupling,
    &torque_ripple::TorqueRipple,
    &joint_elasticity::JointElasticity,
    &warm_up::WarmUp::ByMinute,
    &warm_up::WarmUp::ByKelvin,
    &torque_latency::TorqueLatency,
    &latency::Latency,
    &tracking_lag::TrackingLag,
    &servo_droop::ServoDroop,
    &backlash::Backlash,
];

/// What the simple model of a drive has.
pub(super) const COULOMB: &dyn LogEffect = &coulomb_friction::CoulombFriction;
pub(super) const VISCOUS: &dyn LogEffect = &viscous_friction::ViscousFriction;
pub(super) const OFFSET: &dyn LogEffect = &torque_offset::TorqueOffset;

/// What the simple model of servos has.
pub(super) const LATENCY: &dyn LogEffect = &latency::Latency;

/// What a log has a joint's spring as: in rows of commands, and of torques.
pub(super) const DROOP: &dyn LogEffect = &servo_droop::ServoDroop;
pub(super) const ELASTICITY: &dyn LogEffect = &joint_elasticity::JointElasticity;

/// What the robot file tells of its links.
pub(super) const LINKS: &dyn LogEffect = &link_inertia::LinkInertia;

/// The catalogue as a table in Markdown, as it stands in `docs/logs.md`.
pub fn markdown() -> String {
    let mut text = String::from(
        "| effect | rows | numbers | what the arm does | confused with | what separates them |\n\
         |---|---|---|---|---|---|\n",
    );
    for effect in CATALOGUE {
        let about = effect.about();
        let rows = if effect.domain() == Domain::Torque { "torque" } else { "position" };
        let numbers = effect.numbers().iter().map(|(name, unit)| format!("{name} ({unit})"));
        let numbers: Vec<String> = numbers.collect();
        let cells = [about.reality, about.confused_with, about.separated_by].join(" | ");
        let (name, numbers) = (effect.identifier(), numbers.join(", "));
        text.push_str(&format!("| `{name}` | {rows} | {numbers} | {cells} |\n"));
    }
    text
}

/// Ten numbers of a body of which one is a unit.
fn units() -> impl Iterator<Item = [f64; 10]> {
    (0..10).map(|k| std::array::from_fn(|l| f64::from(u8::from(k == l))))
}

/// Names of the ten numbers of a body, as the regressor has them.
const BODY: [Number; 10] = [
    ("m", "kg"),
    ("mx", "kg·m"),
    ("my", "kg·m"),
    ("mz", "kg·m"),
    ("xx", "kg·m²"),
    ("xy", "kg·m²"),
    ("yy", "kg·m²"),
    ("xz", "kg·m²"),
    ("yz", "kg·m²"),
    ("zz", "kg·m²"),
];

/// Why a motor's own cannot be seen; `None` where the torque is the motor's.
fn behind_the_gear(scene: &Scene<'_>) -> Option<String> {
    let link = scene.side == Some(TorqueSide::Link);
    link.then(|| "the torque is measured behind the gear, where no motor is felt".to_owned())
}

/// Why nothing can be told by the robot file's masses; `None` where it has some and torques are N·m.
fn weightless(scene: &Scene<'_>) -> Option<String> {
    let weightless = scene.arm.joints.iter().all(|joint| joint.mass == 0.0);
    let current = scene.side == Some(TorqueSide::Current);
    if weightless {
        return Some("the robot file has no mass: give its rows `mass` and `com`".to_owned());
    }
    current
        .then(|| "a current tells no weight: its newton-metres per ampere are unknown".to_owned())
}

/// All joints.
fn joints(scene: &Scene<'_>) -> Vec<Spot> {
    (0..scene.signals.joints()).map(Spot::Joint).collect()
}

/// The row of a joint in the robot file.
fn row(spot: Spot) -> Place {
    Place::Joint(joint(spot) + 1)
}

/// The joint of a spot that is one.
fn joint(spot: Spot) -> usize {
    match spot {
        Spot::Joint(joint) | Spot::Pair(joint, ..) | Spot::Link(joint) => joint,
        Spot::Base | Spot::Tool(_) | Spot::Arm | Spot::Interface => 0,
    }
}
