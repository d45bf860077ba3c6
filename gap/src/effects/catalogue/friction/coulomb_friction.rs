use crate::effects::prelude::*;

/// A torque against the motion, `coulomb · sign(q̇)`.
#[derive(Clone, Copy, Debug)]
pub struct CoulombFriction;

const TORQUE: &Facts = &Facts {
    identifier: "coulomb_friction",
    reality: "A joint that moves is braked by the same torque at any speed.",
    signature: "A step of the torque where the joint turns round.",
    confused_with: "`torque_offset` of a joint that moves one way; `stribeck`, `load_friction`.",
    separated_by: "Motion in both directions, at three speeds or more.",
    formula: "τ → τ + coulomb · sign(q̇)",
    parameters: &[Parameter::at_least("coulomb", Quantity::Moment, 0.0)],
    ..Facts::TORQUE
};

impl Law for CoulombFriction {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for CoulombFriction {
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = spot.row();
        vec![scene.column(joint, |k| scene.sign(joint, k))]
    }

    fn file_value(&self, arm: &Arm, side: Option<TorqueSide>, spot: Spot) -> f64 {
        of_drive(arm, side, spot, |drive| drive.coulomb)
    }

    fn write(&self, file: &mut RobotFile<'_>, spot: Spot, values: &[f64]) -> Option<String> {
        file.at_row(spot.place, |row| {
            row.joint.drive.coulomb =
                Some(significant((row.nominal.drive.coulomb + values[0]).max(0.0)));
            "coulomb"
        })
    }
}
