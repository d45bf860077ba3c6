//! A dead band in which the load decides: the joint rests on the flank to which its torque pushes.

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

use crate::effects::{
    About, Carrier, Curve, Effect, Group, Over, Parameter, ParameterReport, Place, Quantity, Scene,
    Spot, Told, joints,
};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment, Site, axis};

/// The whole width of the dead band; the joint rests half of it to the side of its torque.
#[derive(Clone, Copy, Debug)]
pub struct LoadedBacklash;

/// From this torque on (N·m; a force, N) the joint lies on a flank; below, the oil and friction of its
/// gear hold it in between, in proportion.
const FLOATS: f64 = 1.0;

/// The flank on which a joint rests under a torque, −1 to 1.
fn flank(torque: f64) -> f64 {
    (torque / FLOATS).clamp(-1.0, 1.0)
}

impl Effect for LoadedBacklash {
    fn identifier(&self) -> &'static str {
        "loaded_backlash"
    }

    fn about(&self) -> About {
        About {
            reality: "A dead band in which the load decides: the joint rests on the flank to which \
                      its torque pushes.",
            signature: "The same size at every load beyond 1 N·m, of the sign of the joint's torque.",
            confused_with: "`joint_offset` if the torque never changes its sign; `soft_zone` and \
                            `joint_hardening` if it does but with one size; `transmission_error` of \
                            order 1 under gravity alone.",
            separated_by: "One pose with loads that turn the joint either way.",
        }
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        joints(arm)
    }

    fn parameters(&self, arm: &Arm, spot: Spot) -> Vec<Parameter> {
        let quantity =
            Quantity::of(arm.joints[spot.row()].motion, [Quantity::Angle, Quantity::Length]);
        vec![Parameter::at_least("width", quantity, 0.0).usually(5e-3)]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        let axis = axis(actual.arm.joints[spot.row()].motion);
        let half = 0.5 * v[0];
        let law = move |load: &Vector6<f64>| Vector6::ith(axis, half * flank(load[axis]));
        actual.laws.push((Site::Joint(spot.row()), Box::new(law)));
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(Carrier::Joint(spot.row()))
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        motions.push(0.5 * flank(scene.state.torque[spot.row()]));
    }

    fn idle(&self) -> &'static str {
        "no load of this data reaches the joint"
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Nonlinear)
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!(
            "{} has {} of backlash and rests where its torque pushes it",
            told.place,
            told.size()
        )
    }

    fn curve<'a>(&self, numbers: &'a [ParameterReport]) -> Option<Curve<'a>> {
        let width = numbers.first()?.value;
        let value = Box::new(move |torque| 0.5 * width * flank(torque));
        Some(Curve { over: Over::Torque, proportional: false, value })
    }
}
