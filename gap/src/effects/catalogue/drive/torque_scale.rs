use crate::effects::prelude::*;

/// What the rigid links ask is told `1 + scale` times. Of all joints together only a load whose mass is known
/// tells it: free masses take up everything else.
#[derive(Clone, Copy, Debug)]
pub struct TorqueScale;

const TORQUE: &Facts = &Facts {
    identifier: "torque_scale",
    reality: "A torque is told too large or too small: the motor's constant, or the sensor's, is \
        off.",
    signature: "A torque in proportion to what the joint carries.",
    confused_with: "All inertias, exactly so if all joints have the same.",
    separated_by: "A known payload: the same motion with and without.",
    formula: "τ → (1 + scale) τ",
    // Torque constants of one type of motor scatter by a tenth in makers' data sheets.
    parameters: &[Parameter::at_least("scale", Quantity::Ratio, (-1.0_f64).next_up()).usually(0.1)],
    at: At::JointsAndArm,
    ..Facts::TORQUE
};

impl Law for TorqueScale {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for TorqueScale {
    fn is_of_loads(&self) -> bool {
        true
    }

    fn columns(&self, scene: &LogScene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        if spot.place != Place::Arm {
            let joint = spot.row();
            return vec![
                scene.column(joint, |k| scene.loads.rigid[joint][k] + scene.modelled(joint, k)),
            ];
        }
        let known = scene.loads.known.iter().enumerate();
        let parts = known.map(|(joint, load)| (joint, scene.signals.filtered(load)));
        vec![Column { parts: parts.collect() }]
    }
}
