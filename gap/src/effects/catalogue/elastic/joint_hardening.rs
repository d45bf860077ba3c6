use crate::effects::prelude::*;

/// Twist per cube of the torque; negative if the joint hardens.
#[derive(Clone, Copy, Debug)]
pub struct JointHardening;

const AT_REST: &Facts = &Facts {
    identifier: "joint_hardening",
    reality: "The joint's twist is nonlinear (cubic) in its torque: strain-wave gears stiffen \
        with load.",
    signature: "The twist per torque changes with the torque.",
    confused_with: "`joint_compliance` unless the torque takes several sizes.",
    separated_by: "At least three levels of load at one pose, both signs if it can be.",
    formula: "Δq = cubic · τ³",
    parameters: &[Parameter::free("cubic", Quantity::AnglePerMomentCubed).one_sided()],
    moves: Moves::Joint,
    idle: "no load of this data reaches the joint",
    group: Some(Group::Nonlinear),
    ..Facts::NONE
};

impl Law for JointHardening {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for JointHardening {
    fn gives(&self, _: &Row, _: Spot) -> Option<Gives> {
        Some(Box::new(|torque| torque.powi(3)))
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("{} has a stiffness that changes with its torque", told.place)
    }

    fn curve<'a>(&self, numbers: &'a [ParameterReport]) -> Option<Curve<'a>> {
        let cubic = numbers.first()?.value;
        let value = Box::new(move |torque: f64| cubic * torque.powi(3));
        Some(Curve { over: Over::Torque, proportional: false, value })
    }
}
