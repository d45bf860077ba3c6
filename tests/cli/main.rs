//! The command line as its users meet it: what it prints, writes and returns.

mod check;
mod diagnose;
mod errors;
mod eval;
mod generate;
mod others;
mod papers;
mod support;
