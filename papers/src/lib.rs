//! Printed equations against derived ones, and the papers' methods.
//!
//! A data file ([`file`]) gives each equation of a paper as it is printed, in LaTeX, and what it is
//! an equation of. The formula is read ([`latex`]), what it should be is derived from the graph
//! ([`exact`]), both are brought to one exact form and compared; where they differ, the smallest
//! change of what is printed that mends it is looked for ([`mend`]). Relations between matrices are
//! compared at points ([`matrix`]). The result of all papers is the [`ledger`].
//!
//! What needs a paper's whole method is worked out by it: [`bicchi`], [`dumas`], [`jweeg`],
//! [`knapczyk`], [`lin`], on the [`chain`] with an error at every place.
#![forbid(unsafe_code)]

pub mod bicchi;
pub mod chain;
pub mod dumas;
pub mod exact;
pub mod file;
#[cfg(test)]
mod fixture;
pub mod jweeg;
pub mod knapczyk;
pub mod latex;
pub mod ledger;
pub mod lin;
mod matrix;
pub mod mend;
mod methods;

pub use file::{Paper, read};
pub use ledger::verdict::{Entry, Kind, Verdict, Witness};
pub use ledger::{Ledger, built_in};
pub use methods::column;
