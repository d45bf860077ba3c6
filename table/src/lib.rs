//! A robot's table, read and checked.
//!
//! [`robot`] is the model and the grammar of its cells; `schema` tells what fields there are; `frontends` are what it is
//! read from.
#![forbid(unsafe_code)]

mod frontends;
pub mod number;
pub mod robot;
mod schema;
