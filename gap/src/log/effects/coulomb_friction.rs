//! A joint that moves is braked by the same torque at any speed.

use super::{LogEffect, Number, Spot, joint, row};
use crate::effects::{About, RobotFile, significant};
use crate::log::read::TorqueSide;
use crate::log::scene::{Column, Scene};

/// A torque against the motion, `coulomb · sign(q̇)`.
#[derive(Clone, Copy, Debug)]
pub struct CoulombFriction;

impl LogEffect for CoulombFriction {
    fn identifier(&self) -> &'static str {
        "coulomb_friction"
    }

    fn about(&self) -> About {
        About {
            reality: "A joint that moves is braked by the same torque at any speed.",
            signature: "A step of the torque where the joint turns round.",
            confused_with: "`torque_offset` of a joint that moves one way; `stribeck`, `load_friction`.",
            separated_by: "Motion in both directions, at three speeds or more.",
        }
    }

    fn numbers(&self) -> &'static [Number] {
        &[("coulomb", "N·m")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        vec![scene.column(joint, |k| scene.sign(joint, k))]
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0
    }

    fn in_file(&self, scene: &Scene<'_>, spot: Spot) -> bool {
        scene.side.is_some_and(TorqueSide::is_driven)
            && scene.arm.joints[joint(spot)].drive.coulomb > 0.0
    }

    fn write(&self, file: &mut RobotFile<'_>, spot: Spot, values: &[f64]) -> Option<String> {
        file.at_row(row(spot), |row| {
            row.joint.drive.coulomb = Some(significant(row.nominal.drive.coulomb + values[0]));
            "coulomb"
        })
    }
}
