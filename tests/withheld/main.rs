//! The withheld check on arms of two, six and seven joints: effects are put into a plant, the
//! diagnosis is not told, and what it finds is compared with what was put in.
//!
//! `cargo test -p stiffarm --release --test withheld -- --ignored --nocapture full` runs the full
//! form of campaigns and prints its table. `realistic` and `logs` have commands of their own. `needs_time…` are short forms:
//! some cases of each, in which a rate may miss its goal by chance alone.

mod arms;
mod bench;
mod campaigns;
mod goals;
mod links;
mod logs;
mod mistakes;
mod motion_mistakes;
mod pairs;
mod realistic;
mod repeats;
mod stream;
mod suite;
