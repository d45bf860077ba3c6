//! The zero of the joint is off.

use stiffarm_kernels::generic::Arm;

use crate::effects::{
    About, Carrier, Effect, Group, Parameter, Place, Quantity, Scene, Spot, Told, joints,
};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment};

/// A constant error of a joint's reading: `q + offset` is true.
#[derive(Clone, Copy, Debug)]
pub struct JointOffset;

impl Effect for JointOffset {
    fn identifier(&self) -> &'static str {
        "joint_offset"
    }

    fn about(&self) -> About {
        About {
            reality: "The zero of the joint is off.",
            signature: "The same turn of the joint at every load, moment and direction.",
            confused_with: "`base_frame` (joint 1), `tool_frame` (the last joint), and neighbours \
                            whose axes are parallel as long as these move little.",
            separated_by: "Poses in which the joint itself and the next one cover their ranges.",
        }
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        joints(arm)
    }

    fn parameters(&self, arm: &Arm, spot: Spot) -> Vec<Parameter> {
        let quantity =
            Quantity::of(arm.joints[spot.row()].motion, [Quantity::Angle, Quantity::Length]);
        vec![Parameter::free("offset", quantity).usually(0.02)]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        actual.turn(spot.row(), v[0]);
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(Carrier::Joint(spot.row()))
    }

    fn motions(&self, _: &Scene<'_>, _: Spot, motions: &mut Vec<f64>) {
        motions.push(1.0);
    }

    fn idle(&self) -> &'static str {
        "the joint does not move what was measured"
    }

    fn is_geometry(&self) -> bool {
        true
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Constant)
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("the zero of {} is off by {}", told.place, told.sized(told.first()))
    }
}
