//! Other crates' numbers and shapes, each behind a feature of its name.

#[cfg(feature = "nalgebra")]
mod nalgebra;
#[cfg(feature = "num-dual")]
mod num_dual;
#[cfg(feature = "simba")]
pub mod simba;
