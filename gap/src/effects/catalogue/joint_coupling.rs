//! Another joint's motion turns this one: wrists whose gears run through one another.
//!
//! Each other joint is a form of its own. Confused with the joint's own ratio where two joints move
//! together, and with periodic errors of the other joint where axes are parallel: move the two
//! independently.

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use crate::effects::{Carrier, Effect, Parameter, Place, Scene, Spot, joints};
use crate::measurement::{Measurements, Row};
use crate::simulate::{Actual, Moment};

/// Motion of this joint per motion of another.
#[derive(Clone, Copy, Debug)]
pub struct JointCoupling;

impl Effect for JointCoupling {
    fn identifier(&self) -> &'static str {
        "joint_coupling"
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        joints(arm)
    }

    /// The other joints, from 0.
    fn forms(&self, arm: &Arm, place: Place, _: &Measurements) -> Vec<usize> {
        (0..arm.dof()).filter(|other| *other != place.row()).collect()
    }

    fn parameters(&self, arm: &Arm, spot: Spot, _: &Measurements) -> Vec<Parameter> {
        let (this, other) = (arm.joints[spot.row()].motion, arm.joints[spot.form].motion);
        let unit = match (this, other) {
            (Motion::Revolute, Motion::Prismatic) => "rad/m",
            (Motion::Prismatic, Motion::Revolute) => "m/rad",
            _ => "1",
        };
        vec![Parameter::free(format!("joint {}", spot.form + 1), unit).usually(0.01)]
    }

    fn alter(&self, actual: &mut Actual<'_>, row: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        actual.turn(spot.row(), v[0] * row.q[spot.form]);
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(Carrier::Joint(spot.row()))
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        motions.push(scene.row.q[spot.form]);
    }

    fn idle(&self) -> &'static str {
        "the other joint stands at zero throughout"
    }
}
