//! What was observed of a robot arm, whatever with: files into rows of a campaign or runs of a log.
//!
//! 1. [`measurement`]: a campaign at rest, row by row, with its loads, visits, sessions and bench.
//! 2. [`instrument`]: what one reading says of the tool's pose, and of the bench's constants.
//! 3. [`readings`]: a campaign of what instruments and other programs write.
//! 4. [`log`]: a joint log; damaged rows left out and named.
//! 5. [`signal`]: its even samples, one filter, rates.
//!
//! This crate returns data and structured errors; it knows no effect and prints nothing.

pub mod instrument;
mod limits;
pub mod log;
pub mod measurement;
pub mod readings;
pub mod signal;

pub use limits::beyond;

use stiffarm_infer as infer;
use stiffarm_io as io;
