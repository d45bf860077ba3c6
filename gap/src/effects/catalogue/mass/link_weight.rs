use crate::effects::prelude::*;

/// Mass added at the link's centre of mass.
#[derive(Clone, Copy, Debug)]
pub struct LinkWeight;

/// What may hang on any link without surprise, kg.
const LIGHT: f64 = 5.0;

/// The link's centre of mass in its frame, m; the middle of its chord where it has no mass.
fn centre(actual: &Actual<'_>, row: usize) -> Vector3<f64> {
    let joint = &actual.arm.joints[row];
    if joint.mass != 0.0 || joint.com != Vector3::zeros() {
        return joint.com;
    }
    let (before, behind) = actual.row(row);
    chord(&(before * behind)) * -0.5
}

const AT_REST: &Facts = &Facts {
    identifier: "link_weight",
    reality: "A link is heavier or lighter than modelled and the compliant structure sags.",
    signature: "The sag of the joints before the link, at every load. Seen only where the model, \
        or what has been found, gives under load.",
    confused_with: "The compliance of the joints before the link, whose sag it scales, and the \
        weights of its neighbours.",
    separated_by: "Loads of known size, which tell compliance from weight.",
    formula: "m → m + mass",
    at: At::Links,
    idle: "nothing in the model is compliant under the weight of the link",
    ..Facts::NONE
};

impl Law for LinkWeight {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for LinkWeight {
    fn parameters(&self, arm: &Arm, spot: Spot) -> Vec<Parameter> {
        let joint = &arm.joints[spot.row()];
        let whole: f64 = arm.joints.iter().map(|j| j.mass).sum();
        let usual = (joint.mass / 2.0).max(whole / 10.0).max(LIGHT);
        vec![Parameter::at_least("mass", Quantity::Mass, 0.0 - joint.mass).usually(usual)]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        let com = centre(actual, spot.row());
        let joint = &mut actual.arm.to_mut().joints[spot.row()];
        (joint.mass, joint.com) = (joint.mass + v[0], com);
    }

    fn block(&self, scene: &Scene<'_>, spot: Spot) -> Matrix6xX<f64> {
        let com = centre(scene.actual, spot.row());
        let site = Site::Link(spot.row());
        let point = scene.state.frame(site) * Point3::from(com);
        let weight = scene.actual.arm.gravity;
        let load = (&weight, &Vector3::zeros(), &point.coords);
        let twist = scene.state.yielding(scene.actual, load, site);
        Matrix6xX::from_columns(&[twist])
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!(
            "{} is {} {} than modelled",
            told.place,
            told.size(),
            told.by_sign("lighter", "heavier")
        )
    }
}
