//! Printed equations against derived ones.
//!
//! A data file gives each equation of a paper as it is printed, in LaTeX, and what it is an
//! equation of. The formula is read ([`parser`]), what it should be is derived from the graph
//! ([`derived`]), both are brought to one exact form ([`rational`]) and compared; where they
//! differ, the smallest change of what is printed that mends it is looked for ([`mend`]). The
//! result of all papers is the ledger.

mod cells;
pub mod derived;
mod escape;
pub mod evaluate;
pub mod field;
pub mod file;
pub mod formula;
mod json;
mod judge;
mod labels;
mod ledger;
mod letters;
pub mod lexer;
mod mathml;
mod matrix;
pub mod mend;
pub mod mistake;
pub mod notation;
mod page;
pub mod parser;
pub mod polynomial;
mod print;
pub mod product;
pub mod rational;
mod reader;
mod render;
pub mod token;
pub mod tree;
mod verdict;
mod witness;

pub use cells::Methods;
pub use file::{Paper, read};
pub use ledger::{Ledger, judge};
pub use verdict::{Entry, Kind, Verdict, Witness};
