//! The rotor of the motor turns with the gear ratio: the joint is heavier than its link, about its own axis alone.

use super::{LogEffect, Number, Spot, joint, joints};
use crate::effects::About;
use crate::log::read::TorqueSide;
use crate::log::scene::{Column, Domain, Scene};

/// A torque `inertia · q̈`, the inertia as the joint feels it (rotor times the square of the ratio).
#[derive(Clone, Copy, Debug)]
pub struct RotorInertia;

impl LogEffect for RotorInertia {
    fn identifier(&self) -> &'static str {
        "rotor_inertia"
    }

    fn about(&self) -> About {
        About {
            reality: "The rotor of the motor turns with the gear ratio: the joint is heavier than its link, about its own axis alone.",
            signature: "A torque in proportion to the acceleration, the same at any posture.",
            confused_with: "The inertia of the link about the axis, exactly so at joint 1.",
            separated_by: "Folded and stretched postures.",
        }
    }

    fn domain(&self) -> Domain {
        Domain::Torque
    }

    fn spots(&self, scene: &Scene<'_>) -> Vec<Spot> {
        joints(scene)
    }

    fn numbers(&self) -> &'static [Number] {
        &[("inertia", "kg·m²")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        vec![scene.column(joint, |k| scene.signals.qdd[joint][k])]
    }

    fn excluded(&self, scene: &Scene<'_>) -> Option<String> {
        let link = scene.side == Some(TorqueSide::Link);
        link.then(|| "the torque is measured behind the gear, where no rotor is felt".to_owned())
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0
    }
}
