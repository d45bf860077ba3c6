//! A torque is told too large or too small: the motor's constant, or the sensor's, is off.

use super::{LogEffect, Number, Spot, joint};
use crate::effects::About;
use crate::log::scene::{Column, Scene};

/// What the rigid links ask is told `1 + scale` times. Of all joints together only a load whose mass is known
/// tells it: free masses take up everything else.
#[derive(Clone, Copy, Debug)]
pub struct TorqueScale;

impl LogEffect for TorqueScale {
    fn identifier(&self) -> &'static str {
        "torque_scale"
    }

    fn about(&self) -> About {
        About {
            reality: "A torque is told too large or too small: the motor's constant, or the sensor's, is off.",
            signature: "A torque in proportion to what the joint carries.",
            confused_with: "All inertias, exactly so if all joints have the same.",
            separated_by: "A known payload: the same motion with and without.",
        }
    }

    fn spots(&self, scene: &Scene<'_>) -> Vec<Spot> {
        [Spot::Arm].into_iter().chain(super::joints(scene)).collect()
    }

    fn numbers(&self) -> &'static [Number] {
        &[("scale", "1")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        if spot != Spot::Arm {
            let joint = joint(spot);
            return vec![
                scene.column(joint, |k| scene.loads.rigid[joint][k] + scene.modelled(joint, k)),
            ];
        }
        let known = scene.loads.known.iter().enumerate();
        let parts = known.map(|(joint, load)| (joint, scene.signals.filtered(load)));
        vec![Column { parts: parts.collect() }]
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] > -1.0
    }
}
