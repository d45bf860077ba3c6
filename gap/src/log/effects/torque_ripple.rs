//! The torque of a motor, or the teeth of a gear, go up and down as it turns.

use core::f64::consts::TAU;

use super::{LogEffect, Number, Spot, joint};
use crate::effects::About;
use crate::log::pace::{ORDERS, PASSES, Pace, round};
use crate::log::scene::{Column, Scene};

/// A torque of so many periods per turn of the joint, of the orders that stand out of what a simple model leaves.
#[derive(Clone, Copy, Debug)]
pub struct TorqueRipple;

impl LogEffect for TorqueRipple {
    fn identifier(&self) -> &'static str {
        "torque_ripple"
    }

    fn about(&self) -> About {
        About {
            reality: "The torque of a motor, or the teeth of a gear, go up and down as it turns.",
            signature: "A torque that is periodic in the joint's angle.",
            confused_with: "`joint_elasticity`; of low orders the moment of a link and `counterbalance`.",
            separated_by: "Three slow speeds.",
        }
    }

    fn numbers(&self) -> &'static [Number] {
        &[("order", "1"), ("cos", "N·m"), ("sin", "N·m")]
    }

    fn things(&self) -> usize {
        1
    }

    /// The order is not sought by its slope: it is what stood out.
    fn columns(&self, scene: &Scene<'_>, spot: Spot, values: &[f64]) -> Vec<Column> {
        let (joint, order) = (joint(spot), values[0]);
        let q = &scene.signals.q[joint];
        let wave = |of: fn(f64) -> f64| scene.column(joint, |k| of(order * q[k]));
        vec![scene.nothing(joint), wave(f64::cos), wave(f64::sin)]
    }

    fn bends(&self) -> bool {
        true
    }

    fn value(&self, scene: &Scene<'_>, spot: Spot, values: &[f64]) -> Column {
        let (joint, [order, cos, sin]) = (joint(spot), [values[0], values[1], values[2]]);
        if [cos, sin] == [0.0; 2] {
            return scene.nothing(joint);
        }
        let q = &scene.signals.q[joint];
        scene.column(joint, |k| cos * (order * q[k]).cos() + sin * (order * q[k]).sin())
    }

    fn too_slow(&self, pace: &Pace<'_>, spot: Spot, found: Option<&[f64]>) -> Option<String> {
        let band = pace.signals.band;
        let highest = TAU * PASSES * band / pace.slow(joint(spot));
        (highest < *ORDERS.end() as f64 && found.is_none()).then(|| {
            format!(
                "the band of {} Hz lets orders of up to {highest:.0} through at its slow speeds: log faster, or move \
                 more slowly",
                round(band)
            )
        })
    }

    fn probes(&self, scene: &Scene<'_>, spot: Spot) -> Vec<Vec<f64>> {
        scene.ripples[joint(spot)].iter().map(|order| vec![*order, 0.0, 0.0]).collect()
    }
}
