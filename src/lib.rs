//! stiffarm: closed-form elastostatic kernels from a Denavit-Hartenberg table.
#![no_std]
#![forbid(unsafe_code)]

pub use stiffarm_kernels as kernels;
pub use stiffarm_macros::robot;
