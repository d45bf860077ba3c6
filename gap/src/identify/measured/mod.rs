//! Stiffnesses from a measurement file: any subset of components, displacements or poses, points
//! off the tool origin, the links' weights and the loaded geometry taken into account.
//!
//! It is the [diagnosis](mod@crate::diagnose) with a fixed set of effects: its exact fit at static
//! equilibrium, its noise, its covariance, its division of the poses into folds.
//!
//! # Poses
//! Of a file of poses only the differences *within* one pose are used: each pose (and each marker
//! in it) has an unknown constant, so that an arm that stands elsewhere than its table says does no
//! harm, and what the weights do to the foundation is in all of them. So has each thing of a bench in each pose; its
//! unknown place is fitted first. A pose that was measured
//! under one load only says nothing.
//!
//! # What is held
//! A column that the rows leave without a trace, or that is a combination of others, is held at the
//! file's value and said so ([`Status::Held`]); joints come before links, links before the base.

mod choose;
mod fit;
mod springs;

pub use fit::identify_measured;
pub use springs::Unknown;

use nalgebra::Vector6;

use super::pull::Pull;
use crate::diagnose::{DiagnoseError, Options};
use crate::effects::Known;
use crate::gap::Statistics;
use crate::infer::constants::FOLDS;
use crate::measurement::Measurements;

/// What to look for, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// What the robot file says beyond its table: the springs are found on top of it.
    pub known: Vec<Known>,
    /// The beams of the robot file too.
    pub links: bool,
    /// The foundation too.
    pub base: bool,
    /// Standard deviation of a measured coordinate, m; else from repeats, or from what is left.
    pub noise_position: Option<f64>,
    /// Standard deviation of a measured component of a rotation, rad; else likewise.
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
            known: Vec::new(),
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

impl Question {
    fn options(&self, data: &Measurements) -> Options {
        Options {
            known: self.known.clone(),
            folds: Some(self.folds.unwrap_or(data.poses.min(FOLDS))),
            seed: self.seed,
            noise_position: self.noise_position,
            noise_rotation: self.noise_rotation,
            ..Options::default()
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
    /// Whether it was found and differs from the robot file's value, all that were found considered: of campaigns of
    /// an arm that is as its file says one in twenty has one that does (Holm 1979).
    pub differs: bool,
}

/// How sure a number is that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertainty {
    /// Standard deviation.
    pub deviation: f64,
    /// Interval of the question's confidence.
    pub interval: [f64; 2],
}

/// Standard deviations of what was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Of a coordinate, m; none if none was measured.
    pub position: Option<f64>,
    /// Of a component of a rotation, rad; none if none was measured.
    pub rotation: Option<f64>,
    /// `option`, `repeats` or `residual`.
    pub from: &'static str,
}

/// Before and after.
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// By the robot file as it is.
    pub before: Statistics,
    /// By what the other poses identify.
    pub held_out: Statistics,
    /// Measured minus simulated of each row, before and held out, m and rad; of poses less the mean
    /// over the loads of the pose. 0 where a component is not measured.
    pub rows: [Vec<Vector6<f64>>; 2],
    /// How many folds.
    pub folds: usize,
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
}

impl Parameter {
    /// The interval of one that was found.
    pub fn interval(&self) -> Option<[f64; 2]> {
        self.spread.map(|s| s.interval)
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
    #[error(transparent)]
    Diagnose(#[from] DiagnoseError),
    #[error(
        "{file}: found what a camera shows, expected poses or what is read on a bench: where the camera stands is unknown, \
         and `stiffarm diagnose` finds that and the springs"
    )]
    Camera { file: String },
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
    #[error("{file}: found {rows} numbers measured, expected more than {unknowns}: measure more")]
    TooFew { file: String, rows: usize, unknowns: usize },
    #[error("{file}: the rows determine nothing: {}", .held.join("; "))]
    Nothing { file: String, held: Vec<String> },
    #[error(
        "{file}: the steps do not settle: the springs that would explain the file let the arm \
         buckle; check the loads and their units"
    )]
    Unsettled { file: String },
}
