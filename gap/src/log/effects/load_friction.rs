//! A gear brakes the more the more it carries.

use super::{LogEffect, Number, Spot, joint, joints};
use crate::effects::About;
use crate::log::scene::{Column, Domain, Scene};

/// A torque against the motion, `part · |τ| sign(q̇)`.
#[derive(Clone, Copy, Debug)]
pub struct LoadFriction;

impl LogEffect for LoadFriction {
    fn identifier(&self) -> &'static str {
        "load_friction"
    }

    fn about(&self) -> About {
        About {
            reality: "A gear brakes the more the more it carries.",
            signature: "Friction in proportion to the size of the torque, against the motion.",
            confused_with: "`coulomb_friction` under a load that does not change; `torque_saturation`, the moment of a link.",
            separated_by: "The same motion with and without a payload.",
        }
    }

    fn domain(&self) -> Domain {
        Domain::Torque
    }

    fn spots(&self, scene: &Scene<'_>) -> Vec<Spot> {
        joints(scene)
    }

    fn numbers(&self) -> &'static [Number] {
        &[("part", "1")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        let mut column = scene.column(joint, |k| scene.sign(joint, k));
        for (_, rows) in &mut column.parts {
            rows.iter_mut().zip(&scene.loads.rigid[joint]).for_each(|(x, load)| *x *= load.abs());
        }
        vec![column]
    }

    fn beside(&self) -> Option<&'static str> {
        Some("coulomb_friction")
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0
    }
}
