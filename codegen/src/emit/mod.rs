//! Printers of the derived graph: Rust, LaTeX, dot. Each is one file or folder.

mod constants;
mod dot;
mod expression;
mod latex;
mod plan;
mod rust;

pub use dot::dot;
pub use latex::{flexible_latex, latex};
pub use rust::{RustOptions, flexible_rust, rust, rust_fused};
