use crate::effects::prelude::*;

/// Torque on the joint as a sine of its reading, as a spring of no free length between two points of
/// its neighbours makes it; of a longer one the largest part.
///
/// Its motion per unit is what the joint gives.
#[derive(Clone, Copy, Debug)]
pub struct Counterbalance;

/// An axis that leans no more than this (the sine) is level: a base may stand askew.
const LEVEL: f64 = 0.15;

/// Joint values in whose postures axes are looked at: none is special.
const POSTURES: [f64; 3] = [0.0, 0.7, -1.9];

const AT_REST: &Facts = &Facts {
    identifier: "counterbalance",
    reality: "A spring between two links takes part of the weight off a joint: a gravity \
        compensator.",
    signature: "A torque that is a sine of the joint's reading, and turns it by what it gives.",
    confused_with: "`transmission_error` of order 1, which moves a joint the same way as long as \
        it gives in proportion to its torque; `link_com` of what it carries.",
    separated_by: "The arm itself: whether there is one can be seen. A joint whose stiffness \
        changes with its torque tells them apart.",
    formula: "τ → τ + cos · cos q + sin · sin q",
    parameters: &[
        Parameter::free("cos", Quantity::Moment),
        Parameter::free("sin", Quantity::Moment),
    ],
    moves: Moves::Joint,
    idle: "the joint is rigid: the robot file has no stiffness of it, and none was found",
    // Few arms have one, and at one joint; who has one knows of it. What does the same without one is named
    // first where the data do not decide.
    odds: 100,
    ..Facts::NONE
};

impl Law for Counterbalance {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for Counterbalance {
    /// Joints that turn about an axis that is level in every posture.
    fn places(&self, arm: &Arm) -> Vec<Place> {
        // Gravity is told in the base's axes, the Jacobian in those in which the base stands.
        let up = arm.base.rotation * arm.gravity.normalize();
        let jacobian = |q: f64| {
            let q: Vec<f64> = (0..arm.dof()).map(|k| q * (1.0 + 0.3 * k as f64)).collect();
            arm.jacobian(&q)
        };
        let postures = POSTURES.map(jacobian);
        let leans = |axis: Vector3<f64>| axis.dot(&up).abs();
        let is_level = |joint: &usize| {
            let mut axes = postures.iter().map(|j| j.fixed_view::<3, 1>(3, *joint).into_owned());
            axes.all(|axis| leans(axis) <= LEVEL)
        };
        let turns = |joint: &usize| arm.joints[*joint].motion == Motion::Revolute;
        let level = (0..arm.dof()).filter(turns).filter(is_level);
        level.map(|joint| Place::Joint(joint + 1)).collect()
    }

    fn acts_at(&self) -> &'static str {
        "joints that turn about a level axis"
    }

    fn alter(&self, actual: &mut Actual<'_>, row: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        let (sine, cosine) = row.q[spot.row()].sin_cos();
        actual.pull(spot.row(), v[0] * cosine + v[1] * sine);
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        let gives = scene.state.gives(scene.actual, spot.row());
        let (sine, cosine) = scene.row.q[spot.row()].sin_cos();
        motions.extend([gives * cosine, gives * sine]);
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let most = told.sized(told.norm(&["cos", "sin"]));
        format!("a spring turns {} by up to {most}", told.place)
    }
}

/// Torque on the joint as a sine of its value, as a spring of no free length between two points of its
/// neighbours makes it.
#[derive(Clone, Copy, Debug)]
pub struct CounterbalanceInMotion;

const TORQUE: &Facts = &Facts {
    identifier: "counterbalance",
    reality: "A spring between two links takes part of the weight off a joint: a gravity \
        compensator.",
    signature: "A torque that is a sine of the joint's value, whatever the others do.",
    confused_with: "The moment of the link that the joint moves, which changes with the joints \
        below it.",
    separated_by: "Postures of the joints below it; nothing where these are upright axes.",
    formula: "τ → τ + cos · cos q + sin · sin q",
    parameters: &[
        Parameter::free("cos", Quantity::Moment),
        Parameter::free("sin", Quantity::Moment),
    ],
    ..Facts::TORQUE
};

impl Law for CounterbalanceInMotion {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for CounterbalanceInMotion {
    fn spots(&self, scene: &LogScene<'_>) -> Vec<Spot> {
        Counterbalance.places(scene.arm).into_iter().map(Spot::at).collect()
    }

    fn columns(&self, scene: &LogScene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = spot.row();
        let q = &scene.signals.q[joint];
        vec![scene.column(joint, |k| q[k].cos()), scene.column(joint, |k| q[k].sin())]
    }
}
