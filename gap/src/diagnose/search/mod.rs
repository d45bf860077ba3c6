//! Which effects: the search.
//!
//! **In:** the [`Explained`] gap, which at first is the fit of the unknown frames alone; the
//! candidates.
//! **Out:** the same with the effects that the data ask for, fitted exactly.
//!
//! `forward` adds one effect after the other: the one with the most evidence (`infer`: what it
//! explains against what its parameters cost, and the chance that noise explains as much), if it
//! shrinks the held-out gap. `refined` places a jump in time, `load_frame` says in whose axes loads act, `exchange`
//! removes or replaces what was added too early, `tolerance` lets lengths and angles be off by as much as they are.
//! All ask the sums that were gathered [`beside`](Search::screen) the model, where what follows time is also compared with
//! autocorrelated errors. What is gathered [`First`], before anything is found, also says what the data could show.

mod beside;
mod exchange;
mod first;
mod forward;
mod load_frame;
mod pairs;
mod refined;
mod tolerance;

pub(crate) use first::First;
pub(crate) use forward::{Explained, Search};
