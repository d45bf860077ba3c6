//! What experiments are planned, and what they find of an effect of one's own.

mod design;
mod excite;
#[allow(dead_code)]
#[path = "../../../gap/src/fixture.rs"]
mod fixture;
mod own_effect;
#[path = "../../src/dexterity/design/plans.rs"]
mod plans;

// What the arms, rows and plans are made of.
use stiffarm_gap::{effects, instrument, measurement, robot, whole};
use stiffarm_study::dexterity;
