//! The joint twists in proportion to its torque (Dumas et al. 2011, eqs. 4 and 20-21).
//!
//! Confused with its link's bending, which moves the tool by almost the same twist when the load
//! comes from beyond the link's end, with the foundation (joint 1), and with a wrong weight: loads
//! in several directions at folded and at stretched poses tell them apart.

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use crate::effects::{Carrier, Effect, Parameter, Place, Scene, Spot, joints};
use crate::measurement::{Measurements, Row};
use crate::simulate::{Actual, Moment};

/// Compliance of a joint, added to what the arm's model has there.
#[derive(Clone, Copy, Debug)]
pub struct JointCompliance;

impl Effect for JointCompliance {
    fn identifier(&self) -> &'static str {
        "joint_compliance"
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        joints(arm)
    }

    /// One: the added compliance. The joint as a whole cannot be less than rigid, so the least is
    /// minus what the model has.
    fn parameters(&self, arm: &Arm, spot: Spot, _: &Measurements) -> Vec<Parameter> {
        let joint = &arm.joints[spot.row()];
        let unit = match joint.motion {
            Motion::Revolute => "rad/(N·m)",
            Motion::Prismatic => "m/N",
        };
        // 0.0 − c, and not −c, for a rigid joint's 0 to be positive.
        vec![Parameter::at_least("compliance", unit, 0.0 - joint.compliance)]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        let joint = &mut actual.arm.to_mut().joints[spot.row()];
        joint.compliance = (joint.compliance + v[0]).max(0.0);
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(Carrier::Joint(spot.row()))
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        motions.push(scene.state.torque[spot.row()]);
    }

    fn idle(&self) -> &'static str {
        "no load of this data reaches the joint"
    }
}
