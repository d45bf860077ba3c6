//! Studies before anything is measured: which poses and which motion to measure, and what an experiment can find.

pub mod dexterity;
pub mod excite;
#[cfg(test)]
#[path = "../../gap/src/fixture.rs"]
#[allow(dead_code, reason = "the arms of gap's tests, of which few are needed here")]
mod fixture;
pub mod withhold;

use stiffarm_gap::{
    diagnose, effects, instrument, log, measurement, report, rng, robot, simulate, whole,
};
use stiffarm_infer as infer;
use stiffarm_infer::parallel;
use stiffarm_plant as plant;
