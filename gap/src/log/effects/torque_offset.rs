//! A torque or current is told from a wrong zero, or friction differs between the two ways.

use super::{LogEffect, Number, Spot, joint};
use crate::effects::About;
use crate::log::scene::{Column, Scene};

/// A constant.
#[derive(Clone, Copy, Debug)]
pub struct TorqueOffset;

impl LogEffect for TorqueOffset {
    fn identifier(&self) -> &'static str {
        "torque_offset"
    }

    fn about(&self) -> About {
        About {
            reality: "A torque or current is told from a wrong zero, or friction differs between the two ways.",
            signature: "The same torque at any posture, speed and direction.",
            confused_with: "The moment of a link, where the joint turns little; `coulomb_friction` where it moves one way.",
            separated_by: "A full turn in both directions.",
        }
    }

    fn numbers(&self) -> &'static [Number] {
        &[("offset", "N·m")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        vec![scene.column(joint(spot), |_| 1.0)]
    }
}
