//! The derivation: the kinematic recursion of a table, unrolled into the graph. Nothing is expanded.
//!
//! Every quantity is worked out in one frame of the chain (the *working frame*, by default the one in
//! which the requested outputs take the fewest operations), into which the wrench is turned once and
//! out of which the results are turned at the end. One file per quantity.

mod beam;
mod chain;
mod compliance;
mod deflection;
mod displacements;
mod flexible;
mod frames;
mod gravity;
mod jacobian;
mod lever;
mod output;
mod parameters;
mod passes;
mod program;
mod runs;
mod stiffness;
mod torque;

pub use displacements::{COMPONENTS, Displacements};
pub use flexible::{Form, flexible};
pub use output::Output;
pub use passes::Passes;
pub use program::{Block, Program, Solve, Unstable, derive, derive_each, derive_in, derive_with};
