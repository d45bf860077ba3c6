//! The withheld check: what an experiment can find, before anyone runs it.
//!
//! Effects of chosen size are put into a [plant](crate::plant) one at a time, in pairs, not at all,
//! and with the effect taken out of the catalogue of the diagnosis. The diagnosis gets the
//! measurements and is not told; what it names is held against what was put in.

mod bench;
mod case;
mod draw;
mod exact;
pub mod logs;
mod predict;
mod report;
mod run;
mod summary;
mod verdict;

use stiffarm_kernels::generic::Arm;

pub use draw::resized;
pub use exact::exact;
pub use predict::{Predict, with_findings};
pub use report::{After, Case, Confusion, Named, Pairs, Rate, Removed, Report, Shrunk, Single};
pub use run::withhold;
pub use verdict::Verdict;

use crate::diagnose::{DiagnoseError, Options};
use crate::effects::Effect;
use crate::measurement::Measurements;
use crate::plant::{Frames, Noise, PlantError};
use crate::whole::Whole;

/// What kind of case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
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
    /// Number of cases.
    pub cases: usize,
    /// The size of an effect's gap in multiples of the noise: from, to.
    pub multiple: [f64; 2],
    /// Decides everything.
    pub seed: u64,
    /// Of the diagnosis; the arm has the effects that it knows already. Its noise is set to the
    /// instrument's, its seed and catalogue by the case.
    pub options: &'a Options,
    /// Cases that are worked on at once.
    pub threads: usize,
}

impl<'a> Plan<'a> {
    /// The robot, and what its file says beyond the table.
    fn whole(&self) -> Whole<'a> {
        Whole { arm: self.arm, known: &self.options.known }
    }
}

/// Why there is no result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WithholdError {
    /// The plant cannot be made or measured.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// No case could be diagnosed; the first one's reason.
    #[error(transparent)]
    Diagnose(#[from] DiagnoseError),
    /// Sizes are multiples of the noise.
    #[error("found no {what} noise, expected some: effects are sized in multiples of it")]
    NoNoise {
        /// `position` or `rotation`.
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
