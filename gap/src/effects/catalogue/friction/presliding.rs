use crate::effects::prelude::*;

/// Of Coulomb's friction the part `torque` builds up over a `distance` behind each reversal (Dahl 1968):
/// `distance · z' = q̇ (1 − z sign q̇)`, of which `torque · (z − sign q̇)` is the change.
#[derive(Clone, Copy, Debug)]
pub struct Presliding;

/// Distances from which the search begins, rad.
const DISTANCES: [f64; 5] = [3e-4, 1e-3, 3e-3, 1e-2, 3e-2];

/// A joint that turns round slides again after about so much, rad or m: teeth and rollers give by
/// hundredths.
const GIVES: f64 = 0.01;

const TORQUE: &Facts = &Facts {
    identifier: "presliding",
    reality: "Teeth and rollers give a little before a joint that turns round slides.",
    signature: "Friction that comes back by and by behind a reversal.",
    confused_with: "`stribeck`, `latency`, a sign that is smoothed.",
    separated_by: "Small reversals, and large ones.",
    formula: "τ → τ + torque · (z − sign q̇), distance · z′ = q̇ (1 − z sign q̇)",
    parameters: &[
        Parameter::at_least("torque", Quantity::Moment, 0.0),
        Parameter::positive("distance", Quantity::Angle),
    ],
    beside: Some("coulomb_friction"),
    bends: true,
    ..Facts::TORQUE
};

impl Law for Presliding {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for Presliding {
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, values: &[f64]) -> Vec<Column> {
        let (joint, [torque, distance]) = (spot.row(), [values[0], values[1]]);
        let here = bristles(scene, joint, distance);
        let built = scene.column(joint, |k| here[k] - scene.sign(joint, k));
        if torque == 0.0 {
            return vec![built, scene.nothing(joint)];
        }
        let [less, more] =
            [1.0 - SLOPE_STEP, 1.0 + SLOPE_STEP].map(|by| bristles(scene, joint, by * distance));
        let slope = torque / (2.0 * SLOPE_STEP * distance);
        vec![built, scene.column(joint, |k| slope * (more[k] - less[k]))]
    }

    fn value(&self, scene: &LogScene<'_>, spot: Spot, values: &[f64]) -> Column {
        let joint = spot.row();
        if values[0] == 0.0 {
            return scene.nothing(joint);
        }
        let here = bristles(scene, joint, values[1]);
        scene.column(joint, |k| values[0] * (here[k] - scene.sign(joint, k)))
    }

    fn probes(&self, _: &LogScene<'_>, _: Spot) -> Vec<Vec<f64>> {
        DISTANCES.iter().map(|distance| vec![0.0, *distance]).collect()
    }

    fn too_slow(&self, pace: &Pace<'_>, spot: Spot, found: Option<&[f64]>) -> Option<String> {
        let (signals, joint) = (pace.signals, spot.row());
        let slides = 2.0 * (2.0 * GIVES / pace.acceleration(joint)).sqrt();
        (slides < signals.reach() && found.is_none()).then(|| {
            format!(
                "its reversals are over in {} s, and the band of {} Hz spreads them over {} s: log faster, or turn \
                 round more gently",
                round(slides),
                round(signals.band),
                round(signals.reach())
            )
        })
    }
}

/// How far the bristles are bent, −1 to 1: exactly, where the joint moves one way between two samples.
fn bristles(scene: &LogScene<'_>, joint: usize, distance: f64) -> Vec<f64> {
    let (q, ways) = (&scene.signals.q[joint], &scene.signals.ways[joint]);
    let mut bent = ways.first().map_or(0.0, |way| f64::from(*way));
    let mut before = q.first().copied().unwrap_or(0.0);
    let next = |at: &f64| {
        let moved = at - before;
        before = *at;
        let way = moved.signum();
        bent = way + (bent - way) * (-moved.abs() / distance).exp();
        bent
    };
    q.iter().map(next).collect()
}
