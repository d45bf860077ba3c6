//! An arm laid out in one working frame: orientations, levers, twists, masses. Everything that more
//! than one output is made of.

mod chord;
mod layout;
mod lever;
mod mass;
mod place;
mod runs;
mod tool;
mod twist;

pub use chord::{Chord, beam_mass, chord};
pub use layout::Chain;
pub use lever::{Levers, Point, tool_offsets};
pub use mass::{gravity, mass_beyond};
pub use place::{Place, ROW, Step, entries, expression, length, row_steps};
pub use tool::{frame_rotation, left_jacobian};
pub use twist::{base_twists, flatten, load, power, seen_from, twists, wrench};

use super::passes::Passes;
use crate::robot::Robot;

/// Lays out the arm with the working frame at boundary `cut` (before step `cut`).
pub fn lay_out(robot: &Robot, cut: usize, passes: Passes) -> Chain<'_> {
    let mut chain = Chain::new(robot, cut, passes);
    let by_run = passes.runs.then(|| runs::by_run(&mut chain));
    chain.with_tool(by_run)
}
