use crate::effects::prelude::*;

/// A constant.
#[derive(Clone, Copy, Debug)]
pub struct TorqueOffset;

const TORQUE: &Facts = &Facts {
    identifier: "torque_offset",
    reality: "A torque or current is told from a wrong zero, or friction differs between the two \
        ways.",
    signature: "The same torque at any posture, speed and direction.",
    confused_with: "The moment of a link, where the joint turns little; `coulomb_friction` where \
        it moves one way.",
    separated_by: "A full turn in both directions.",
    formula: "τ → τ + offset",
    parameters: &[Parameter::free("offset", Quantity::Moment)],
    ..Facts::TORQUE
};

impl Law for TorqueOffset {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for TorqueOffset {
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        vec![scene.column(spot.row(), |_| 1.0)]
    }
}
