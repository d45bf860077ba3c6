use crate::effects::prelude::*;

/// A torque against the motion, `part · |τ| sign(q̇)`.
#[derive(Clone, Copy, Debug)]
pub struct LoadFriction;

const TORQUE: &Facts = &Facts {
    identifier: "load_friction",
    reality: "A gear brakes the more the more it carries.",
    signature: "Friction in proportion to the size of the torque, against the motion.",
    confused_with: "`coulomb_friction` under a load that does not change; `torque_saturation`, \
        the moment of a link.",
    separated_by: "The same motion with and without a payload.",
    formula: "τ → τ + part · |τ| sign(q̇)",
    parameters: &[Parameter::at_least("part", Quantity::Ratio, 0.0)],
    beside: Some("coulomb_friction"),
    ..Facts::TORQUE
};

impl Law for LoadFriction {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for LoadFriction {
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = spot.row();
        let load = &scene.loads.rigid[joint];
        vec![scene.column(joint, |k| scene.sign(joint, k) * load[k].abs())]
    }
}
