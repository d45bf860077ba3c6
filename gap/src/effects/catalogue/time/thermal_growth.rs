use crate::effects::prelude::*;

/// Growth of every length per kelvin.
#[derive(Clone, Copy, Debug)]
pub struct ThermalGrowth;

const AT_REST: &Facts = &Facts {
    identifier: "thermal_growth",
    reality: "Lengths grow with temperature: every length of the table and the tool, in \
        proportion to the temperature's difference from the first row.",
    signature: "The tool moves away from the base as the arm warms up, the farther the more it is \
        stretched.",
    confused_with: "`instrument_scale` if the temperature hardly changes; `drift` if it rises \
        evenly.",
    separated_by: "The arm measured again when it has cooled down.",
    formula: "L → (1 + expansion · ΔT) L",
    parameters: &[Parameter::free("expansion", Quantity::PerKelvin).usually(5e-5).one_sided()],
    at: At::Arm,
    idle: "the temperature does not change, or is not given",
    group: Some(Group::Time),
    depends: Depends::Temperature,
    ..Facts::NONE
};

impl Law for ThermalGrowth {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for ThermalGrowth {
    fn alter(&self, actual: &mut Actual<'_>, _: &Row, when: &Moment, _: Spot, v: &[f64]) {
        let growth = v[0] * when.warming;
        let arm = actual.arm.to_mut();
        for (joint, value) in arm.joints.iter_mut().zip(&mut actual.joints) {
            joint.a *= 1.0 + growth;
            joint.d *= 1.0 + growth;
            if joint.motion == Motion::Prismatic {
                *value *= 1.0 + growth;
            }
        }
        arm.tool.translation.vector *= 1.0 + growth;
    }

    fn block(&self, scene: &Scene<'_>, _: Spot) -> Matrix6xX<f64> {
        let arm = &scene.actual.arm;
        let shift = |v: Vector3<f64>| Vector6::new(v.x, v.y, v.z, 0.0, 0.0, 0.0);
        let row = |row: usize| {
            let (before, behind) = scene.actual.row(row);
            // What grows before the joint does not move the load against its axis.
            scene.state.carry(Site::Joint(row), &shift(chord(&before)))
                + scene.state.carry(Site::Link(row), &shift(chord(&behind)))
        };
        let rows: Vector6<f64> = (0..arm.dof()).map(row).sum();
        let tool = scene.state.carry(Site::Tool, &shift(chord(&arm.tool)));
        Matrix6xX::from_columns(&[(rows + tool) * scene.when.warming])
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("the arm grows by {}", told.sized(told.first()))
    }
}
