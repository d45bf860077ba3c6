//! Which pull shows a joint.
//!
//! Joint j shows in a test by the torque that the load puts on it, `J_jᵀ w`, and by the motion that
//! its yielding gives to what is measured, `J_j`. A vertical force has no moment about a vertical
//! first axis, so it leaves k₁ without a trace; a point on axis 6 does not move as joint 6 yields.

use core::fmt;

use nalgebra::{Matrix6, Vector3, Vector6};
use stiffarm_kernels::generic::Arm;

use crate::infer::limits::ROUNDING;

/// A lever shorter than this, m, is no way to load a joint by a force.
const SHORT: f64 = 0.02;

/// A load that shows a joint better than any other of its kind in the postures of the tests.
#[derive(Clone, Debug, PartialEq)]
pub struct Pull {
    /// The posture of this test, from 1.
    pub test: usize,
    /// Its joint values.
    pub q: Vec<f64>,
    /// Unit vector in base axes: of a force on the tool origin, or of a moment.
    pub direction: Vector3<f64>,
    /// Distance of the force's line from the joint's axis, m (1 for a prismatic joint); none for a
    /// moment.
    pub lever: Option<f64>,
}

impl Pull {
    /// The wrench of a given size (N, or N·m of a moment) at the tool origin.
    pub fn wrench(&self, size: f64) -> Vector6<f64> {
        let (v, zero) = (self.direction * size, Vector3::zeros());
        let (force, moment) = if self.lever.is_some() { (v, zero) } else { (zero, v) };
        Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
    }
}

impl fmt::Display for Pull {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = self.direction;
        let along = format!("[{:.2}, {:.2}, {:.2}]", d.x, d.y, d.z);
        let at = format!("in base axes at the posture of test {}", self.test);
        match self.lever {
            Some(lever) => write!(f, "pull along {along} {at} (lever {lever:.3} m)"),
            None => write!(f, "apply a moment about {along} {at}"),
        }
    }
}

/// The pull that shows joint `joint` (from 0) most, over the postures of some tests; `weights`
/// (6×6) say how much each component of what moves there counts.
pub fn pull<'q>(
    arm: &Arm,
    postures: impl IntoIterator<Item = &'q [f64]>,
    weights: impl Fn(&[f64]) -> Option<Matrix6<f64>>,
    joint: usize,
) -> Option<Pull> {
    let mut best: Option<(f64, Pull)> = None;
    for (k, q) in postures.into_iter().enumerate() {
        let jacobian = arm.jacobian(q);
        let column = jacobian.column(joint);
        let weights = weights(q)?;
        let motion = (weights * column).norm();
        let largest = jacobian.column_iter().map(|c| (weights * c).norm()).fold(0.0, f64::max);
        if motion <= ROUNDING * largest {
            continue;
        }
        let velocity: Vector3<f64> = column.fixed_rows::<3>(0).into_owned();
        let axis: Vector3<f64> = column.fixed_rows::<3>(3).into_owned();
        let lever = velocity.norm();
        let by_force = lever > SHORT;
        // A lever of any length comes before a moment.
        let (score, direction) = if by_force {
            (1.0 + lever * motion / largest, velocity / lever)
        } else {
            (motion / largest / (1.0 + motion / largest), axis)
        };
        if best.as_ref().is_none_or(|(before, _)| score > *before) {
            let lever = by_force.then_some(lever);
            best = Some((score, Pull { test: k + 1, q: q.to_vec(), direction, lever }));
        }
    }
    best.map(|(_, pull)| pull)
}
