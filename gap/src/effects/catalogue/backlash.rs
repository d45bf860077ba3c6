//! A dead band: the joint rests at one side or the other by the direction of approach.

use stiffarm_kernels::generic::Arm;

use crate::effects::scene::direction;
use crate::effects::{
    About, Carrier, Curve, Depends, Effect, Group, Over, Parameter, ParameterReport, Place,
    Quantity, Scene, Spot, Told, joints,
};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment};

/// The whole width of the dead band; the joint rests half of it behind the direction of approach.
#[derive(Clone, Copy, Debug)]
pub struct Backlash;

impl Effect for Backlash {
    fn identifier(&self) -> &'static str {
        "backlash"
    }

    fn about(&self) -> About {
        About {
            reality: "A dead band: the joint rests at one side or the other by the direction of \
                      approach.",
            signature: "The same size at every load, of the sign of the last move.",
            confused_with: "`joint_offset` if every pose is approached from one side; \
                            `friction_hysteresis` if the joint's torque hardly changes.",
            separated_by: "Each pose approached from both sides, under more than one load.",
        }
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        joints(arm)
    }

    fn parameters(&self, arm: &Arm, spot: Spot) -> Vec<Parameter> {
        let quantity =
            Quantity::of(arm.joints[spot.row()].motion, [Quantity::Angle, Quantity::Length]);
        vec![Parameter::at_least("width", quantity, 0.0).usually(5e-3)]
    }

    fn alter(&self, actual: &mut Actual<'_>, row: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        actual.turn(spot.row(), -0.5 * v[0] * direction(row, spot.row()));
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(Carrier::Joint(spot.row()))
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        motions.push(-0.5 * scene.direction(spot.row()));
    }

    fn idle(&self) -> &'static str {
        "no direction of approach is given for the joint"
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Direction)
    }

    fn depends(&self) -> Depends {
        Depends::Direction
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("{} has {} of backlash", told.place, told.size())
    }

    /// Half the dead band to either side, against the approach.
    fn curve<'a>(&self, numbers: &'a [ParameterReport]) -> Option<Curve<'a>> {
        let width = numbers.first()?.value;
        let value = Box::new(move |direction| -0.5 * width * direction);
        Some(Curve { over: Over::Direction, proportional: false, value })
    }
}
