//! The kernels in C: they compile without a warning and give the Rust kernels' bits.
//!
//! Without a C compiler on the path the tests that need one say so and pass.

mod arms;
mod bits;
mod compiler;
mod program;
mod text;
mod warnings;
