//! A gear brakes the more the more it carries.

use super::{LogEffect, Number, Spot, joint};
use crate::effects::About;
use crate::log::scene::{Column, Scene};

/// A torque against the motion, `part · |τ| sign(q̇)`.
#[derive(Clone, Copy, Debug)]
pub struct LoadFriction;

impl LogEffect for LoadFriction {
    fn identifier(&self) -> &'static str {
        "load_friction"
    }

    fn about(&self) -> About {
        About {
            reality: "A gear brakes the more the more it carries.",
            signature: "Friction in proportion to the size of the torque, against the motion.",
            confused_with: "`coulomb_friction` under a load that does not change; `torque_saturation`, the moment of a link.",
            separated_by: "The same motion with and without a payload.",
        }
    }

    fn numbers(&self) -> &'static [Number] {
        &[("part", "1")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        let load = &scene.loads.rigid[joint];
        vec![scene.column(joint, |k| scene.sign(joint, k) * load[k].abs())]
    }

    fn beside(&self) -> Option<&'static str> {
        Some("coulomb_friction")
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0
    }
}
