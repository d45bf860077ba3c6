//! A servo without an integral part stands where its error makes the torque that the weights ask for.

use super::{LogEffect, Number, Spot, joint, joints};
use crate::effects::About;
use crate::log::scene::{Column, Domain, Scene};

/// Torques below this part of the largest are none.
const ROUNDING: f64 = 1e-9;

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
        let most = |rows: &Vec<f64>| rows.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let all = scene.weights.iter().map(most).fold(0.0, f64::max);
        let feels = |spot: &Spot| most(&scene.weights[joint(*spot)]) > ROUNDING * all;
        joints(scene).into_iter().filter(feels).collect()
    }

    fn numbers(&self) -> &'static [Number] {
        &[("compliance", "rad/(N·m)")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        vec![Column::of(joint, scene.weights[joint].clone())]
    }

    fn excluded(&self, scene: &Scene<'_>) -> Option<String> {
        let weightless = scene.arm.joints.iter().all(|joint| joint.mass == 0.0);
        weightless.then(|| "the robot file has no mass: give its rows `mass` and `com`".to_owned())
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0
    }
}
