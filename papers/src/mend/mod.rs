//! The smallest change of what is printed that makes it true.
//!
//! One slip is tried after the other; then pairs and triples. Slips in different terms add up: with
//! `d = true − printed` and `dᵢ` what slip i changes, a pair mends the formula if `dᵢ + dⱼ = d`,
//! which a table of the `dᵢ` finds without trying all pairs. What is found by evaluation is
//! confirmed by the caller exactly.

mod brackets;
mod core;
mod edit;
mod matrices;
mod search;
mod slips;

pub use brackets::{brackets, moved_brackets};
pub use edit::{Edit, Slip, apply, written};
pub use search::{Search, every_pair, mend};
pub use slips::{Inventory, slips};
