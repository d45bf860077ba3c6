//! The diagnosis on what others measured, on plants that are written down in closed form, and on any input.

mod agreement;
mod diagnose;
#[allow(dead_code)]
#[path = "../src/fixture.rs"]
mod fixture;
mod fuzz;
mod lin;
mod log;
#[path = "../src/noisy.rs"]
mod noisy;
mod one_file;
mod springs;
mod ur10;

// What the arms and rows of the unit tests are made of.
use stiffarm_gap::{effects, measurement, rng, robot, simulate};
