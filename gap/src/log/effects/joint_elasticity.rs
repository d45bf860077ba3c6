//! A gear gives, and the encoder stands before it: the link goes another way than is read.

use super::{LogEffect, Number, Spot, behind_the_gear, joint};
use crate::effects::About;
use crate::log::scene::{Column, Scene};
use crate::log::signal::filter::rate;

/// The link lags behind the encoder at the motor by `compliance · τ`, so that its inertia feels
/// `−compliance · τ̈` more (Spong 1987, to first order; the change of the weights' moment is left out).
#[derive(Clone, Copy, Debug)]
pub struct JointElasticity;

impl LogEffect for JointElasticity {
    fn identifier(&self) -> &'static str {
        "joint_elasticity"
    }

    fn about(&self) -> About {
        About {
            reality: "A gear gives, and the encoder stands before it: the link goes another way than is read.",
            signature: "A torque that goes with the second rate of what the joint carries, times its inertia.",
            confused_with: "`rotor_inertia`, `latency`, `torque_ripple`.",
            separated_by: "An encoder at the link; fast motion in folded and stretched postures.",
        }
    }

    fn numbers(&self) -> &'static [Number] {
        &[("compliance", "rad/(N·m)")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let (joint, signals) = (joint(spot), scene.signals);
        let load = signals.smoothed(&scene.loads.rigid[joint]);
        let bent = rate(&rate(&load, signals.period), signals.period);
        let inertia = &scene.inertias()[joint];
        vec![scene.column(joint, |k| -inertia[k] * bent[k])]
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0
    }

    fn excluded(&self, scene: &Scene<'_>) -> Option<String> {
        behind_the_gear(scene)
    }
}
