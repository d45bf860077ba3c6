//! From a Denavit-Hartenberg table to an expression graph to code.
//!
//! Data flows one way: [`robot`] (the table, read and validated) → [`derive`] (the kinematic
//! recursion, written into the graph of [`expr`]) → [`emit`] (one graph, many printers).

pub mod number;
pub mod robot;
