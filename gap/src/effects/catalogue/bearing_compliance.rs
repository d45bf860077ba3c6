//! The joint tilts off its axis under moment.

use nalgebra::{Matrix6xX, Vector6};
use stiffarm_kernels::generic::Arm;

use crate::effects::{About, Effect, Group, Parameter, Place, Quantity, Scene, Spot, Told, joints};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment, Site};

/// Tilt about the housing's x and y per moment about them.
#[derive(Clone, Copy, Debug)]
pub struct BearingCompliance;

impl Effect for BearingCompliance {
    fn identifier(&self) -> &'static str {
        "bearing_compliance"
    }

    fn about(&self) -> About {
        About {
            reality: "The joint tilts off its axis under moment.",
            signature: "A turn about the axes across the joint's, in proportion to the moment \
                        about these.",
            confused_with: "`link_compliance` of the links beside it; at joint 1 \
                            `base_compliance`.",
            separated_by: "Poses in which the joint turns while the load keeps its direction.",
        }
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        joints(arm)
    }

    fn parameters(&self, _: &Arm, _: Spot) -> Vec<Parameter> {
        ["tilt_x", "tilt_y"]
            .map(|name| Parameter::at_least(name, Quantity::AnglePerMoment, 0.0))
            .to_vec()
    }

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

    fn idle(&self) -> &'static str {
        "no load of this data tilts the joint"
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Elastic)
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let most = told.numbers.iter().map(|p| p.value).fold(0.0, f64::max);
        format!("the bearing of {} tilts {}", told.place, told.sized(most))
    }
}
