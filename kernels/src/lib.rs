//! The runtime of generated kernels: the scalar trait, the traits that generated code implements,
//! and (feature `generic`) the textbook implementation everything is checked against.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "batch")]
extern crate alloc;
#[cfg(any(feature = "fma", feature = "generic"))]
#[cfg_attr(feature = "parity", macro_use)]
extern crate std;

mod arctan;
mod arm;
#[cfg(feature = "batch")]
pub mod batch;
#[cfg(feature = "generic")]
pub mod generic;
mod interop;
mod inverse;
mod kernel;
#[cfg(feature = "lanes")]
pub mod lanes;
mod output;
#[cfg(feature = "parity")]
pub mod parity;
mod scalar;
#[cfg(any(feature = "lanes", not(feature = "libm")))]
mod sin_cos;
mod solve;

pub use arm::{Arm, Numeric, Row};
#[cfg(feature = "simba")]
pub use interop::simba;
#[doc(hidden)]
pub use inverse::unloaded;
pub use inverse::{
    AtRest, Axes, Elastic, ElbowAngle, Gives, Inverse, JointValues, SetPoints, Solution, Solutions,
    Steps, nearest_branch,
};
#[doc(hidden)]
pub use kernel::fill;
pub use kernel::{Convention, DhRow, Error, Kernels, Motion, Ops, Pose};
pub use output::{Form, Input, Output, Part, Side, has};
pub use scalar::Scalar;
pub use solve::Unstable;
#[doc(hidden)]
pub use solve::{margin, solve, solve_fused};
