#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code)]

pub use stiffarm_kernels as kernels;
pub use stiffarm_macros::robot;
