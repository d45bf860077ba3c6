//! A joint is braked in proportion to its speed: grease, seals, the back electromotive force.

use super::{LogEffect, Number, Spot, joint, joints};
use crate::effects::About;
use crate::log::scene::{Column, Domain, Scene};

/// A torque against the motion, `viscous · q̇`.
#[derive(Clone, Copy, Debug)]
pub struct ViscousFriction;

impl LogEffect for ViscousFriction {
    fn identifier(&self) -> &'static str {
        "viscous_friction"
    }

    fn about(&self) -> About {
        About {
            reality: "A joint is braked in proportion to its speed: grease, seals, the back electromotive force.",
            signature: "A torque in proportion to the speed.",
            confused_with: "`friction_curve`; `latency` of what is driven by a torque.",
            separated_by: "Three speeds or more, in both directions.",
        }
    }

    fn domain(&self) -> Domain {
        Domain::Torque
    }

    fn spots(&self, scene: &Scene<'_>) -> Vec<Spot> {
        joints(scene)
    }

    fn numbers(&self) -> &'static [Number] {
        &[("viscous", "N·m·s/rad")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        vec![scene.column(joint, |k| scene.signals.qd[joint][k])]
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0
    }
}
