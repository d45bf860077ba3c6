use crate::effects::prelude::*;

/// What is told beyond the torque, `part · τ |τ|`.
#[derive(Clone, Copy, Debug)]
pub struct TorqueSaturation;

const TORQUE: &Facts = &Facts {
    identifier: "torque_saturation",
    reality: "A motor gives less torque per ampere the more it carries: its iron saturates.",
    signature: "A torque that is off by its own square, with its sign.",
    confused_with: "`load_friction`, the moment of a link.",
    separated_by: "The same motion with and without a payload.",
    formula: "τ → τ + part · τ |τ|",
    parameters: &[Parameter::at_least("part", Quantity::In("1/(N·m)"), 0.0)],
    beside: Some("coulomb_friction"),
    ..Facts::TORQUE
};

impl Law for TorqueSaturation {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for TorqueSaturation {
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = spot.row();
        let (rigid, friction) = (&scene.loads.rigid[joint], &scene.loads.friction[joint]);
        let load = |k: usize| rigid[k] + friction[k];
        vec![scene.column(joint, |k| load(k) * load(k).abs())]
    }

    fn excluded(&self, scene: &LogScene<'_>) -> Option<String> {
        behind_the_gear(scene)
    }
}
