//! Which joints the tests do not show, and which pull would show them.

use core::fmt;

use stiffarm_gap::identify::pull::Pull;
use stiffarm_kernels::generic::Arm;

use super::solve::{Solved, UNDETERMINED};
use super::{System, Test, Weighting};

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
    let postures = tests.iter().map(|test| test.q.as_slice());
    stiffarm_gap::identify::pull::pull(arm, postures, |q| by.matrix(arm, q).ok(), joint)
}
