use crate::effects::prelude::*;

/// A torque against the motion, `viscous · q̇`.
#[derive(Clone, Copy, Debug)]
pub struct ViscousFriction;

const TORQUE: &Facts = &Facts {
    identifier: "viscous_friction",
    reality: "A joint is braked in proportion to its speed: grease, seals, the back electromotive \
        force.",
    signature: "A torque in proportion to the speed.",
    confused_with: "`friction_curve`; `latency` of what is driven by a torque.",
    separated_by: "Three speeds or more, in both directions.",
    formula: "τ → τ + viscous · q̇",
    parameters: &[Parameter::at_least("viscous", Quantity::In("N·m·s/rad"), 0.0)],
    ..Facts::TORQUE
};

impl Law for ViscousFriction {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for ViscousFriction {
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = spot.row();
        vec![scene.column(joint, |k| scene.signals.qd[joint][k])]
    }

    fn file_value(&self, arm: &Arm, side: Option<TorqueSide>, spot: Spot) -> f64 {
        of_drive(arm, side, spot, |drive| drive.viscous)
    }

    fn write(&self, file: &mut RobotFile<'_>, spot: Spot, values: &[f64]) -> Option<String> {
        file.at_row(spot.place, |row| {
            row.joint.drive.viscous =
                Some(significant((row.nominal.drive.viscous + values[0]).max(0.0)));
            "viscous"
        })
    }
}
