use crate::effects::prelude::*;

/// The whole width of the dead band; the joint rests half of it to the side of its torque.
#[derive(Clone, Copy, Debug)]
pub struct LoadedBacklash;

/// From this torque on (N·m; a force, N) the joint lies on a flank; below, the oil and friction of its
/// gear hold it in between, in proportion.
const FLOATS: f64 = 1.0;

/// The flank on which a joint rests under a torque, −1 to 1.
fn flank(torque: f64) -> f64 {
    (torque / FLOATS).clamp(-1.0, 1.0)
}

const AT_REST: &Facts = &Facts {
    identifier: "loaded_backlash",
    reality: "A dead band in which the load decides: the joint rests on the flank to which its \
        torque pushes.",
    signature: "The same size at every load beyond 1 N·m, of the sign of the joint's torque.",
    confused_with: "`joint_offset` if the torque never changes its sign; `soft_zone` and \
        `joint_hardening` if it does but with one size; `transmission_error` of order 1 under \
        gravity alone.",
    separated_by: "One pose with loads that turn the joint either way.",
    formula: "Δq = ½ width · clamp(τ / 1 N·m, ±1)",
    parameters: &[Parameter::at_least("width", Quantity::Angle, 0.0).usually(5e-3)],
    moves: Moves::Joint,
    idle: "no load of this data reaches the joint",
    group: Some(Group::Nonlinear),
    ..Facts::NONE
};

impl Law for LoadedBacklash {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for LoadedBacklash {
    fn gives(&self, _: &Row, _: Spot) -> Option<Gives> {
        Some(Box::new(|torque| 0.5 * flank(torque)))
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!(
            "{} has {} of backlash and rests where its torque pushes it",
            told.place,
            told.size()
        )
    }

    fn curve<'a>(&self, numbers: &'a [ParameterReport]) -> Option<Curve<'a>> {
        let width = numbers.first()?.value;
        let value = Box::new(move |torque| 0.5 * width * flank(torque));
        Some(Curve { over: Over::Torque, proportional: false, value })
    }
}
