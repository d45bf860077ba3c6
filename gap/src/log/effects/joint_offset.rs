//! A joint stands beside its command by the same angle everywhere.

use super::{LogEffect, Number, Spot, joint, joints};
use crate::effects::About;
use crate::log::scene::{Column, Domain, Scene};

/// A constant.
#[derive(Clone, Copy, Debug)]
pub struct JointOffset;

impl LogEffect for JointOffset {
    fn identifier(&self) -> &'static str {
        "joint_offset"
    }

    fn about(&self) -> About {
        About {
            reality: "A joint stands beside its command by the same angle everywhere: zeros of command and \
                      reading differ.",
            signature: "The same error at any posture, speed and direction.",
            confused_with: "`servo_droop` of a joint that turns little; `backlash` of one that is always \
                            driven from one side.",
            separated_by: "A full turn in both directions, with and without load.",
        }
    }

    fn domain(&self) -> Domain {
        Domain::Position
    }

    fn spots(&self, scene: &Scene<'_>) -> Vec<Spot> {
        joints(scene)
    }

    fn numbers(&self) -> &'static [Number] {
        &[("offset", "rad")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        vec![scene.column(joint(spot), |_| 1.0)]
    }
}
