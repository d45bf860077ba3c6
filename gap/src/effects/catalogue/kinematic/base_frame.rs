use crate::effects::prelude::*;

/// Displacement of the base in the measuring frame, base axes.
#[derive(Clone, Copy, Debug)]
pub struct BaseFrame;

const AT_REST: &Facts = &Facts {
    identifier: "base_frame",
    reality: "The robot stands elsewhere than the measuring frame believes.",
    signature: "The same rigid motion at every pose.",
    confused_with: "`joint_offset` at joint 1, which is its turn about the first axis; the \
        lengths and twist of row 1.",
    separated_by: "None on the arm alone: a frame measured at its foot. Where it is unknown from \
        the start, name it a nuisance; it is then fitted and never a finding.",
    formula: "T → E T",
    parameters: &displacement(Quantity::Length, Quantity::Angle),
    at: At::Base,
    moves: Moves::Base,
    idle: "displacements do not show where the base stands",
    group: Some(Group::Constant),
    is_geometry: true,
    ..Facts::NONE
};

impl Law for BaseFrame {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for BaseFrame {
    fn moves_by(&self, _: &Row, _: &Moment, _: Spot, each: &mut dyn FnMut(f64)) {
        each(1.0);
    }

    fn stepped(&self, _: Spot, values: &[f64], step: &[f64]) -> Vec<f64> {
        one_after_other(values, step)
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("the base stands {} off", told.moved())
    }
}
