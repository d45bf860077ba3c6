//! The joint's twist is nonlinear (cubic) in its torque: strain-wave gears stiffen with load.

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

use crate::effects::{
    About, Carrier, Curve, Effect, Group, Over, Parameter, ParameterReport, Place, Quantity, Scene,
    Spot, Told, joints,
};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment, Site, axis};

/// Twist per cube of the torque; negative if the joint hardens.
#[derive(Clone, Copy, Debug)]
pub struct JointHardening;

impl Effect for JointHardening {
    fn identifier(&self) -> &'static str {
        "joint_hardening"
    }

    fn about(&self) -> About {
        About {
            reality: "The joint's twist is nonlinear (cubic) in its torque: strain-wave gears \
                      stiffen with load.",
            signature: "The twist per torque changes with the torque.",
            confused_with: "`joint_compliance` unless the torque takes several sizes.",
            separated_by: "At least three levels of load at one pose, both signs if it can be.",
        }
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        joints(arm)
    }

    fn parameters(&self, arm: &Arm, spot: Spot) -> Vec<Parameter> {
        let quantity = Quantity::of(
            arm.joints[spot.row()].motion,
            [Quantity::AnglePerMomentCubed, Quantity::LengthPerForceCubed],
        );
        vec![Parameter::free("cubic", quantity).one_sided()]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        let axis = axis(actual.arm.joints[spot.row()].motion);
        let cubic = v[0];
        let law = move |load: &Vector6<f64>| Vector6::ith(axis, cubic * load[axis].powi(3));
        actual.laws.push((Site::Joint(spot.row()), Box::new(law)));
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(Carrier::Joint(spot.row()))
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        motions.push(scene.state.torque[spot.row()].powi(3));
    }

    fn idle(&self) -> &'static str {
        "no load of this data reaches the joint"
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Nonlinear)
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("{} does not give in proportion to its torque", told.place)
    }

    fn curve<'a>(&self, numbers: &'a [ParameterReport]) -> Option<Curve<'a>> {
        let cubic = numbers.first()?.value;
        let value = Box::new(move |torque: f64| cubic * torque.powi(3));
        Some(Curve { over: Over::Torque, proportional: false, value })
    }
}
