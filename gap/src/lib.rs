//! The sim-to-real gap of a robot arm: what was measured against what the model says, where the
//! difference comes from, and how far it shrinks when that is put into the model.
//!
//! [`robot::arm`] makes a robot file's model into an arm that is simulated ([`simulate`]);
//! [`measurement`] reads what was measured ([`readings`] makes it of what other programs write); [`gap`] is the difference; [`effects`] are what may
//! explain it; [`mod@diagnose`] finds out which does, on poses that no fit has seen.
//!
//! [`log`] does the same for an arm in motion: of a log of joint values with torques, currents or commands.
//!
//! This crate returns data and structured errors; it prints nothing.

mod constants;
pub mod corrected;
pub mod diagnose;
pub mod displacement;
pub mod doubts;
pub mod effects;
#[cfg(test)]
#[allow(dead_code, reason = "arms of other packages' tests")]
mod fixture;
pub mod gap;
pub mod identify;
pub mod log;
pub mod mistakes;
#[cfg(test)]
mod noisy;
pub mod performance;
pub mod pool;
pub mod predicted;
pub mod report;
pub mod robot;
pub mod shrink;
pub mod simulate;
pub mod spring;
pub mod whole;

pub use diagnose::{DiagnoseError, Diagnosis, Options, diagnose, diagnose_with};
pub use infer::rng;
pub use io::ReadError;
pub use measurement::Measurements;

use infer::parallel;
use stiffarm_infer as infer;
pub use stiffarm_io as io;
use stiffarm_observe::beyond;
pub use stiffarm_observe::{instrument, measurement, readings, signal};
