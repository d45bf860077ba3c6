use crate::effects::prelude::*;

/// A torque `inertia · q̈`, the inertia as the joint feels it (rotor times the square of the ratio).
#[derive(Clone, Copy, Debug)]
pub struct RotorInertia;

const TORQUE: &Facts = &Facts {
    identifier: "rotor_inertia",
    reality: "The rotor of the motor turns with the gear ratio: the joint is heavier than its \
        link, about its own axis alone.",
    signature: "A torque in proportion to the acceleration, the same at any posture.",
    confused_with: "The inertia of the link about the axis, exactly so at joint 1.",
    separated_by: "Folded and stretched postures.",
    formula: "τ → τ + inertia · q̈",
    parameters: &[Parameter::at_least("inertia", Quantity::In("kg·m²"), 0.0)],
    ..Facts::TORQUE
};

impl Law for RotorInertia {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for RotorInertia {
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = spot.row();
        vec![scene.column(joint, |k| scene.signals.qdd[joint][k])]
    }

    fn file_value(&self, arm: &Arm, side: Option<TorqueSide>, spot: Spot) -> f64 {
        of_drive(arm, side, spot, |drive| drive.gear * drive.gear * drive.rotor_inertia)
    }

    fn excluded(&self, scene: &LogScene<'_>) -> Option<String> {
        behind_the_gear(scene)
    }

    fn write(&self, file: &mut RobotFile<'_>, spot: Spot, values: &[f64]) -> Option<String> {
        file.at_row(spot.place, |row| {
            let drive = &row.nominal.drive;
            // The file's is at the motor.
            let rotor = drive.rotor_inertia + values[0] / (drive.gear * drive.gear);
            row.joint.drive.rotor_inertia = Some(significant(rotor.max(0.0)));
            "rotor_inertia"
        })
    }
}
