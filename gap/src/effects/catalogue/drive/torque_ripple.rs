use crate::effects::prelude::*;

/// A torque of so many periods per turn of the joint, of the orders that stand out of what a simple model leaves.
#[derive(Clone, Copy, Debug)]
pub struct TorqueRipple;

const TORQUE: &Facts = &Facts {
    identifier: "torque_ripple",
    reality: "The torque of a motor, or the teeth of a gear, go up and down as it turns.",
    signature: "A torque that is periodic in the joint's angle.",
    confused_with: "`joint_elasticity`; of low orders the moment of a link and `counterbalance`.",
    separated_by: "Three slow speeds.",
    formula: "τ → τ + cos · cos(order q) + sin · sin(order q)",
    parameters: &[
        Parameter::free("order", Quantity::Ratio),
        Parameter::free("cos", Quantity::Moment),
        Parameter::free("sin", Quantity::Moment),
    ],
    bends: true,
    ..Facts::TORQUE
};

impl Law for TorqueRipple {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for TorqueRipple {
    /// The order is not sought by its slope: it is what stood out.
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, values: &[f64]) -> Vec<Column> {
        let (joint, order) = (spot.row(), values[0]);
        let q = &scene.signals.q[joint];
        let wave = |of: fn(f64) -> f64| scene.column(joint, |k| of(order * q[k]));
        vec![scene.nothing(joint), wave(f64::cos), wave(f64::sin)]
    }

    fn value(&self, scene: &LogScene<'_>, spot: Spot, values: &[f64]) -> Column {
        let (joint, [order, cos, sin]) = (spot.row(), [values[0], values[1], values[2]]);
        if [cos, sin] == [0.0; 2] {
            return scene.nothing(joint);
        }
        let q = &scene.signals.q[joint];
        scene.column(joint, |k| cos * (order * q[k]).cos() + sin * (order * q[k]).sin())
    }

    fn too_slow(&self, pace: &Pace<'_>, spot: Spot, found: Option<&[f64]>) -> Option<String> {
        let band = pace.signals.band;
        let highest = TAU * PASSES * band / pace.slow(spot.row());
        (highest < *ORDERS.end() as f64 && found.is_none()).then(|| {
            format!(
                "the band of {} Hz lets orders of up to {highest:.0} through at its slow speeds: log faster, or move \
                 more slowly",
                round(band)
            )
        })
    }

    fn probes(&self, scene: &LogScene<'_>, spot: Spot) -> Vec<Vec<f64>> {
        scene.ripples[spot.row()].iter().map(|order| vec![*order, 0.0, 0.0]).collect()
    }
}
