#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code)]

/// The page of those who build on it, whose blocks are tests.
#[cfg(doctest)]
#[doc = include_str!("../docs/build_on_it.md")]
mod build_on_it {}

pub use stiffarm_kernels as kernels;
pub use stiffarm_macros::robot;
