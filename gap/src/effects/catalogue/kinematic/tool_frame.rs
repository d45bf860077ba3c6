use crate::effects::prelude::*;

/// Displacement of the tool frame, tool axes.
#[derive(Clone, Copy, Debug)]
pub struct ToolFrame;

const AT_REST: &Facts = &Facts {
    identifier: "tool_frame",
    reality: "The measured point is not where the tool frame says.",
    signature: "The same in the tool's own axes at every pose.",
    confused_with: "`joint_offset` at the last joint, which is its turn about that axis; the \
        lengths of the last row, which are its shift across it.",
    separated_by: "None on the arm alone. Where the reflector's place is unknown from the start, \
        name it a nuisance.",
    formula: "T → T E",
    parameters: &displacement(Quantity::Length, Quantity::Angle),
    at: At::Tool,
    moves: Moves::Tool,
    idle: "displacements do not show where the tool is",
    group: Some(Group::Constant),
    is_geometry: true,
    ..Facts::NONE
};

impl Law for ToolFrame {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for ToolFrame {
    fn moves_by(&self, _: &Row, _: &Moment, _: Spot, each: &mut dyn FnMut(f64)) {
        each(1.0);
    }

    fn stepped(&self, _: Spot, values: &[f64], step: &[f64]) -> Vec<f64> {
        one_after_other(step, values)
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("the tool is {} off", told.moved())
    }
}
