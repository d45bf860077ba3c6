#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code)]

pub use stiffarm_kernels as kernels;
pub use stiffarm_macros::robot;

#[cfg(doctest)]
#[doc = include_str!("../docs/program.md")]
mod program {}
