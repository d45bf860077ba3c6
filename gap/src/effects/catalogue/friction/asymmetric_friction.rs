use crate::effects::prelude::*;

/// A torque that is the same both ways as long as the joint moves: half of what friction one way is larger
/// than the other way.
#[derive(Clone, Copy, Debug)]
pub struct AsymmetricFriction;

const TORQUE: &Facts = &Facts {
    identifier: "asymmetric_friction",
    reality: "A joint is braked more one way than the other.",
    signature: "A torque that is there only while the joint moves, the same both ways.",
    confused_with: "`torque_offset`, which is there at rest too; the moment of a link.",
    separated_by: "A full turn in both directions, with rests.",
    formula: "τ → τ + half_difference, while it moves",
    parameters: &[Parameter::free("half_difference", Quantity::Moment)],
    beside: Some("coulomb_friction"),
    ..Facts::TORQUE
};

impl Law for AsymmetricFriction {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for AsymmetricFriction {
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = spot.row();
        let (speeds, still) = (&scene.signals.qd[joint], scene.still[joint]);
        // A joint that turns round does not rest.
        let rests = |k: usize| {
            let around = &speeds[k.saturating_sub(1)..(k + 2).min(speeds.len())];
            around.iter().all(|speed| speed.abs() <= still)
        };
        vec![scene.column(joint, |k| f64::from(u8::from(!rests(k))))]
    }
}
