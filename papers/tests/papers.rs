//! The five papers: their ledger, and what is reproduced of their methods.

mod bicchi;
mod dumas;
mod jweeg;
mod knapczyk;
mod ledger;
mod lin;
