//! A joint is braked more one way than the other.

use super::{LogEffect, Number, Spot, joint};
use crate::effects::About;
use crate::log::scene::{Column, Scene};

/// A torque that is the same both ways as long as the joint moves: half of what friction one way is larger
/// than the other way.
#[derive(Clone, Copy, Debug)]
pub struct AsymmetricFriction;

impl LogEffect for AsymmetricFriction {
    fn identifier(&self) -> &'static str {
        "asymmetric_friction"
    }

    fn about(&self) -> About {
        About {
            reality: "A joint is braked more one way than the other.",
            signature: "A torque that is there only while the joint moves, the same both ways.",
            confused_with: "`torque_offset`, which is there at rest too; the moment of a link.",
            separated_by: "A full turn in both directions, with rests.",
        }
    }

    fn numbers(&self) -> &'static [Number] {
        &[("half_difference", "N·m")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        let (speeds, still) = (&scene.signals.qd[joint], scene.still[joint]);
        // A joint that turns round does not rest.
        let rests = |k: usize| {
            let around = &speeds[k.saturating_sub(1)..(k + 2).min(speeds.len())];
            around.iter().all(|speed| speed.abs() <= still)
        };
        vec![scene.column(joint, |k| f64::from(u8::from(!rests(k))))]
    }

    fn beside(&self) -> Option<&'static str> {
        Some("coulomb_friction")
    }
}
