use crate::effects::prelude::*;

/// Motion of the joint per kelvin above the first row.
#[derive(Clone, Copy, Debug)]
pub struct JointWarming;

const AT_REST: &Facts = &Facts {
    identifier: "joint_warming",
    reality: "A joint turns as it warms up: its gear, its encoder or its housing grows unevenly.",
    signature: "A joint's zero that moves with the temperature, at every pose and load.",
    confused_with: "`thermal_growth` and `drift` over poses that are alike; neighbours whose axes \
        are parallel.",
    separated_by: "The first poses once more when the arm is warm, and when it has cooled down; \
        poses in which the joint's axis points elsewhere.",
    formula: "q → q + rate · ΔT",
    parameters: &[Parameter::free("rate", Quantity::AnglePerKelvin).usually(1e-4)],
    moves: Moves::Joint,
    idle: "the temperature does not change, or is not given",
    group: Some(Group::Time),
    depends: Depends::Temperature,
    ..Facts::NONE
};

impl Law for JointWarming {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for JointWarming {
    fn moves_by(&self, _: &Row, when: &Moment, _: Spot, each: &mut dyn FnMut(f64)) {
        each(when.warming);
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("{} moves by {} as it warms up", told.place, told.sized(told.first()))
    }
}
