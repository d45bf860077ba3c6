//! The kernels in C: they compile without a warning and give the Rust kernels' bits.
//!
//! Each by the compiler that Rust links with, and by clang where `-- --ignored` asks for it.

mod arms;
mod bits;
mod compiler;
mod inverse;
mod program;
mod text;
mod warnings;
