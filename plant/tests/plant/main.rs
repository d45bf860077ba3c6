//! The plant against means that it does not use: the textbook, closed forms, arms whose file has
//! what a truth would add.

mod agreement;
mod arms;
mod bench;
mod camera;
mod closed_forms;
mod distances;
#[allow(dead_code)]
#[path = "../../../gap/src/fixture.rs"]
mod fixture;
mod kinematic;
mod motion;
mod nominal;
mod same_as_file;
mod session;
mod sessions;

// What the arms and rows of the fixture are made of.
use stiffarm_gap::{effects, measurement, robot};
