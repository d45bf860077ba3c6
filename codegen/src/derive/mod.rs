//! The derivation: the kinematic recursion of a table, unrolled into the graph. Nothing is expanded.
//!
//! Every quantity is worked out in one frame of the chain (the *working frame*, by default the one in
//! which the requested outputs take the fewest operations), into which the wrench is turned once and
//! out of which the results are turned at the end. One file per quantity.

mod chain;
mod displacements;
mod flexible;
mod inverse;
mod outputs;
mod own;
mod passes;
mod place;
mod program;
mod readings;
mod ways;

pub(crate) use chain::{Chain, Levers, Point, ROW, tool_offsets, twists};
pub use displacements::{COMPONENTS, Displacements};
pub use flexible::{Form, flexible};
pub use inverse::{AnyArm, AnyBranch, AsItIs, any_arm, elbow_angle, gives, inverse, steps};
pub(crate) use outputs::derived;
pub use own::{Held, Own, OwnInput, Quantity, Size};
pub use passes::Passes;
pub use place::{derive_at, ending_at};
pub use program::{Block, Program, Solve};
pub use readings::{Given, Readings};
pub use stiffarm_kernels::{Output, Unstable};
pub(crate) use ways::{Way, cheapest};
pub use ways::{derive, derive_each, derive_in, derive_with};
