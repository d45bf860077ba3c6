//! The joint turns more or less than its reading, in proportion: a wrong gear ratio or encoder count.

use stiffarm_kernels::generic::Arm;

use crate::effects::{
    About, Carrier, Curve, Effect, Group, Over, Parameter, ParameterReport, Place, Quantity, Scene,
    Spot, Told, joints,
};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment};

/// `(1 + ratio) · q` is true.
#[derive(Clone, Copy, Debug)]
pub struct JointRatio;

impl Effect for JointRatio {
    fn identifier(&self) -> &'static str {
        "joint_ratio"
    }

    fn about(&self) -> About {
        About {
            reality: "The joint turns more or less than its reading, in proportion: a wrong gear \
                      ratio or encoder count.",
            signature: "A joint is off in proportion to its own reading.",
            confused_with: "`joint_offset` where the joint moves little; `transmission_error` of \
                            low order over less than a turn.",
            separated_by: "The whole range of the joint.",
        }
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        joints(arm)
    }

    fn parameters(&self, _: &Arm, _: Spot) -> Vec<Parameter> {
        vec![Parameter::free("ratio", Quantity::Ratio).usually(0.01)]
    }

    fn alter(&self, actual: &mut Actual<'_>, row: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        actual.turn(spot.row(), v[0] * row.q[spot.row()]);
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(Carrier::Joint(spot.row()))
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        motions.push(scene.row.q[spot.row()]);
    }

    fn idle(&self) -> &'static str {
        "the joint stands at zero throughout"
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Constant)
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let compared = told.by_sign("less", "more");
        format!("{} turns {} {compared} than its reading", told.place, told.size())
    }

    fn curve<'a>(&self, numbers: &'a [ParameterReport]) -> Option<Curve<'a>> {
        let ratio = numbers.first()?.value;
        Some(Curve {
            over: Over::Reading,
            proportional: false,
            value: Box::new(move |q| ratio * q),
        })
    }
}
