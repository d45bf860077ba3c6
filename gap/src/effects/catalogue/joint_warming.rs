//! A joint turns as it warms up.

use stiffarm_kernels::generic::Arm;

use crate::effects::{
    About, Carrier, Depends, Effect, Group, Parameter, Place, Quantity, Scene, Spot, Told, joints,
};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment};

/// Motion of the joint per kelvin above the first row.
#[derive(Clone, Copy, Debug)]
pub struct JointWarming;

impl Effect for JointWarming {
    fn identifier(&self) -> &'static str {
        "joint_warming"
    }

    fn about(&self) -> About {
        About {
            reality: "A joint turns as it warms up: its gear, its encoder or its housing grows \
                      unevenly.",
            signature: "A joint's zero that moves with the temperature, at every pose and load.",
            confused_with: "`thermal_growth` and `drift` over poses that are alike; neighbours whose \
                            axes are parallel.",
            separated_by: "The first poses once more when the arm is warm, and when it has cooled \
                           down; poses in which the joint's axis points elsewhere.",
        }
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        joints(arm)
    }

    fn parameters(&self, arm: &Arm, spot: Spot) -> Vec<Parameter> {
        let quantity = Quantity::of(
            arm.joints[spot.row()].motion,
            [Quantity::AnglePerKelvin, Quantity::LengthPerKelvin],
        );
        vec![Parameter::free("rate", quantity).usually(1e-4)]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, when: &Moment, spot: Spot, v: &[f64]) {
        actual.turn(spot.row(), v[0] * when.warming);
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(Carrier::Joint(spot.row()))
    }

    fn motions(&self, scene: &Scene<'_>, _: Spot, motions: &mut Vec<f64>) {
        motions.push(scene.when.warming);
    }

    fn idle(&self) -> &'static str {
        "the temperature does not change, or is not given"
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Time)
    }

    fn depends(&self) -> Depends {
        Depends::Temperature
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("{} moves by {} as it warms up", told.place, told.sized(told.first()))
    }
}
