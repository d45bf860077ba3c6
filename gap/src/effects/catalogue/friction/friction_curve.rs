use crate::effects::prelude::*;

/// A torque against the motion, `root · √|q̇| sign(q̇)`, beside Coulomb and viscous.
#[derive(Clone, Copy, Debug)]
pub struct FrictionCurve;

const TORQUE: &Facts = &Facts {
    identifier: "friction_curve",
    reality: "Friction rises with the speed, and the less the faster: lubricants thin as they are \
        sheared.",
    signature: "A friction curve that is bent between Coulomb and viscous.",
    confused_with: "`viscous_friction` over a narrow range of speeds; `stribeck`.",
    separated_by: "Three speeds or more, slow ones among them.",
    formula: "τ → τ + root · √|q̇| sign(q̇)",
    parameters: &[Parameter::free("root", Quantity::In("N·m/√(rad/s)"))],
    beside: Some("coulomb_friction"),
    ..Facts::TORQUE
};

impl Law for FrictionCurve {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for FrictionCurve {
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = spot.row();
        let speed = &scene.signals.qd[joint];
        vec![scene.column(joint, |k| speed[k].signum() * speed[k].abs().sqrt())]
    }
}
