use crate::effects::prelude::*;

/// A constant error of a joint's reading: `q + offset` is true.
#[derive(Clone, Copy, Debug)]
pub struct JointOffset;

const AT_REST: &Facts = &Facts {
    identifier: "joint_offset",
    reality: "The zero of the joint is off.",
    signature: "The same turn of the joint at every load, moment and direction.",
    confused_with: "`base_frame` (joint 1), `tool_frame` (the last joint), and neighbours whose \
        axes are parallel as long as these move little.",
    separated_by: "Poses in which the joint itself and the next one cover their ranges.",
    formula: "q → q + offset",
    parameters: &[Parameter::free("offset", Quantity::Angle).usually(0.02)],
    moves: Moves::Joint,
    idle: "the joint does not move what was measured",
    group: Some(Group::Constant),
    is_geometry: true,
    ..Facts::NONE
};

impl Law for JointOffset {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for JointOffset {
    fn moves_by(&self, _: &Row, _: &Moment, _: Spot, each: &mut dyn FnMut(f64)) {
        each(1.0);
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("the zero of {} is off by {}", told.place, told.sized(told.first()))
    }
}
