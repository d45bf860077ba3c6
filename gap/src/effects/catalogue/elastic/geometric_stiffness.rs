//! What those predictions lack, if they are of first order, is the exact deflection minus the one on the
//! undeformed arm.

use crate::effects::prelude::*;

/// The part of the loaded geometry that reality has: 1 is all.
#[derive(Clone, Copy, Debug)]
pub struct GeometricStiffness;

const AT_REST: &Facts = &Facts {
    identifier: "geometric_stiffness",
    reality: "The loaded geometry (K_C, large deflection) that a first-order sim leaves out.",
    signature: "Grows with the square of the load. Only where the file has another simulator's \
        predictions: stiffarm's own model is at rest on the deformed geometry.",
    confused_with: "`joint_compliance` and `joint_hardening` at a single level of load.",
    separated_by: "More than one level of load.",
    formula: "Δx = J (Kθ − K_C)⁻¹ Jᵀ w, not J Kθ⁻¹ Jᵀ w",
    parameters: &[Parameter::free("fraction", Quantity::Ratio)],
    at: At::Arm,
    idle: "nothing in the model is compliant under load",
    ..Facts::NONE
};

impl Law for GeometricStiffness {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for GeometricStiffness {
    fn excluded(&self, data: &Measurements) -> Option<&'static str> {
        let own = data.sim_given.contains(&true);
        (!own).then_some(
            "the model uses the loaded geometry already; only another simulator can lack it",
        )
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, _: Spot, v: &[f64]) {
        actual.loaded_geometry += v[0];
    }

    fn block(&self, scene: &Scene<'_>, _: Spot) -> Matrix6xX<f64> {
        let beyond = beyond_first_order(scene.actual, scene.state);
        Matrix6xX::from_columns(&[beyond])
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("the simulator neglects {} of the effect of the loaded geometry", told.size())
    }

    fn draw(&self, from: &mut Draw<'_>) -> Vec<(String, f64)> {
        let all = self.parameters(from.arm, Spot::at(from.place));
        all.into_iter().map(|p| (p.name.into_owned(), 1.0)).collect()
    }

    fn has_one_size(&self) -> bool {
        true
    }
}
