use crate::effects::prelude::*;

/// Tilt about the housing's x and y per moment about them.
#[derive(Clone, Copy, Debug)]
pub struct BearingCompliance;

const AT_REST: &Facts = &Facts {
    identifier: "bearing_compliance",
    reality: "The joint tilts off its axis under moment.",
    signature: "A turn about the axes across the joint's, in proportion to the moment about these.",
    confused_with: "`link_compliance` of the links beside it; at joint 1 `base_compliance`.",
    separated_by: "Poses in which the joint turns while the load keeps its direction.",
    formula: "tilt = (tilt_x · mₓ, tilt_y · m_y)",
    parameters: &[
        Parameter::at_least("tilt_x", Quantity::AnglePerMoment, 0.0),
        Parameter::at_least("tilt_y", Quantity::AnglePerMoment, 0.0),
    ],
    idle: "no load of this data tilts the joint",
    group: Some(Group::Elastic),
    ..Facts::NONE
};

impl Law for BearingCompliance {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for BearingCompliance {
    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        let (x, y) = (v[0], v[1]);
        let law = move |w: &Vector6<f64>| Vector6::new(0.0, 0.0, 0.0, x * w[3], y * w[4], 0.0);
        actual.laws.push((Site::Joint(spot.row()), Box::new(law)));
    }

    fn block(&self, scene: &Scene<'_>, spot: Spot) -> Matrix6xX<f64> {
        let site = Site::Joint(spot.row());
        let load = scene.state.load(site);
        let tilts = [3, 4].map(|k| Vector6::ith(k, load[k]));
        scene.carried(site, &tilts)
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let most = told.numbers.iter().map(|p| p.value).fold(0.0, f64::max);
        format!("the bearing of {} tilts {}", told.place, told.sized(most))
    }
}
