//! A motor gives less torque per ampere the more it carries: its iron saturates.

use super::{LogEffect, Number, Spot, behind_the_gear, joint};
use crate::effects::About;
use crate::log::scene::{Column, Scene};

/// What is told beyond the torque, `part · τ |τ|`.
#[derive(Clone, Copy, Debug)]
pub struct TorqueSaturation;

impl LogEffect for TorqueSaturation {
    fn identifier(&self) -> &'static str {
        "torque_saturation"
    }

    fn about(&self) -> About {
        About {
            reality: "A motor gives less torque per ampere the more it carries: its iron saturates.",
            signature: "A torque that is off by its own square, with its sign.",
            confused_with: "`load_friction`, the moment of a link.",
            separated_by: "The same motion with and without a payload.",
        }
    }

    fn numbers(&self) -> &'static [Number] {
        &[("part", "1/(N·m)")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        let (rigid, friction) = (&scene.loads.rigid[joint], &scene.loads.friction[joint]);
        let load = |k: usize| rigid[k] + friction[k];
        vec![scene.column(joint, |k| load(k) * load(k).abs())]
    }

    fn beside(&self) -> Option<&'static str> {
        Some("coulomb_friction")
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0
    }

    fn excluded(&self, scene: &Scene<'_>) -> Option<String> {
        behind_the_gear(scene)
    }
}
