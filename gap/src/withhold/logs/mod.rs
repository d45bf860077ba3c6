//! The withheld check of joint logs: what a motion can find, before any arm is moved.
//!
//! One effect at a time is put into a [plant that moves](crate::plant::motion), or none, or one that the
//! diagnosis does not know. The diagnosis reads the log as a file and is not told.

mod bench;
mod report;
mod rigid;
mod run;

use stiffarm_kernels::generic::Arm;

pub use report::{Asked, LogCase, LogReport, LogVerdict};
pub use run::withhold;

use crate::log::LogOptions;
use crate::plant::motion::{Law, Logged, MotionError, Recording, Stage};

/// What is to be tried.
pub struct LogPlan<'a> {
    /// The robot.
    pub arm: &'a Arm,
    /// How it is moved, run by run.
    pub stages: &'a [Stage<'a>],
    /// What is logged.
    pub logged: Logged,
    /// How well.
    pub recording: Recording,
    /// The effects that are put in.
    pub effects: &'a [&'static Law],
    /// Number of cases.
    pub cases: usize,
    /// The size of an effect in multiples of the noise: from, to.
    pub multiple: [f64; 2],
    /// Decides everything.
    pub seed: u64,
    /// Of the diagnosis; seed and effects by the case.
    pub options: &'a LogOptions,
    /// Cases that are worked on at once.
    pub threads: usize,
}

/// Why there is no result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LogWithholdError {
    /// The plant cannot be moved.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// No case could be diagnosed; the first one's reason.
    #[error("{0}")]
    Diagnose(String),
    /// Sizes are multiples of the noise.
    #[error("found no noise of the {what}, expected some: effects are sized in multiples of it")]
    NoNoise {
        /// `torques` or `readings`.
        what: &'static str,
    },
    /// Nothing was asked for, or sizes that are none.
    #[error(
        "found {cases} cases of sizes from {from} to {to} times the noise, expected at least one, and positive sizes in order"
    )]
    Plan {
        /// As given.
        cases: usize,
        /// The lower end.
        from: f64,
        /// The upper end.
        to: f64,
    },
    /// The machine gives no threads.
    #[error("cannot start {threads} threads: {reason}")]
    Threads {
        /// So many were asked for.
        threads: usize,
        /// What the system says.
        reason: String,
    },
}
