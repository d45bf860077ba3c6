//! A spring between two links takes part of the weight off a joint.

use super::{LogEffect, Number, Spot, joint};
use crate::effects::About;
use crate::effects::{self, Effect};
use crate::log::scene::{Column, Scene};

/// Torque on the joint as a sine of its value, as a spring of no free length between two points of its
/// neighbours makes it.
#[derive(Clone, Copy, Debug)]
pub struct Counterbalance;

impl LogEffect for Counterbalance {
    fn identifier(&self) -> &'static str {
        "counterbalance"
    }

    fn about(&self) -> About {
        About {
            reality: "A spring between two links takes part of the weight off a joint: a gravity compensator.",
            signature: "A torque that is a sine of the joint's value, whatever the others do.",
            confused_with: "The moment of the link that the joint moves, which changes with the joints below it.",
            separated_by: "Postures of the joints below it; nothing where these are upright axes.",
        }
    }

    fn spots(&self, scene: &Scene<'_>) -> Vec<Spot> {
        let places = effects::Counterbalance.places(scene.arm);
        places.into_iter().map(|place| Spot::Joint(place.row())).collect()
    }

    fn numbers(&self) -> &'static [Number] {
        &[("cos", "N·m"), ("sin", "N·m")]
    }

    fn things(&self) -> usize {
        1
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        let q = &scene.signals.q[joint];
        vec![scene.column(joint, |k| q[k].cos()), scene.column(joint, |k| q[k].sin())]
    }
}
