//! Inverse kinematics by search: Newton's method from many postures, which knows nothing of branches.

use core::f64::consts::{PI, TAU};
use std::vec::Vec;

use nalgebra::{DMatrix, DVector, Isometry3, Vector3, Vector6};

use super::arm::Arm;
use super::base::drawn;
use super::spatial::stack;
use crate::Motion;

/// Most steps from one start; nearly all starts that lead to a solution take fewer than twenty.
const STEPS: usize = 60;

/// What a solution misses its pose by at most, m and rad: some thousand roundings of an arm of a metre.
const REACHED: f64 = 1e-12;

/// Of a square root's singularity so much is left of two solutions that are one.
const APART: f64 = 1e-5;

impl Arm {
    /// The joint values at which the tool stands at a pose, as far as so many starts find them, each once and its turning
    /// joints from −π to π. The starts are drawn at random, prismatic joints' within their limits or a metre.
    ///
    /// Of six joints these are all branches if there are starts enough: 400 miss one in some hundred. Of more joints each
    /// start finds another posture of the many there are; of fewer there are none but at poses that the arm can have.
    pub fn inverse_kinematics(&self, pose: &Isometry3<f64>, starts: usize) -> Vec<Vec<f64>> {
        let mut found: Vec<Vec<f64>> = Vec::new();
        let mut seed = 1;
        for _ in 0..starts {
            let start = self.joints.iter().map(|joint| match (joint.motion, joint.limits) {
                (Motion::Revolute, _) => PI * drawn(&mut seed),
                (_, Some([low, high])) => {
                    (low + high) / 2.0 + (high - low) / 2.0 * drawn(&mut seed)
                }
                (_, None) => drawn(&mut seed),
            });
            let start = start.collect();
            let Some(q) = self.newton(pose, start) else { continue };
            if found.iter().all(|known| self.apart(known, &q) > APART) {
                found.push(q);
            }
        }
        found
    }

    /// From one posture, by Levenberg's damping that falls with the error's square (Levenberg 1944).
    fn newton(&self, pose: &Isometry3<f64>, start: Vec<f64>) -> Option<Vec<f64>> {
        let mut q = start;
        for _ in 0..STEPS {
            let error = difference(&self.pose(&q), pose);
            if error.norm() < REACHED {
                q.iter_mut().zip(&self.joints).for_each(|(q, joint)| {
                    if joint.motion == Motion::Revolute {
                        *q -= whole(*q);
                    }
                });
                return Some(q);
            }
            let jacobian = self.jacobian(&q);
            let n = self.dof();
            let damping = DMatrix::identity(n, n) * (1e-3 * error.norm_squared());
            let normal = jacobian.tr_mul(&jacobian) + damping;
            let step: DVector<f64> = normal.lu().solve(&jacobian.tr_mul(&error))?;
            // Of more than a radian the slope says nothing.
            let scale = (1.0 / step.amax()).min(1.0);
            q.iter_mut().zip(step.iter()).for_each(|(q, step)| *q += scale * step);
        }
        None
    }

    /// The largest difference of two postures' joints, whole turns left out.
    fn apart(&self, a: &[f64], b: &[f64]) -> f64 {
        let each = a.iter().zip(b).zip(&self.joints).map(|((a, b), joint)| match joint.motion {
            Motion::Revolute => (a - b - whole(a - b)).abs(),
            Motion::Prismatic => (a - b).abs(),
        });
        each.fold(0.0, f64::max)
    }
}

/// The whole turns of an angle, rad.
fn whole(angle: f64) -> f64 {
    (angle / TAU).round() * TAU
}

/// From a pose to another: translation and rotation vector, base axes.
fn difference(from: &Isometry3<f64>, to: &Isometry3<f64>) -> Vector6<f64> {
    let turn: Vector3<f64> = (to.rotation * from.rotation.inverse()).scaled_axis();
    stack(to.translation.vector - from.translation.vector, turn)
}
