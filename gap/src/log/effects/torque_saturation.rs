//! A motor gives less torque per ampere the more it carries: its iron saturates.

use super::{LogEffect, Number, Spot, joint, joints};
use crate::effects::About;
use crate::log::read::TorqueSide;
use crate::log::scene::{Column, Domain, Scene};

/// What is told beyond the torque, `part · τ |τ|`.
#[derive(Clone, Copy, Debug)]
pub struct TorqueSaturation;

impl LogEffect for TorqueSaturation {
    fn identifier(&self) -> &'static str {
        "torque_saturation"
    }

    fn about(&self) -> About {
        About {
            reality: "A motor gives less torque per ampere the more it carries: its iron saturates.",
            signature: "A torque that is off by its own square, with its sign.",
            confused_with: "`load_friction`, the moment of a link.",
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
        &[("part", "1/(N·m)")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        vec![Column::of(joint, scene.loads.whole[joint].iter().map(|x| x * x.abs()).collect())]
    }

    fn beside(&self) -> Option<&'static str> {
        Some("coulomb_friction")
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0
    }

    fn excluded(&self, scene: &Scene<'_>) -> Option<String> {
        let link = scene.side == Some(TorqueSide::Link);
        link.then(|| "the torque is measured behind the gear, not told by the motor".to_owned())
    }
}
