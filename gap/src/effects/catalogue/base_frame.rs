//! The robot stands elsewhere than the measuring frame believes.

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

use crate::displacement::Displacement;
use crate::effects::{
    About, Carrier, Effect, Group, Parameter, Place, Quantity, Scene, Spot, Told, displacement,
    one_after_other,
};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment};

/// Displacement of the base in the measuring frame, base axes.
#[derive(Clone, Copy, Debug)]
pub struct BaseFrame;

impl Effect for BaseFrame {
    fn identifier(&self) -> &'static str {
        "base_frame"
    }

    fn about(&self) -> About {
        About {
            reality: "The robot stands elsewhere than the measuring frame believes.",
            signature: "The same rigid motion at every pose.",
            confused_with: "`joint_offset` at joint 1, which is its turn about the first axis; the \
                            lengths and twist of row 1.",
            separated_by: "None on the arm alone: a frame measured at its foot. Where it is \
                           unknown from the start, name it a nuisance; it is then fitted and never \
                           a finding.",
        }
    }

    fn places(&self, _: &Arm) -> Vec<Place> {
        vec![Place::Base]
    }

    fn parameters(&self, _: &Arm, _: Spot) -> Vec<Parameter> {
        displacement([Quantity::Length, Quantity::Angle])
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, _: Spot, v: &[f64]) {
        actual.base *= Displacement::new(&Vector6::from_column_slice(v)).transform();
    }

    fn carrier(&self, _: Spot) -> Option<Carrier> {
        Some(Carrier::Base)
    }

    fn motions(&self, _: &Scene<'_>, _: Spot, motions: &mut Vec<f64>) {
        motions.push(1.0);
    }

    fn stepped(&self, _: Spot, values: &[f64], step: &[f64]) -> Vec<f64> {
        one_after_other(values, step)
    }

    fn idle(&self) -> &'static str {
        "displacements do not show where the base stands"
    }

    fn is_geometry(&self) -> bool {
        true
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Constant)
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("the base stands {} off", told.moved())
    }
}
