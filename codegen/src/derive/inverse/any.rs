//! The inverse of an arm whose number of joints is known when the program runs.

use stiffarm_kernels::{Pose, Steps};

use super::AsItIs;
use crate::derive::Given;
use crate::robot::{ClosedForm, Robot};

/// One branch at a pose.
#[derive(Clone, Debug)]
pub struct Branch {
    /// Its number, whose bits are [`ClosedForm::bits`].
    pub number: usize,
    /// Its readings, rad (prismatic joint: m): each joint by whole turns as near to those that were given as its limits
    /// allow.
    pub q: Vec<f64>,
    /// Whether the readings are within the limits.
    pub within: bool,
    /// How far the tool's origin is from the pose's, m; infinite where the arm does not bear its load.
    pub distance: f64,
    /// How far the axes are turned from the pose's, twice the sine of half the angle.
    pub tilt: f64,
}

/// An arm of any number of joints.
pub trait AnyArm: Send + Sync {
    /// Every branch near some readings, of the loaded arm where a wrench is given.
    fn branches(
        &self,
        given: &Given,
        pose: &Pose<f64>,
        near: &[f64],
        wrench: Option<&[f64; 6]>,
    ) -> Vec<Branch>;
}

struct Sized<const N: usize> {
    arm: AsItIs<N>,
    limits: [Option<[f64; 2]>; N],
}

impl<const N: usize> AnyArm for Sized<N> {
    fn branches(
        &self,
        given: &Given,
        pose: &Pose<f64>,
        near: &[f64],
        wrench: Option<&[f64; 6]>,
    ) -> Vec<Branch> {
        let near = core::array::from_fn(|joint| near.get(joint).copied().unwrap_or(0.0));
        let found = self.arm.with(given).solutions(pose, &near, (wrench, Steps::MOST));
        let branch = |found: stiffarm_kernels::Solution<f64, N>| {
            let turned = found.turned(&near, &self.limits);
            Branch {
                number: found.branch,
                q: turned.map_or(found.q, |turned| turned.q).map(|q| q + 0.0).to_vec(),
                within: turned.is_some(),
                distance: found.distance,
                tilt: found.tilt,
            }
        };
        found.into_iter().map(branch).collect()
    }
}

/// The arm whose closed form, or that of the nearest table, is `form`.
pub fn any_arm(robot: &Robot, form: ClosedForm) -> Box<dyn AnyArm> {
    fn of<const N: usize>(robot: &Robot, form: ClosedForm) -> Box<dyn AnyArm> {
        let limits = core::array::from_fn(|k| robot.joints.get(k).and_then(|joint| joint.limits));
        Box::new(Sized { arm: AsItIs::<N>::new(robot, form, Given::default()), limits })
    }
    by_joints!(robot.dof(), of(robot, form))
}
