use crate::effects::prelude::*;

/// The point of the tool frame at which the force acts, m.
#[derive(Clone, Copy, Debug)]
pub struct PayloadCom;

const AT_REST: &Facts = &Facts {
    identifier: "payload_com",
    reality: "The load acts beside the tool origin.",
    signature: "A moment that turns with the tool and grows with the load.",
    confused_with: "The moment columns themselves; where the tool keeps its attitude, zeros of \
        the wrist.",
    separated_by: "One load in several attitudes of the tool.",
    formula: "m → m + (x, y, z) × f",
    parameters: &[
        Parameter::free("x", Quantity::Length).usually(0.3),
        Parameter::free("y", Quantity::Length).usually(0.3),
        Parameter::free("z", Quantity::Length).usually(0.3),
    ],
    at: At::Tool,
    idle: "there is no force on the tool, or nothing in the model is compliant under it",
    ..Facts::NONE
};

impl Law for PayloadCom {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for PayloadCom {
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

    fn sentence(&self, told: &Told<'_>) -> String {
        let beside = (told.write)("m", 1e-3, told.norm(&["x", "y", "z"]));
        format!("the load acts {beside} from the tool origin")
    }
}
