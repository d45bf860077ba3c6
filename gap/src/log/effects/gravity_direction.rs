//! The base does not stand as the robot file has it: gravity pulls another way.

use super::{LogEffect, Number, Spot, weightless};
use crate::effects::About;
use crate::log::scene::{Column, Scene};

/// The base is turned about its own axes by small angles, and with it the weights of the robot file.
#[derive(Clone, Copy, Debug)]
pub struct GravityDirection;

impl LogEffect for GravityDirection {
    fn identifier(&self) -> &'static str {
        "gravity_direction"
    }

    fn about(&self) -> About {
        About {
            reality: "The base does not stand as the robot file has it: gravity pulls another way.",
            signature: "Moments of weights about axes that ought to be upright.",
            confused_with: "Moments of links, exactly so about axes that stay level.",
            separated_by: "Turning the base; large turns of joint 1.",
        }
    }

    fn spots(&self, _: &Scene<'_>) -> Vec<Spot> {
        vec![Spot::Base]
    }

    fn numbers(&self) -> &'static [Number] {
        &[("rx", "rad"), ("ry", "rad"), ("rz", "rad")]
    }

    fn things(&self) -> usize {
        1
    }

    fn columns(&self, scene: &Scene<'_>, _: Spot, _: &[f64]) -> Vec<Column> {
        // The drives hold what the weights pull.
        let held = |pulls: &Vec<f64>| pulls.iter().map(|x| -x).collect();
        let column = |turned: &Vec<Vec<f64>>| Column {
            parts: turned.iter().map(held).enumerate().collect(),
        };
        scene.weights()[1..].iter().map(column).collect()
    }

    fn excluded(&self, scene: &Scene<'_>) -> Option<String> {
        weightless(scene)
    }
}
