//! Another joint's motion turns this one: wrists whose gears run through one another.
//!
//! Each other joint is a form of its own.

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use crate::effects::{
    About, Carrier, Draw, Effect, Forms, Parameter, Place, Quantity, Scene, Spot, Told, joints,
};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment};

/// Motion of this joint per motion of another.
#[derive(Clone, Copy, Debug)]
pub struct JointCoupling;

impl Effect for JointCoupling {
    fn identifier(&self) -> &'static str {
        "joint_coupling"
    }

    fn about(&self) -> About {
        About {
            reality: "Another joint's motion turns this one: wrists whose gears run through one \
                      another.",
            signature: "A joint is off in proportion to the reading of another.",
            confused_with: "`joint_ratio` where two joints move together; `transmission_error` of \
                            the other joint where axes are parallel.",
            separated_by: "The two joints moved independently.",
        }
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        if arm.dof() < 2 { Vec::new() } else { joints(arm) }
    }

    fn forms_are(&self) -> Forms {
        Forms::Joints
    }

    fn named_forms(&self, arm: &Arm, place: Place) -> Vec<usize> {
        (0..arm.dof()).filter(|other| *other != place.row()).collect()
    }

    fn parameters(&self, arm: &Arm, spot: Spot) -> Vec<Parameter> {
        let (this, other) = (arm.joints[spot.row()].motion, arm.joints[spot.form].motion);
        let quantity = match (this, other) {
            (Motion::Revolute, Motion::Prismatic) => Quantity::AnglePerLength,
            (Motion::Prismatic, Motion::Revolute) => Quantity::LengthPerAngle,
            _ => Quantity::Ratio,
        };
        let name = format!("joint {}", spot.form + 1);
        vec![Parameter::free("ratio", quantity).usually(0.01).named(name)]
    }

    fn alter(&self, actual: &mut Actual<'_>, row: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        actual.turn(spot.row(), v[0] * row.q[spot.form]);
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(Carrier::Joint(spot.row()))
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        motions.push(scene.row.q[spot.form]);
    }

    fn idle(&self) -> &'static str {
        "the other joint stands at zero throughout"
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let other = told.numbers.first().map_or("another joint", |p| &p.name);
        format!("{} turns with {other}, by {}", told.place, told.sized(told.first()))
    }

    fn shown_in<'a>(&self, unit: &'a str) -> &'a str {
        if unit == "1" { "rad/rad" } else { unit }
    }

    /// A tenth of what other ratios are.
    fn draw(&self, from: &mut Draw<'_>) -> Vec<(String, f64)> {
        let all = <dyn Effect>::numbers(self, from.arm, from.place);
        let one = from.below(all.len());
        let Some(parameter) = all.get(one) else { return Vec::new() };
        vec![(parameter.name.to_string(), 1e-3 * from.sign())]
    }
}
