//! A link is heavier, or otherwise balanced, than the robot file says.

use super::{BODY, Carried, LogEffect, Number, Spot, units, weightless};
use crate::effects::About;
use crate::log::scene::{Column, Scene};
use stiffarm_kernels::generic::Arm;

/// Ten numbers of a link, in its row's frame, beyond those of the robot file.
#[derive(Clone, Copy, Debug)]
pub struct LinkInertia;

impl LogEffect for LinkInertia {
    fn identifier(&self) -> &'static str {
        "link_inertia"
    }

    fn about(&self) -> About {
        About {
            reality: "A link is heavier, or otherwise balanced, than the robot file says.",
            signature: "Torques of the joints below, as the link's weight and acceleration ask.",
            confused_with: "Neighbouring links, exactly so in the numbers that only their sum shows; `payload`.",
            separated_by: "Folded and stretched postures, slow and fast.",
        }
    }

    fn spots(&self, scene: &Scene<'_>) -> Vec<Spot> {
        (0..scene.signals.joints()).map(Spot::Link).collect()
    }

    fn numbers(&self) -> &'static [Number] {
        &BODY
    }

    fn things(&self) -> usize {
        1
    }

    fn columns(&self, _: &Scene<'_>, _: Spot, _: &[f64]) -> Vec<Column> {
        Vec::new()
    }

    fn carried(&self, _: &Arm, spot: Spot) -> Option<Carried> {
        let Spot::Link(link) = spot else { return None };
        Some(Carried { link, run: None, numbers: units().collect() })
    }

    fn excluded(&self, scene: &Scene<'_>) -> Option<String> {
        weightless(scene)
    }
}
