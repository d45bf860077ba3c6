//! The withheld check: what an experiment can find, before anyone runs it.
//!
//! Effects of chosen size are put into a [plant](crate::plant) one at a time, in pairs, not at all,
//! and with the effect taken out of the catalogue of the diagnosis. The diagnosis gets the
//! measurements, or the joint log as a file, and is not told the effects; what it names is compared
//! with what was put in. Campaigns and logs are two configurations of one bench.

mod campaign;
mod exact;
mod motion;
mod report;
mod rigid;
mod run;
mod summary;
mod unknowns;

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

pub use campaign::{resized, with_findings};
pub use exact::exact;
pub use report::{
    After, Case, Confusion, Facts, Named, Pairs, Rate, Removed, Report, Residual, Shrunk, Single,
    Verdict,
};
pub use run::withhold;

use crate::diagnose::{Diagnosis, Options};
use crate::effects::Effect;
use crate::log::LogOptions;
use crate::measurement::Measurements;
use crate::plant::motion::{Law, Logged, MotionError, Recording, Stage};
use crate::plant::{Frames, Noise, PlantError};
use crate::whole::Whole;

/// What kind of case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// No effect at all.
    None,
    /// One effect.
    Single,
    /// Two effects.
    Pair,
    /// One effect that the diagnosis does not know.
    Removed,
}

/// What is to be tried.
pub struct Plan<'a> {
    /// The robot.
    pub arm: &'a Arm,
    /// What is measured, and by which diagnosis it is judged.
    pub experiment: Experiment<'a>,
    /// Number of cases.
    pub cases: usize,
    /// The size of an effect's error in multiples of the noise: from, to.
    pub multiple: [f64; 2],
    /// Decides everything.
    pub seed: u64,
    /// Cases that are worked on at once.
    pub threads: usize,
}

/// What is measured.
pub enum Experiment<'a> {
    /// An arm at rest at poses under loads.
    Campaign(Campaign<'a>),
    /// An arm in motion.
    Log(Motion<'a>),
}

/// A campaign.
pub struct Campaign<'a> {
    /// Poses, loads and what is measured; what was measured there plays no part.
    pub design: &'a Measurements,
    /// Sessions of the same design at other poses, to see how far the gap really shrinks; several,
    /// lest their own chance count for the prediction's. Needs `predict`.
    pub fresh: &'a [Measurements],
    /// What the arm with a diagnosis' findings is predicted to read.
    pub predict: Option<&'a Predict<'a>>,
    /// Of the instrument.
    pub noise: Noise,
    /// Frames in which everything is measured and that the diagnosis fits; effects that only move
    /// them are then not put in.
    pub frames: Option<Frames>,
    /// The effects that are put in.
    pub effects: &'a [&'static dyn Effect],
    /// Of the diagnosis; the arm has the effects that it knows already. Its noise is set to the
    /// instrument's, its seed and catalogue by the case.
    pub options: &'a Options,
}

/// A motion, and how it is logged.
pub struct Motion<'a> {
    /// How the arm is moved, run by run.
    pub stages: &'a [Stage<'a>],
    /// What is logged.
    pub logged: Logged,
    /// How well.
    pub recording: Recording,
    /// The effects that are put in.
    pub effects: &'a [&'static Law],
    /// Of the diagnosis; seed and effects by the case.
    pub options: &'a LogOptions,
}

/// What the arm with a diagnosis' findings is predicted to read in each row of a design; `None`
/// where the findings do not say. Only position and orientation as a file has them.
pub type Predict<'a> = dyn Fn(&Diagnosis, &Measurements) -> Option<Vec<Vector6<f64>>> + Sync + 'a;

impl<'a> Campaign<'a> {
    /// The robot, and what its file says beyond the table.
    fn whole(&self, arm: &'a Arm) -> Whole<'a> {
        Whole { arm, known: &self.options.known }
    }
}

/// Why there is no result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WithholdError {
    /// The plant cannot be made or measured.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// The plant cannot be moved.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// No case could be diagnosed; the first one's reason.
    #[error("{0}")]
    Diagnose(String),
    /// Sizes are multiples of the noise.
    #[error("found no {what} noise, expected some: effects are sized in multiples of it")]
    NoNoise {
        /// `position`, `rotation`, `torque` or `reading`.
        what: &'static str,
    },
    /// Nothing was asked for.
    #[error("found 0 cases, expected at least 1")]
    NoCases,
    /// Multiples that are no range.
    #[error("found sizes from {from} to {to} times the noise, expected positive numbers in order")]
    Multiple {
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

#[cfg(test)]
mod tests;
