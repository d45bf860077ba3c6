//! A joint that moves is braked by the same torque at any speed.

use super::{LogEffect, Number, Spot, joint, joints};
use crate::effects::About;
use crate::log::scene::{Column, Domain, Scene};

/// A torque against the motion, `coulomb · sign(q̇)`.
#[derive(Clone, Copy, Debug)]
pub struct CoulombFriction;

impl LogEffect for CoulombFriction {
    fn identifier(&self) -> &'static str {
        "coulomb_friction"
    }

    fn about(&self) -> About {
        About {
            reality: "A joint that moves is braked by the same torque at any speed.",
            signature: "A step of the torque where the joint turns round.",
            confused_with: "`torque_offset` of a joint that moves one way; `stribeck`, `load_friction`.",
            separated_by: "Motion in both directions, at three speeds or more.",
        }
    }

    fn domain(&self) -> Domain {
        Domain::Torque
    }

    fn spots(&self, scene: &Scene<'_>) -> Vec<Spot> {
        joints(scene)
    }

    fn numbers(&self) -> &'static [Number] {
        &[("coulomb", "N·m")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        vec![scene.column(joint, |k| scene.sign(joint, k))]
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0
    }
}
