use crate::effects::prelude::*;

/// The load is `1 + scale` times its columns.
#[derive(Clone, Copy, Debug)]
pub struct WrenchScale;

const AT_REST: &Facts = &Facts {
    identifier: "wrench_scale",
    reality: "The load is not what the load column says: a load cell out of calibration, a mass \
        weighed wrong.",
    signature: "All that the load does is larger by one factor, and nothing that the weights do.",
    confused_with: "The compliances that the load works on, if they are unknown as well.",
    separated_by: "The arm's own weight, or a second load cell.",
    formula: "w → (1 + scale) w",
    parameters: &[Parameter::free("scale", Quantity::Ratio).usually(0.3)],
    at: At::Tool,
    idle: "there is no load, or nothing in the model is compliant under it",
    ..Facts::NONE
};

impl Law for WrenchScale {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for WrenchScale {
    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, _: Spot, v: &[f64]) {
        actual.wrench *= 1.0 + v[0];
    }

    fn block(&self, scene: &Scene<'_>, _: Spot) -> Matrix6xX<f64> {
        let point = scene.state.tool * Point3::from(scene.actual.load_point);
        let load = (&scene.force(), &scene.moment(), &point.coords);
        let twist = scene.state.yielding(scene.actual, load, Site::Tool);
        Matrix6xX::from_columns(&[twist])
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let compared = told.by_sign("smaller", "larger");
        format!("the load is {} {compared} than its columns say", told.size())
    }
}
