//! From a Denavit-Hartenberg table to an expression graph to code.
//!
//! Data flows one way: [`robot`] (the table, read and validated) → [`mod@derive`] (the kinematic
//! recursion, written into the graph of [`expr`]) → [`emit`] (one graph, many printers). The macro
//! (`expand`, feature `macro`), the command `stiffarm generate` and build scripts ([`generate_to_out_dir`]) all write
//! what [`emit::rust`] returns.
#![forbid(unsafe_code)]

pub mod derive;
pub mod emit;
#[cfg(feature = "macro")]
mod expand;
mod ir;
mod out_dir;
pub mod program;
mod term;

#[cfg(feature = "macro")]
pub use expand::expand;
pub use out_dir::{BuildError, generate_to_out_dir, read_robot};
pub use stiffarm_expr as expr;
pub use stiffarm_table::{number, robot};
