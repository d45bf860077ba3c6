//! Friction falls while the arm runs warm.

use super::{LogEffect, Number, Spot, joint, joints};
use crate::effects::About;
use crate::log::scene::{Column, Domain, Scene};

/// A torque `rate · t q̇`, the viscous friction that comes with each minute.
#[derive(Clone, Copy, Debug)]
pub struct WarmUp;

impl LogEffect for WarmUp {
    fn identifier(&self) -> &'static str {
        "warm_up"
    }

    fn about(&self) -> About {
        About {
            reality: "Friction falls while the arm runs warm.",
            signature: "Viscous friction that changes with the time since the start.",
            confused_with: "Any friction, where the motion changes with time too.",
            separated_by: "The same motion cold and warm.",
        }
    }

    fn domain(&self) -> Domain {
        Domain::Torque
    }

    fn spots(&self, scene: &Scene<'_>) -> Vec<Spot> {
        joints(scene)
    }

    fn numbers(&self) -> &'static [Number] {
        &[("rate", "N·m·s/rad/min")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        let (speed, time) = (&scene.signals.qd[joint], &scene.signals.t);
        vec![scene.column(joint, |k| speed[k] * time[k] / 60.0)]
    }

    fn beside(&self) -> Option<&'static str> {
        Some("viscous_friction")
    }
}
