//! A position servo follows with an error: its damping over its stiffness, its inertia over its stiffness.

use super::{LogEffect, Number, Spot, joint};
use crate::effects::About;
use crate::log::scene::{Column, Domain, Scene};

/// The servo's law `K (q_cmd − q) = D q̇ + J q̈ + g`, of which `lag` is D/K and `inertia` J/K.
#[derive(Clone, Copy, Debug)]
pub struct TrackingLag;

impl LogEffect for TrackingLag {
    fn identifier(&self) -> &'static str {
        "tracking_lag"
    }

    fn about(&self) -> About {
        About {
            reality: "A position servo follows with an error: its damping over its stiffness, its inertia over its stiffness.",
            signature: "An error in proportion to the speed of the joint, and to its acceleration.",
            confused_with: "`latency`, which is the same time at every joint.",
            separated_by: "A chirp; joints moved one at a time.",
        }
    }

    fn domain(&self) -> Domain {
        Domain::Position
    }

    fn numbers(&self) -> &'static [Number] {
        &[("lag", "s"), ("inertia", "s²")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        let (qd, qdd) = (&scene.signals.qd[joint], &scene.signals.qdd[joint]);
        vec![scene.column(joint, |k| -qd[k]), scene.column(joint, |k| -qdd[k])]
    }

    /// A servo does not go ahead of what it follows; its inertia may be too small to have a sign.
    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0
    }
}
