//! Whatever the input, the readers answer: no panic, no number that is not finite, no mistake without a
//! place. The repository's own files are mutated; what was trouble once stands among them.
//!
//! A million inputs each, in minutes:
//! `cargo test --release -p stiffarm-tests --test gap -- --ignored a_million`

mod effects;
mod logs;
mod measurements;
