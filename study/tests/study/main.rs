//! What experiments are planned, and what they find of an effect of one's own.

mod excite;
#[allow(dead_code)]
#[path = "../../../gap/src/fixture.rs"]
mod fixture;
mod own_effect;

// What the arms and rows of the fixture are made of.
use stiffarm_gap::{effects, measurement, robot};
