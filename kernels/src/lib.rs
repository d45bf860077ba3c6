//! The runtime of generated kernels: the scalar trait, the traits that generated code implements,
//! and (feature `generic`) the textbook implementation everything is checked against.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "generic")]
extern crate std;

#[cfg(feature = "generic")]
pub mod generic;
mod kernel;
mod scalar;
mod solve;

pub use kernel::{DhRow, Error, Kernels, Motion, Ops, Output, Pose, fill};
pub use scalar::Scalar;
pub use solve::{Unstable, solve};
