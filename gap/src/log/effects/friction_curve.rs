//! Friction rises with the speed, and the less the faster: lubricants thin as they are sheared.

use super::{LogEffect, Number, Spot, joint};
use crate::effects::About;
use crate::log::scene::{Column, Scene};

/// A torque against the motion, `root · √|q̇| sign(q̇)`, beside Coulomb and viscous.
#[derive(Clone, Copy, Debug)]
pub struct FrictionCurve;

impl LogEffect for FrictionCurve {
    fn identifier(&self) -> &'static str {
        "friction_curve"
    }

    fn about(&self) -> About {
        About {
            reality: "Friction rises with the speed, and the less the faster: lubricants thin as they are sheared.",
            signature: "A friction curve that is bent between Coulomb and viscous.",
            confused_with: "`viscous_friction` over a narrow range of speeds; `stribeck`.",
            separated_by: "Three speeds or more, slow ones among them.",
        }
    }

    fn numbers(&self) -> &'static [Number] {
        &[("root", "N·m/√(rad/s)")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        let speed = &scene.signals.qd[joint];
        vec![scene.column(joint, |k| speed[k].signum() * speed[k].abs().sqrt())]
    }

    fn beside(&self) -> Option<&'static str> {
        Some("coulomb_friction")
    }
}
