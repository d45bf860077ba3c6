//! What the data show, whatever is found.
//!
//! **In:** the fit of the unknown frames alone, and what was gathered beside it.
//! **Out:** the effects that these data could not have shown (`visible`), the numbers of the table
//! of which they see only sums (`gauge`), and plain facts of the gap: which part of it goes with
//! what, and how large it is where (`parts`).

mod gauge;
mod parts;
mod visible;
