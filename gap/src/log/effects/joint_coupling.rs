//! One motor turns with two joints.

use super::{LogEffect, Number, Spot};
use crate::effects::About;
use crate::log::scene::{Column, Scene};

/// A motor whose angle is the sum (or the difference) of two joints' values: its inertia, viscous and
/// Coulomb friction act on both, beside what is each joint's own (Stäubli's wrist: Gautier, Janot &
/// Vandanjon 2013, eq. 39).
#[derive(Clone, Copy, Debug)]
pub struct JointCoupling;

impl LogEffect for JointCoupling {
    fn identifier(&self) -> &'static str {
        "joint_coupling"
    }

    fn about(&self) -> About {
        About {
            reality: "One motor turns with two joints, as in wrists whose drives run through each other.",
            signature: "A joint's torque goes with the speed and the acceleration of another.",
            confused_with: "The two joints' own friction and rotors.",
            separated_by: "Motion of one of the two joints alone.",
        }
    }

    /// Neighbours whose axes turn, both ways.
    fn spots(&self, scene: &Scene<'_>) -> Vec<Spot> {
        let pairs = (1..scene.signals.joints()).map(|b| (b - 1, b));
        pairs.flat_map(|(a, b)| [Spot::Pair(a, b, 1), Spot::Pair(a, b, -1)]).collect()
    }

    fn numbers(&self) -> &'static [Number] {
        &[("inertia", "kg·m²"), ("viscous", "N·m·s/rad"), ("coulomb", "N·m")]
    }

    /// Gears and bearings of each joint that the other's motor does not turn.
    fn along(&self) -> &'static [&'static str] {
        &["coulomb_friction", "viscous_friction"]
    }

    /// What the motor feels of its own joint stands in that joint's numbers; here is what it feels of
    /// the other one. Its sign is one for both.
    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let Spot::Pair(a, b, sum) = spot else { return Vec::new() };
        let sum = f64::from(sum);
        let (qd, qdd) = (&scene.signals.qd, &scene.signals.qdd);
        let crossed = |of: &[Vec<f64>]| {
            let parts = [(a, b), (b, a)].map(|(on, from)| scene.column(on, |k| sum * of[from][k]));
            Column { parts: parts.into_iter().flat_map(|column| column.parts).collect() }
        };
        let way = |k: usize| (qd[a][k] + sum * qd[b][k]).signum();
        let mut brake = scene.column(a, way);
        brake.parts.extend(scene.column(b, |k| sum * way(k)).parts);
        vec![crossed(qdd), crossed(qd), brake]
    }
}
