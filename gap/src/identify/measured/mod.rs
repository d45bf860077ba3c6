//! Stiffnesses from a measurement file: any subset of components, displacements or poses, points
//! off the tool origin, the links' weights and the loaded geometry taken into account.
//!
//! Each row is compared with the arm at static equilibrium ([`crate::simulate`]), and the compliances
//! are found by Gauss and Newton's steps.
//!
//! # Poses
//! Of a file of poses only the differences *within* one pose are used: each pose (and each marker
//! in it) has an unknown constant, so that an arm that stands elsewhere than its table says does no
//! harm. A pose that was measured under one load only says nothing.
//!
//! # What is held
//! A column that the rows leave without a trace, or that is a combination of others, is held at the
//! file's value and said so ([`Status::Held`]); joints come before links, links before the base.

mod choose;
mod fit;
mod hold_out;
mod regress;

pub use fit::Noise;
pub use hold_out::{Gap, Spread};

use core::fmt;

use stiffarm_kernels::generic::Arm;

use super::pull::Pull;
use crate::measurement::Measurements;

/// One number that is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unknown {
    /// The compliance of a joint (from 1), rad/(N·m), or m/N.
    Joint(usize),
    /// The flexibility of the beam of a row (from 1) as a multiple of the robot file's.
    Link(usize),
    /// A compliance of the foundation at the base origin: component 0 to 2 a translation along x,
    /// y, z, m/N; 3 to 5 a rotation about them, rad/(N·m). It answers the load, not the weights.
    Base(usize),
}

impl fmt::Display for Unknown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unknown::Joint(joint) => write!(f, "joint {joint}"),
            Unknown::Link(row) => write!(f, "link {row}"),
            Unknown::Base(k) => {
                let what = ["along x", "along y", "along z", "about x", "about y", "about z"];
                write!(f, "base {}", what.get(*k).copied().unwrap_or("?"))
            }
        }
    }
}

/// What to look for, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// The beams of the robot file too.
    pub links: bool,
    /// The foundation too.
    pub base: bool,
    /// Standard deviation of a measured coordinate, m; else from what is left.
    pub noise_position: Option<f64>,
    /// Standard deviation of a measured component of a rotation, rad; else from what is left.
    pub noise_rotation: Option<f64>,
    /// Number of folds of poses; by default one per pose up to 10.
    pub folds: Option<usize>,
    /// Of the folds.
    pub seed: u64,
    /// Of the intervals, between 0 and 1.
    pub confidence: f64,
}

impl Default for Question {
    /// Joints only, intervals of 95 %.
    fn default() -> Question {
        Question {
            links: false,
            base: false,
            noise_position: None,
            noise_rotation: None,
            folds: None,
            seed: 0,
            confidence: 0.95,
        }
    }
}

/// How well the rows determine a number.
#[derive(Clone, Debug, PartialEq)]
pub enum Status {
    /// Its standard deviation is less than half of it.
    Determined,
    /// Found, but with a standard deviation of more than half of it; the pull that would show it
    /// better, if it is a joint.
    Weak(Option<Pull>),
    /// Held at the file's value.
    Held {
        /// What it shows only together with; empty if it leaves no trace.
        with: Vec<Unknown>,
        /// The pull that would show it, if it is a joint.
        pull: Option<Pull>,
    },
}

/// One number, found or held.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Which.
    pub unknown: Unknown,
    /// How well it is determined.
    pub status: Status,
    /// As found; of one that is held the file's. Negative if the rows say so.
    pub value: f64,
    /// What the robot file has: 0 of a rigid joint and of the base, 1 of a link.
    pub file: f64,
    /// Standard deviation, and interval of the question's confidence; none of one that is held.
    pub spread: Option<Uncertainty>,
}

/// How sure a number is that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertainty {
    /// Standard deviation.
    pub deviation: f64,
    /// Interval of the question's confidence.
    pub interval: [f64; 2],
}

/// What the rows say.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// Joints, then links, then the base.
    pub parameters: Vec<Parameter>,
    /// Numbers measured less numbers fitted.
    pub freedom: usize,
    /// Of what was measured.
    pub noise: Noise,
    /// Squares left per degree of freedom, in units of the noise; none without freedom.
    pub reduced_chi2: Option<f64>,
    /// Condition number of the columns found, each brought to length 1.
    pub scaled_condition: f64,
    /// What is left: by the robot file, and on poses that the fit has not seen.
    pub gap: Gap,
}

impl Answer {
    /// One parameter's value.
    pub fn value(&self, unknown: Unknown) -> Option<f64> {
        self.parameters.iter().find(|p| p.unknown == unknown).map(|p| p.value)
    }

    /// The arm with what was found; a compliance or flexibility that is not positive stays the
    /// arm's own. The base is no part of an arm.
    pub fn applied_to(&self, arm: &Arm) -> Arm {
        let mut found = arm.clone();
        for parameter in self.parameters.iter().filter(|p| p.usable()) {
            match parameter.unknown {
                Unknown::Joint(j) => found.joints[j - 1].compliance = parameter.value,
                Unknown::Link(row) => {
                    if let Some(beam) = &mut found.joints[row - 1].beam {
                        beam.youngs_modulus /= parameter.value;
                        beam.shear_modulus /= parameter.value;
                    }
                }
                Unknown::Base(_) => {}
            }
        }
        found
    }
}

impl Parameter {
    /// The interval of one that was found.
    pub fn interval(&self) -> Option<[f64; 2]> {
        self.spread.map(|s| s.interval)
    }

    /// Whether it was found, and the file's value is outside its interval.
    pub fn differs(&self) -> bool {
        self.interval().is_some_and(|[low, high]| !(low..=high).contains(&self.file))
    }

    /// Whether it was found and is positive, as a spring's must be.
    pub fn usable(&self) -> bool {
        !matches!(self.status, Status::Held { .. }) && self.value > 0.0
    }
}

/// Why nothing could be identified.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the message beside each variant and field says what it is")]
pub enum MeasuredError {
    #[error("{file}: found readings of {found} joints, expected {expected} as the robot has")]
    Joints { file: String, found: usize, expected: usize },
    #[error("{file}: found no load in any row, expected fx … mz: springs show under a load only")]
    NoLoad { file: String },
    #[error(
        "{file}: found poses, each under one load only, expected poses that were measured under \
         two loads or more (one of them may be none), or displacements"
    )]
    OneLoadEach { file: String },
    #[error(
        "{file}: line {line}: marker `{marker}` has no translation in the robot file, expected one"
    )]
    UnknownOffset { file: String, line: u64, marker: String },
    #[error(
        "{file}: line {line}: the robot is not in stable equilibrium under this row's load and its \
         weight: check the load, its unit and the stiffness"
    )]
    Unstable { file: String, line: u64 },
    #[error("{file}: found {rows} numbers measured, expected more than {unknowns}: measure more")]
    TooFew { file: String, rows: usize, unknowns: usize },
    #[error("{file}: the rows determine nothing: {}", .held.join("; "))]
    Nothing { file: String, held: Vec<String> },
    #[error("found {found} folds, expected 2 to {poses}, the number of poses in {file}")]
    Folds { file: String, found: usize, poses: usize },
    #[error(
        "{file}: the steps do not settle: the springs that would explain the file let the arm \
         buckle; check the loads and their units"
    )]
    Unsettled { file: String },
}

/// Finds what the question asks for in a measurement file; `done` is told the part of the work that
/// is done, from 0 to 1. The user's own simulator, if the file has one, plays no part.
///
/// # Errors
/// [`MeasuredError`].
pub fn identify_measured(
    arm: &Arm,
    data: &Measurements,
    question: &Question,
    done: &dyn Fn(f64),
) -> Result<Answer, MeasuredError> {
    let sheet = regress::Sheet::new(arm, data, question)?;
    let fitted = fit::fit(&sheet, question, done)?;
    let gap = hold_out::gap(&sheet, &fitted, question, done)?;
    Ok(fitted.answer(&sheet, question, gap))
}

#[cfg(test)]
mod tests;
