//! A joint is braked in proportion to its speed: grease, seals, the back electromotive force.

use super::{LogEffect, Number, Spot, joint, row};
use crate::effects::{About, RobotFile, significant};
use crate::log::read::TorqueSide;
use crate::log::scene::{Column, Scene};

/// A torque against the motion, `viscous · q̇`.
#[derive(Clone, Copy, Debug)]
pub struct ViscousFriction;

impl LogEffect for ViscousFriction {
    fn identifier(&self) -> &'static str {
        "viscous_friction"
    }

    fn about(&self) -> About {
        About {
            reality: "A joint is braked in proportion to its speed: grease, seals, the back electromotive force.",
            signature: "A torque in proportion to the speed.",
            confused_with: "`friction_curve`; `latency` of what is driven by a torque.",
            separated_by: "Three speeds or more, in both directions.",
        }
    }

    fn numbers(&self) -> &'static [Number] {
        &[("viscous", "N·m·s/rad")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        vec![scene.column(joint, |k| scene.signals.qd[joint][k])]
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0
    }

    fn in_file(&self, scene: &Scene<'_>, spot: Spot) -> bool {
        scene.side.is_some_and(TorqueSide::is_driven)
            && scene.arm.joints[joint(spot)].drive.viscous > 0.0
    }

    fn write(&self, file: &mut RobotFile<'_>, spot: Spot, values: &[f64]) -> Option<String> {
        file.at_row(row(spot), |row| {
            row.joint.drive.viscous = Some(significant(row.nominal.drive.viscous + values[0]));
            "viscous"
        })
    }
}
