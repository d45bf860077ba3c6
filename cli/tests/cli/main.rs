//! The command line as its users meet it: what it prints, writes and returns.

mod beyond;
mod check;
mod committed;
mod compensate;
mod diagnose;
mod effects;
mod errors;
mod eval;
mod every;
mod generate;
mod generate_c;
mod identify;
mod import;
mod map;
mod measurements;
mod others;
mod papers;
mod pinocchio;
mod poses;
mod readme;
mod report;
mod simulate;
mod support;
mod withhold;
mod workbench;
