//! The loaded geometry (K_C, large deflection) that a first-order sim leaves out.
//!
//! What those predictions lack, if they are of first order, is the exact deflection minus the one on the
//! undeformed arm.

use nalgebra::Matrix6xX;
use stiffarm_kernels::generic::Arm;

use crate::effects::{About, Draw, Effect, Parameter, Place, Quantity, Scene, Spot, Told};
use crate::measurement::{Measurements, Row};
use crate::simulate::{Actual, Moment, beyond_first_order};

/// The part of the loaded geometry that reality has: 1 is all.
#[derive(Clone, Copy, Debug)]
pub struct GeometricStiffness;

impl Effect for GeometricStiffness {
    fn identifier(&self) -> &'static str {
        "geometric_stiffness"
    }

    fn about(&self) -> About {
        About {
            reality: "The loaded geometry (K_C, large deflection) that a first-order sim leaves \
                      out.",
            signature: "Grows with the square of the load. Only where the file has another \
                        simulator's predictions: stiffarm's own model is at rest on the deformed \
                        geometry.",
            confused_with: "`joint_compliance` and `joint_hardening` at a single level of load.",
            separated_by: "More than one level of load.",
        }
    }

    fn places(&self, _: &Arm) -> Vec<Place> {
        vec![Place::Arm]
    }

    fn excluded(&self, data: &Measurements) -> Option<&'static str> {
        let own = data.sim_given.contains(&true);
        (!own).then_some(
            "the model is at rest on the loaded geometry; only another simulator can lack it",
        )
    }

    fn parameters(&self, _: &Arm, _: Spot) -> Vec<Parameter> {
        vec![Parameter::free("fraction", Quantity::Ratio)]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, _: Spot, v: &[f64]) {
        actual.loaded_geometry += v[0];
    }

    fn block(&self, scene: &Scene<'_>, _: Spot) -> Matrix6xX<f64> {
        let beyond = beyond_first_order(scene.actual, scene.state);
        Matrix6xX::from_columns(&[beyond])
    }

    fn idle(&self) -> &'static str {
        "nothing that the model has gives under load"
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("the simulator leaves out {} of what the loaded geometry does", told.size())
    }

    fn draw(&self, from: &mut Draw<'_>) -> Vec<(String, f64)> {
        let all = self.parameters(from.arm, Spot::at(from.place));
        all.into_iter().map(|p| (p.name.into_owned(), 1.0)).collect()
    }

    fn has_one_size(&self) -> bool {
        true
    }
}
