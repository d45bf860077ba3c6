//! The joint's twist is nonlinear (cubic) in its torque.
//!
//! Strain-wave gears stiffen with load. Confused with the joint's compliance unless the torque
//! takes several sizes: at least three levels of load at one pose, both signs if it can be.

use nalgebra::Vector6;
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use crate::effects::{Carrier, Effect, Parameter, Place, Scene, Spot, joints};
use crate::measurement::{Measurements, Row};
use crate::simulate::{Actual, Moment, Site, axis};

/// Twist per cube of the torque; negative if the joint hardens.
#[derive(Clone, Copy, Debug)]
pub struct JointHardening;

impl Effect for JointHardening {
    fn identifier(&self) -> &'static str {
        "joint_hardening"
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        joints(arm)
    }

    fn parameters(&self, arm: &Arm, spot: Spot, _: &Measurements) -> Vec<Parameter> {
        let unit = match arm.joints[spot.row()].motion {
            Motion::Revolute => "rad/(N·m)³",
            Motion::Prismatic => "m/N³",
        };
        vec![Parameter::free("cubic", unit)]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        let axis = axis(actual.arm.joints[spot.row()].motion);
        let cubic = v[0];
        let law = move |load: &Vector6<f64>| Vector6::ith(axis, cubic * load[axis].powi(3));
        actual.laws.push((Site::Joint(spot.row()), Box::new(law)));
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(Carrier::Joint(spot.row()))
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        motions.push(scene.state.torque[spot.row()].powi(3));
    }

    fn idle(&self) -> &'static str {
        "no load of this data reaches the joint"
    }
}
