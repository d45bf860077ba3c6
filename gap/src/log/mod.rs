//! The gap in motion: from a joint log to where, which effect, how far it shrinks.
//!
//! 1. [`read`]: text into runs of samples, damaged rows left out and named.
//! 2. [`signal`]: even samples, one filter, rates.
//! 3. [`scene`]: rows, a joint at a time each; [`effects`]: what each effect does to them; [`rigid`]: what
//!    rigid links ask of the drives, which is fitted along.
//! 4. [`search`]: which effects, by blocks of time that no fit has seen.
//! 5. [`report`]: what is said.
//!
//! Torque rows (`tau`, `i`) and position rows (`q_cmd`) go the same way; only the catalogue differs.

pub mod effects;
pub mod options;
pub mod read;
pub mod report;
pub mod rigid;
pub mod scene;
pub mod search;
pub mod signal;
mod verdict;

pub use options::{LogOptions, Refused};
pub use read::{Log, LogError, Names, Run, Signal, TorqueSide, is_log};
pub use report::LogDiagnosis;
pub use scene::Domain;
pub use verdict::diagnose;
