//! The schema of a robot, said once ([`fields`]), and what follows from it: one reader for robot files and the macro's
//! tokens, the writer, the list of parameters, the tables of the documentation.

mod cells;
mod checks;
mod describe;
mod effect;
mod field;
mod fields;
mod node;
mod read;
mod section;
mod symbols;
mod write;

pub(crate) use cells::Language;
#[cfg(feature = "macro")]
pub(crate) use cells::Reader;
#[cfg(feature = "macro")]
pub(crate) use field::keys;
#[cfg(feature = "macro")]
pub(crate) use fields::{BEAM, JOINT, SECTION};
pub(crate) use node::{Content, Node, Pair, Table};
pub(crate) use read::read;
#[cfg(feature = "macro")]
pub(crate) use read::{carry, outputs};
#[cfg(feature = "macro")]
pub(crate) use section::{BOX, TUBE};
pub use symbols::Symbol;
