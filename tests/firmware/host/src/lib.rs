//! The host's side of the proof: builds the images, runs them in an emulator, compares every bit
//! with what the host computes, and checks what the kernels cost against their budgets.
#![forbid(unsafe_code)]

pub mod bits;
pub mod board;
pub mod budget;
#[cfg(feature = "images")]
pub mod c;
pub mod code;
pub mod docs;
pub mod elf;
pub mod figures;
pub mod tools;

/// What went wrong, with how to mend it.
pub type Failure = String;
