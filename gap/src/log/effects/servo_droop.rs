//! A servo without an integral part stands where its error makes the torque that the weights ask for.

use super::{LogEffect, Number, Spot, joint, joints, weightless};
use crate::effects::About;
use crate::log::scene::{Column, Domain, Scene};

/// Torques below this part of the largest are none.
const ROUNDING: f64 = 1e-9;

/// So many postures of the log show whether a joint feels weights.
const POSTURES: usize = 50;

/// The joint gives way to the weights, `compliance · g`, `g` the weights' torque about its axis.
#[derive(Clone, Copy, Debug)]
pub struct ServoDroop;

impl LogEffect for ServoDroop {
    fn identifier(&self) -> &'static str {
        "servo_droop"
    }

    fn about(&self) -> About {
        About {
            reality: "A servo without an integral part stands where its error makes the torque that the weights ask for.",
            signature: "An offset from the command that goes with the moment of the weights, at rest too.",
            confused_with: "The moment of a link, a wrong zero; `joint_compliance` of a campaign at rest is the same seen from outside.",
            separated_by: "Holds with and without load.",
        }
    }

    fn domain(&self) -> Domain {
        Domain::Position
    }

    fn spots(&self, scene: &Scene<'_>) -> Vec<Spot> {
        // A joint about a vertical axis feels rounding alone.
        let signals = scene.signals;
        let mut most = vec![0.0_f64; signals.joints()];
        for k in (0..signals.t.len()).step_by(signals.t.len().div_ceil(POSTURES)) {
            let q: Vec<f64> = signals.q.iter().map(|q| q[k]).collect();
            let torques = scene.arm.weight_torque(&q);
            most.iter_mut().zip(torques.iter()).for_each(|(m, x)| *m = m.max(x.abs()));
        }
        let all = most.iter().copied().fold(0.0, f64::max);
        let feels = |spot: &Spot| most[joint(*spot)] > ROUNDING * all;
        joints(scene).into_iter().filter(feels).collect()
    }

    fn numbers(&self) -> &'static [Number] {
        &[("compliance", "rad/(N·m)")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        vec![Column::of(joint, scene.weights()[0][joint].clone())]
    }

    fn excluded(&self, scene: &Scene<'_>) -> Option<String> {
        weightless(scene)
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0
    }
}
