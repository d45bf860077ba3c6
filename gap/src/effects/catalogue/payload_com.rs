//! The load acts beside the tool origin.

use nalgebra::{Matrix6xX, Vector3};
use stiffarm_kernels::generic::Arm;

use crate::effects::{About, Effect, Parameter, Place, Quantity, Scene, Spot, Told};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment, Site};

/// The point of the tool frame at which the force acts, m.
#[derive(Clone, Copy, Debug)]
pub struct PayloadCom;

impl Effect for PayloadCom {
    fn identifier(&self) -> &'static str {
        "payload_com"
    }

    fn about(&self) -> About {
        About {
            reality: "The load acts beside the tool origin.",
            signature: "A moment that turns with the tool and grows with the load.",
            confused_with: "The moment columns themselves; where the tool keeps its attitude, \
                            zeros of the wrist.",
            separated_by: "One load in several attitudes of the tool.",
        }
    }

    fn places(&self, _: &Arm) -> Vec<Place> {
        vec![Place::Tool]
    }

    fn parameters(&self, _: &Arm, _: Spot) -> Vec<Parameter> {
        ["x", "y", "z"].map(|name| Parameter::free(name, Quantity::Length).usually(0.3)).to_vec()
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, _: Spot, v: &[f64]) {
        actual.load_point += Vector3::new(v[0], v[1], v[2]);
    }

    fn block(&self, scene: &Scene<'_>, _: Spot) -> Matrix6xX<f64> {
        let (force, tool) = (scene.force(), &scene.state.tool);
        let column = |k: usize| {
            let moment = (tool.rotation * Vector3::ith(k, 1.0)).cross(&force);
            let load = (&Vector3::zeros(), &moment, &tool.translation.vector);
            scene.state.yielding(scene.actual, load, Site::Tool)
        };
        Matrix6xX::from_columns(&[column(0), column(1), column(2)])
    }

    fn idle(&self) -> &'static str {
        "there is no force on the tool, or nothing that the model has gives under it"
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let beside = (told.write)("m", 1e-3, told.norm(&["x", "y", "z"]));
        format!("the load acts {beside} beside the tool origin")
    }
}
