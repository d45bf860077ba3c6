//! A robot file from a URDF: the serial chain between two links as Denavit-Hartenberg rows.
//!
//! [`read`] reads the file and knows where its joints stand; [`Chain`] is what lies between base
//! and tip, fixed joints folded away; [`Table`] is the same in modified Denavit-Hartenberg rows and
//! a tool; [`robot_file`] writes it down.
//!
//! # What a table cannot hold
//! A row of the modified convention places its axis by two numbers (a and alpha), a line in space
//! has four. From the second joint on theta and d of the row before are the other two. Before the
//! first row nothing is: where axis 1 does not meet the URDF's x axis at a right angle (as it does along z
//! through the origin) [`Table::base`], the file's `[base]`, places it.

mod angle;
mod chain;
mod document;
mod from_robot;
#[cfg(test)]
mod fuzz;
mod masses;
mod read;
mod refusal;
mod robot_file;
mod table;
mod tree;

pub use crate::robot::space::Frame;
pub use chain::{Chain, Step};
pub use document::Elements;
pub use masses::Lump;
pub use read::{Urdf, bytes, read};
pub use refusal::{Place, Refusal};
pub use robot_file::robot_file;
pub use table::{Row, Table};
