//! What is given on the command line: robots, data, numbers, loads.

mod beyond;
pub mod branches;
pub mod data;
pub mod model;
pub mod named;
pub mod quantity;
pub mod source;
pub mod wrench;
