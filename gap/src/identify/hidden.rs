//! Which joints the tests do not show, and which pull would show them.
//!
//! Joint j shows in a test by the torque that the load puts on it, `J_jᵀ w`, and by the motion that
//! its yielding gives to what is measured, `J_j`. A vertical force has no moment about a vertical
//! first axis, so it leaves k₁ without a trace; a point on axis 6 does not move as joint 6 yields.

use core::fmt;

use nalgebra::{Vector3, Vector6};
use stiffarm_kernels::generic::Arm;

use super::solve::{Solved, UNDETERMINED};
use super::{System, Test, Weighting};

/// A lever shorter than this, m, is no way to load a joint by a force.
const SHORT: f64 = 0.02;

/// A motion below this part of the largest is rounding.
const ROUNDING: f64 = 1e-9;

/// A component of a null direction below this does not belong to it.
const BELONGS: f64 = 1e-4;

/// A joint that the tests do not show, or hardly.
#[derive(Clone, Debug, PartialEq)]
pub struct Hidden {
    /// From 1.
    pub joint: usize,
    /// Why.
    pub reason: Reason,
    /// The pull that would show it; none if no load shows it in what is measured.
    pub pull: Option<Pull>,
}

/// Why a joint does not show.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// No test loads it, or its yielding moves nothing that is measured.
    Untouched,
    /// Only together with others: from 1.
    Mixed(Vec<usize>),
    /// It shows less than the noise lets through.
    Weak {
        /// Standard deviation of its compliance.
        deviation: f64,
        /// Its compliance.
        compliance: f64,
    },
}

/// A load that shows a joint better than any other of its kind in the postures of the tests.
#[derive(Clone, Debug, PartialEq)]
pub struct Pull {
    /// The posture of this test, from 1.
    pub test: usize,
    /// Its joint values.
    pub q: Vec<f64>,
    /// Unit vector in base axes: of a force on the tool origin, or of a moment.
    pub direction: Vector3<f64>,
    /// Distance of the force's line from the joint's axis, m (1 for a sliding joint); none for a
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

impl fmt::Display for Hidden {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "joint {} ", self.joint)?;
        match &self.reason {
            Reason::Untouched => f.write_str("leaves no trace")?,
            Reason::Mixed(with) => {
                let others: Vec<String> = with.iter().map(usize::to_string).collect();
                write!(f, "shows only together with joint {}", others.join(", "))?;
            }
            Reason::Weak { deviation, compliance } => {
                write!(f, "is uncertain ({compliance:.3e} ± {deviation:.1e})")?;
            }
        }
        match &self.pull {
            Some(pull) => write!(f, "; to show it, {pull}"),
            None => f.write_str(
                "; no load shows it in what is measured: \
                 measure rotations, or a point off its axis",
            ),
        }
    }
}

pub(super) fn listing(hidden: &[Hidden]) -> String {
    let each: Vec<String> = hidden.iter().map(Hidden::to_string).collect();
    each.join("; ")
}

/// The joints (from 0) that the system leaves open, and why.
pub(super) fn open(solved: &Solved, system: &System) -> Vec<(usize, Reason)> {
    let most = solved.values.max();
    let n = system.b.ncols();
    let null: Vec<usize> = (0..solved.values.len())
        .filter(|&k| most <= 0.0 || solved.values[k] <= UNDETERMINED * most)
        .collect();
    let moves = |j: usize| null.iter().any(|&k| solved.directions[(k, j)].abs() > BELONGS);
    let mixed: Vec<usize> = (0..n).filter(|&j| !system.empty[j] && moves(j)).collect();
    let reason = |j: usize| {
        if system.empty[j] {
            return Some(Reason::Untouched);
        }
        let others = mixed.iter().filter(|&&other| other != j).map(|other| other + 1).collect();
        mixed.contains(&j).then_some(Reason::Mixed(others))
    };
    (0..n).filter_map(|j| reason(j).map(|why| (j, why))).collect()
}

/// The pull that shows joint `joint` (from 0) most, over the postures of the tests.
pub(super) fn pull(arm: &Arm, tests: &[Test], by: &Weighting, joint: usize) -> Option<Pull> {
    let mut best: Option<(f64, Pull)> = None;
    for (k, test) in tests.iter().enumerate() {
        let jacobian = arm.jacobian(&test.q);
        let column = jacobian.column(joint);
        let weights = by.matrix(arm, &test.q).ok()?;
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
            best = Some((score, Pull { test: k + 1, q: test.q.clone(), direction, lever }));
        }
    }
    best.map(|(_, pull)| pull)
}
