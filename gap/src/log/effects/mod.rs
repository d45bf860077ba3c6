//! What may be missing from the model of a moving arm: one file each.

mod backlash;
mod coulomb_friction;
mod friction_curve;
mod joint_coupling;
mod latency;
mod load_friction;
mod rotor_inertia;
mod servo_droop;
mod stribeck;
mod torque_offset;
mod torque_saturation;
mod tracking_lag;
mod viscous_friction;
mod warm_up;

use std::fmt;

use super::scene::{Column, Domain, Scene};
use crate::effects::About;

/// Where an effect of a log acts; joints count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spot {
    /// A joint.
    Joint(usize),
    /// A motor that turns with the sum of two joints' values (1) or with their difference (−1).
    Pair(usize, usize, i8),
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
            Spot::Interface => f.write_str("the interface"),
        }
    }
}

impl Spot {
    /// Whether both act on one joint.
    pub fn meets(self, other: Spot) -> bool {
        let joints = |spot| match spot {
            Spot::Joint(joint) => Some([joint, joint]),
            Spot::Pair(a, b, _) => Some([a, b]),
            Spot::Interface => None,
        };
        match (joints(self), joints(other)) {
            (Some(mine), Some(theirs)) => mine.iter().any(|joint| theirs.contains(joint)),
            _ => true,
        }
    }
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
    fn domain(&self) -> Domain;

    /// Where on this arm it may act.
    fn spots(&self, scene: &Scene<'_>) -> Vec<Spot>;

    /// Its numbers; all zero is no effect. Currents stand in place of torques where they drive.
    fn numbers(&self) -> &'static [Number];

    /// Its change of the rows per unit of each number, where they have these values.
    fn columns(&self, scene: &Scene<'_>, spot: Spot, values: &[f64]) -> Vec<Column>;

    /// Its change of the rows; `None` where it is in proportion to its numbers.
    fn value(&self, _: &Scene<'_>, _: Spot, _: &[f64]) -> Option<Column> {
        None
    }

    /// Values at which it does nothing, and its columns say whether the rows ask for it.
    fn probes(&self) -> Vec<Vec<f64>> {
        vec![vec![0.0; self.numbers().len()]]
    }

    /// Values from which to look for its own.
    fn starts(&self) -> Vec<Vec<f64>> {
        self.probes()
    }

    /// Whether a thing of this kind may have such values.
    fn may_be(&self, _: &[f64]) -> bool {
        true
    }

    /// The effect that must stand at the same place before: what this one adds to.
    fn beside(&self) -> Option<&'static str> {
        None
    }

    /// Why this log cannot show it; `None` if it may.
    fn excluded(&self, _: &Scene<'_>) -> Option<String> {
        None
    }
}

/// All that are known, in the order in which `stiffarm` lists them.
pub static CATALOGUE: [&dyn LogEffect; 14] = [
    &coulomb_friction::CoulombFriction,
    &viscous_friction::ViscousFriction,
    &friction_curve::FrictionCurve,
    &stribeck::Stribeck,
    &load_friction::LoadFriction,
    &torque_saturation::TorqueSaturation,
    &torque_offset::TorqueOffset,
    &rotor_inertia::RotorInertia,
    &joint_coupling::JointCoupling,
    &warm_up::WarmUp,
    &latency::Latency,
    &tracking_lag::TrackingLag,
    &servo_droop::ServoDroop,
    &backlash::Backlash,
];

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

/// All joints.
fn joints(scene: &Scene<'_>) -> Vec<Spot> {
    (0..scene.signals.joints()).map(Spot::Joint).collect()
}

/// The joint of a spot that is one.
fn joint(spot: Spot) -> usize {
    match spot {
        Spot::Joint(joint) | Spot::Pair(joint, _, _) => joint,
        Spot::Interface => 0,
    }
}
