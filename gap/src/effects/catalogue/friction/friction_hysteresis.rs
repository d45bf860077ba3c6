use crate::effects::prelude::*;

/// Wind-up per torque, against the direction of approach.
#[derive(Clone, Copy, Debug)]
pub struct FrictionHysteresis;

const AT_REST: &Facts = &Facts {
    identifier: "friction_hysteresis",
    reality: "Friction that grows with the load holds the joint back on the way to its pose: a \
        wind-up in proportion to torque.",
    signature: "Of the sign of the last move, and larger under load.",
    confused_with: "`backlash`, whose size does not depend on the torque; `joint_compliance` if \
        every pose is approached from one side.",
    separated_by: "Approach from both sides under small and large loads.",
    formula: "Δq = −windup · |τ| · direction",
    parameters: &[Parameter::at_least("windup", Quantity::AnglePerMoment, 0.0)],
    moves: Moves::Joint,
    idle: "no direction of approach is given for the joint, or no load reaches it",
    group: Some(Group::Direction),
    depends: Depends::Direction,
    ..Facts::NONE
};

impl Law for FrictionHysteresis {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for FrictionHysteresis {
    fn gives(&self, row: &Row, spot: Spot) -> Option<Gives> {
        let direction = direction(row, spot.row());
        Some(Box::new(move |torque| -direction * torque.abs()))
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("friction winds {} up by {}", told.place, told.size())
    }
}
