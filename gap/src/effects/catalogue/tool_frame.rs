//! The measured point is not where the tool frame says.

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

use crate::effects::{
    About, Carrier, Effect, Group, Parameter, Place, Quantity, Scene, Spot, Told, displacement,
    one_after_other,
};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment, Site};

/// Displacement of the tool frame, tool axes.
#[derive(Clone, Copy, Debug)]
pub struct ToolFrame;

impl Effect for ToolFrame {
    fn identifier(&self) -> &'static str {
        "tool_frame"
    }

    fn about(&self) -> About {
        About {
            reality: "The measured point is not where the tool frame says.",
            signature: "The same in the tool's own axes at every pose.",
            confused_with: "`joint_offset` at the last joint, which is its turn about that axis; \
                            the lengths of the last row, which are its shift across it.",
            separated_by: "None on the arm alone. Where the reflector's place is unknown from the \
                           start, name it a nuisance.",
        }
    }

    fn places(&self, _: &Arm) -> Vec<Place> {
        vec![Place::Tool]
    }

    fn parameters(&self, _: &Arm, _: Spot) -> Vec<Parameter> {
        displacement([Quantity::Length, Quantity::Angle])
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, _: Spot, v: &[f64]) {
        *actual.fixed_at(Site::Tool) += Vector6::from_column_slice(v);
    }

    fn carrier(&self, _: Spot) -> Option<Carrier> {
        Some(Carrier::Tool)
    }

    fn motions(&self, _: &Scene<'_>, _: Spot, motions: &mut Vec<f64>) {
        motions.push(1.0);
    }

    fn stepped(&self, _: Spot, values: &[f64], step: &[f64]) -> Vec<f64> {
        one_after_other(step, values)
    }

    fn idle(&self) -> &'static str {
        "displacements do not show where the tool is"
    }

    fn is_geometry(&self) -> bool {
        true
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Constant)
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("the tool is {} off", told.moved())
    }
}
