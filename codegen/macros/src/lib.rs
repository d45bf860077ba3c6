//! The `robot!` macro: a shim over `stiffarm-codegen`.
#![forbid(unsafe_code)]

use std::path::PathBuf;

use proc_macro::TokenStream;

/// Turns a Denavit-Hartenberg table into a module of closed-form kernels.
///
/// ```ignore
/// robot! {
///     /// KUKA KR 240-2 (Dumas et al. 2011, Table 3).
///     pub mod kr240;
///     convention: modified_dh;
///     joint | theta | d       | a       | alpha  | stiffness
///     a1    | q     | 0       | 0       | 0      | 3.8e6 N*m/rad
///     a2    | q     | 0       | 350 mm  | 90 deg | 6.6e6 N*m/rad
/// }
/// robot! { pub mod elbow from "elbow.toml"; }
/// ```
///
/// `products: fused;` beside the other settings (or beside a file) writes products fused into sums: faster
/// where the target has the instruction and the kernels' feature `fma` asks for it, and not the same
/// bits everywhere.
///
/// A file's name is relative to the folder of the invoking crate's Cargo.toml. `q` in `theta` is a
/// revolute joint, in `d` a prismatic one; a bare identifier in a cell stays symbolic.
#[proc_macro]
pub fn robot(input: TokenStream) -> TokenStream {
    let root = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from).unwrap_or_default();
    stiffarm_codegen::expand(input.into(), &root).into()
}
