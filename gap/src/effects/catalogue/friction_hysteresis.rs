//! Friction that grows with the load holds the joint back on the way to its pose: a wind-up in
//! proportion to torque.

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

use crate::effects::scene::direction;
use crate::effects::{
    About, Carrier, Depends, Effect, Group, Parameter, Place, Quantity, Scene, Spot, Told, joints,
};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment, Site, axis};

/// Wind-up per torque, against the direction of approach.
#[derive(Clone, Copy, Debug)]
pub struct FrictionHysteresis;

impl Effect for FrictionHysteresis {
    fn identifier(&self) -> &'static str {
        "friction_hysteresis"
    }

    fn about(&self) -> About {
        About {
            reality: "Friction that grows with the load holds the joint back on the way to its \
                      pose: a wind-up in proportion to torque.",
            signature: "Of the sign of the last move, and larger under load.",
            confused_with: "`backlash`, whose size does not depend on the torque; \
                            `joint_compliance` if every pose is approached from one side.",
            separated_by: "Approach from both sides under small and large loads.",
        }
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        joints(arm)
    }

    fn parameters(&self, arm: &Arm, spot: Spot) -> Vec<Parameter> {
        let quantity = Quantity::of(
            arm.joints[spot.row()].motion,
            [Quantity::AnglePerMoment, Quantity::LengthPerForce],
        );
        vec![Parameter::at_least("windup", quantity, 0.0)]
    }

    fn alter(&self, actual: &mut Actual<'_>, row: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        let axis = axis(actual.arm.joints[spot.row()].motion);
        let windup = -v[0] * direction(row, spot.row());
        let law = move |load: &Vector6<f64>| Vector6::ith(axis, windup * load[axis].abs());
        actual.laws.push((Site::Joint(spot.row()), Box::new(law)));
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(Carrier::Joint(spot.row()))
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        let torque = scene.state.torque[spot.row()].abs();
        motions.push(-scene.direction(spot.row()) * torque);
    }

    fn idle(&self) -> &'static str {
        "no direction of approach is given for the joint, or no load reaches it"
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Direction)
    }

    fn depends(&self) -> Depends {
        Depends::Direction
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("friction winds {} up by {}", told.place, told.size())
    }
}
