use crate::effects::prelude::*;

/// A torque against the motion beside Coulomb's, `torque · exp(−(q̇/speed)²) sign(q̇)` (Armstrong-Hélouvry,
/// Dupont & Canudas de Wit 1994, eq. 5).
#[derive(Clone, Copy, Debug)]
pub struct Stribeck;

/// Speeds from which the search begins, rad/s: what gears have.
const SPEEDS: [f64; 5] = [0.01, 0.022, 0.05, 0.11, 0.24];

const TORQUE: &Facts = &Facts {
    identifier: "stribeck",
    reality: "Friction falls when a joint begins to move: a film of grease builds up.",
    signature: "More torque at slow motion than at somewhat faster motion.",
    confused_with: "`friction_curve`, a sign that is smoothed.",
    separated_by: "Speeds below 0.05 rad/s.",
    formula: "τ → τ + torque · exp(−(q̇/speed)²) sign(q̇)",
    parameters: &[
        Parameter::at_least("torque", Quantity::Moment, 0.0),
        Parameter::positive("speed", Quantity::In("rad/s")),
    ],
    beside: Some("coulomb_friction"),
    bends: true,
    ..Facts::TORQUE
};

impl Law for Stribeck {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for Stribeck {
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, values: &[f64]) -> Vec<Column> {
        let joint = spot.row();
        let (size, speed) = (values[0], values[1]);
        let fall = |k: usize| (-(scene.signals.qd[joint][k] / speed).powi(2)).exp();
        let by_speed = |k: usize| 2.0 * (scene.signals.qd[joint][k]).powi(2) / speed.powi(3);
        let slope = |k: usize| size * by_speed(k) * fall(k) * scene.sign(joint, k);
        vec![
            scene.column(joint, |k| fall(k) * scene.sign(joint, k)),
            if size == 0.0 { scene.nothing(joint) } else { scene.column(joint, slope) },
        ]
    }

    fn value(&self, scene: &LogScene<'_>, spot: Spot, values: &[f64]) -> Column {
        if values[0] == 0.0 {
            return scene.nothing(spot.row());
        }
        let mut column = self.columns(scene, spot, values).swap_remove(0);
        let rows = column.parts.iter_mut().flat_map(|(_, rows)| rows);
        rows.for_each(|x| *x *= values[0]);
        column
    }

    fn probes(&self, _: &LogScene<'_>, _: Spot) -> Vec<Vec<f64>> {
        SPEEDS.iter().map(|speed| vec![0.0, *speed]).collect()
    }
}
