//! The gap in motion: from a joint log to where, which effect, how far it shrinks.
//!
//! 1. [`read`]: text into runs of samples, damaged rows left out and named.
//!    [`readings`]: what is wrong with them, taken out.
//! 2. [`signal`](crate::signal): even samples, one filter, rates.
//! 3. [`scene`]: rows, a joint at a time each; [`effects`]: what each effect does to them; what rigid links ask of
//!    the drives, by their [base parameters](stiffarm_kernels::generic::BaseParameter), is fitted along.
//! 4. `search`: which effects, by blocks of time that no fit has seen.
//! 5. [`report`]: what is said.
//!
//! Torque rows (`tau`, `i`) and position rows (`q_cmd`) go the same way; only the catalogue differs.

pub(crate) mod bodies;
pub mod corrected;
pub mod effects;
mod identifiability;
mod instrument;
pub mod known;
pub mod model;
pub mod options;
pub(crate) mod pace;
pub mod readings;
pub(crate) mod rigid;
pub mod scene;
pub(crate) mod search;
mod told;
mod verdict;

pub use model::Model;

pub use crate::report::LogDiagnosis;
pub use crate::report::log as report;
pub use options::{LogOptions, Refused};
pub use scene::Domain;
pub use stiffarm_observe::log::{
    self as read, Clock, Format, Hole, Log, Names, Opened, Run, Signal, TorqueSide,
};
pub use verdict::{diagnose, diagnosed, diagnosed_with};
