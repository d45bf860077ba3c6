//! Friction falls when a joint begins to move.

use super::{LogEffect, Number, Spot, joint};
use crate::effects::About;
use crate::log::scene::{Column, Scene};

/// A torque against the motion beside Coulomb's, `torque · exp(−(q̇/speed)²) sign(q̇)` (Armstrong-Hélouvry,
/// Dupont & Canudas de Wit 1994, eq. 5).
#[derive(Clone, Copy, Debug)]
pub struct Stribeck;

/// Speeds from which the search begins, rad/s: what gears have.
const SPEEDS: [f64; 5] = [0.01, 0.022, 0.05, 0.11, 0.24];

impl LogEffect for Stribeck {
    fn identifier(&self) -> &'static str {
        "stribeck"
    }

    fn about(&self) -> About {
        About {
            reality: "Friction falls when a joint begins to move: a film of grease builds up.",
            signature: "More torque at slow motion than at somewhat faster motion.",
            confused_with: "`friction_curve`, a sign that is smoothed.",
            separated_by: "Speeds below 0.05 rad/s.",
        }
    }

    fn numbers(&self) -> &'static [Number] {
        &[("torque", "N·m"), ("speed", "rad/s")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, values: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        let (size, speed) = (values[0], values[1]);
        let fall = |k: usize| (-(scene.signals.qd[joint][k] / speed).powi(2)).exp();
        let by_speed = |k: usize| 2.0 * (scene.signals.qd[joint][k]).powi(2) / speed.powi(3);
        let slope = |k: usize| size * by_speed(k) * fall(k) * scene.sign(joint, k);
        vec![
            scene.column(joint, |k| fall(k) * scene.sign(joint, k)),
            if size == 0.0 { scene.nothing(joint) } else { scene.column(joint, slope) },
        ]
    }

    fn bends(&self) -> bool {
        true
    }

    fn value(&self, scene: &Scene<'_>, spot: Spot, values: &[f64]) -> Column {
        if values[0] == 0.0 {
            return scene.nothing(joint(spot));
        }
        let mut column = self.columns(scene, spot, values).swap_remove(0);
        let rows = column.parts.iter_mut().flat_map(|(_, rows)| rows);
        rows.for_each(|x| *x *= values[0]);
        column
    }

    fn probes(&self, _: &Scene<'_>, _: Spot) -> Vec<Vec<f64>> {
        SPEEDS.iter().map(|speed| vec![0.0, *speed]).collect()
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0 && values[1] > 0.0
    }

    fn beside(&self) -> Option<&'static str> {
        Some("coulomb_friction")
    }
}
