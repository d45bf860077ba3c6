//! Dumas et al. 2011, eqs. 4 and 20-21.

use crate::effects::prelude::*;

/// Compliance of a joint, added to what the arm's model has there.
#[derive(Clone, Copy, Debug)]
pub struct JointCompliance;

const AT_REST: &Facts = &Facts {
    identifier: "joint_compliance",
    reality: "The joint twists in proportion to its torque.",
    signature: "A turn about the joint's axis, in proportion to the moment of loads and weights \
        about it.",
    confused_with: "`link_compliance` of its link, which moves the tool by almost the same twist \
        when the load comes from beyond the link's end; `base_compliance` (joint 1); a wrong \
        weight.",
    separated_by: "Loads in several directions at folded and at stretched poses.",
    formula: "Δq = compliance · τ",
    moves: Moves::Joint,
    idle: "no load of this data reaches the joint",
    group: Some(Group::Elastic),
    ..Facts::NONE
};

impl Law for JointCompliance {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for JointCompliance {
    /// One: the added compliance. The joint as a whole cannot be less than rigid, so the least is
    /// minus what the model has.
    fn parameters(&self, arm: &Arm, spot: Spot) -> Vec<Parameter> {
        let joint = &arm.joints[spot.row()];
        let quantity =
            Quantity::of(joint.motion, [Quantity::AnglePerMoment, Quantity::LengthPerForce]);
        // 0.0 − c, and not −c, for a rigid joint's 0 to be positive.
        vec![Parameter::at_least("compliance", quantity, 0.0 - joint.compliance)]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        let joint = &mut actual.arm.to_mut().joints[spot.row()];
        joint.compliance = (joint.compliance + v[0]).max(0.0);
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        motions.push(scene.state.torque[spot.row()]);
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let yields = if told.numbers.iter().any(|p| p.unit == "m/N") { "yields" } else { "twists" };
        let compared = told.by_sign("less", "more");
        format!("{} {yields} {} {compared} than modelled", told.place, told.size())
    }

    fn spring<'a>(&self, arm: &'a Arm, place: Place) -> Option<&'a Joint> {
        arm.joints.get(place.row())
    }

    fn curve<'a>(&self, numbers: &'a [ParameterReport]) -> Option<Curve<'a>> {
        let compliance = numbers.first()?.value;
        let value = Box::new(move |torque| compliance * torque);
        Some(Curve { over: Over::Torque, proportional: true, value })
    }
}

/// The link lags behind the encoder at the motor by `compliance · τ` (Spong 1987): all joints feel the weights, speeds and
/// accelerations of a link that is elsewhere than is read, to first order.
#[derive(Clone, Copy, Debug)]
pub struct JointElasticity;

const TORQUE: &Facts = &Facts {
    identifier: "joint_elasticity",
    law_of: "joint_compliance",
    reality: "A gear gives, and the encoder stands before it: the link goes another way than is \
        read.",
    signature: "A torque that goes with the second rate of what the joint carries, times its \
        inertia, and one that goes with its weight as the link sags.",
    confused_with: "`rotor_inertia`, `latency`, `torque_ripple`.",
    separated_by: "An encoder at the link; fast motion in folded and stretched postures.",
    formula: "τ → τ(q − compliance · τ)",
    parameters: &[Parameter::at_least("compliance", Quantity::AnglePerMoment, 0.0)],
    ..Facts::TORQUE
};

impl Law for JointElasticity {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for JointElasticity {
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let (joint, signals) = (spot.row(), scene.signals);
        let load = signals.smoothed(&scene.loads.rigid[joint]);
        let loads = rate(&load, signals.period);
        let bent = [rate(&loads, signals.period), loads, load];
        let most = bent[2].iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let by = if most > 0.0 { SMALL_MOVE / most } else { 0.0 };
        vec![scene.of_all(&scene.when_moved(joint, by, &bent))]
    }

    fn is_of_loads(&self) -> bool {
        true
    }

    fn excluded(&self, scene: &LogScene<'_>) -> Option<String> {
        behind_the_gear(scene)
    }
}

/// So many postures of the log show whether a joint feels weights.
const POSTURES: usize = 50;

/// The joint gives way to the weights, `compliance · g`, `g` the weights' torque about its axis.
#[derive(Clone, Copy, Debug)]
pub struct ServoDroop;

const POSITION: &Facts = &Facts {
    identifier: "servo_droop",
    law_of: "joint_compliance",
    reality: "A servo without an integral part stands where its error makes the torque that the \
        weights ask for.",
    signature: "An offset from the command that goes with the moment of the weights, at rest too.",
    confused_with: "The moment of a link, a wrong zero; `joint_compliance` of a campaign at rest \
        is the same seen from outside.",
    separated_by: "Holds with and without load.",
    formula: "q − q_cmd = compliance · g",
    parameters: &[Parameter::at_least("compliance", Quantity::AnglePerMoment, 0.0)],
    ..Facts::POSITION
};

impl Law for ServoDroop {
    fn facts(&self) -> &'static Facts {
        POSITION
    }
}

impl InMotion for ServoDroop {
    fn spots(&self, scene: &LogScene<'_>) -> Vec<Spot> {
        // A joint about a vertical axis feels rounding alone.
        let signals = scene.signals;
        let mut most = vec![0.0_f64; signals.joints()];
        for k in (0..signals.t.len()).step_by(signals.t.len().div_ceil(POSTURES)) {
            let q: Vec<f64> = signals.q.iter().map(|q| q[k]).collect();
            let torques = scene.arm.weight_torque(&q);
            most.iter_mut().zip(torques.iter()).for_each(|(m, x)| *m = m.max(x.abs()));
        }
        let all = most.iter().copied().fold(0.0, f64::max);
        let feels = |spot: &Spot| most[spot.row()] > ROUNDING * all;
        At::Joints.places(scene.arm).into_iter().map(Spot::at).filter(feels).collect()
    }

    fn columns(&self, scene: &LogScene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = spot.row();
        vec![Column::of(joint, scene.weights()[0][joint].clone())]
    }

    fn excluded(&self, scene: &LogScene<'_>) -> Option<String> {
        weightless(scene)
    }
}
