//! Printers of the derived graph: Rust, C, LaTeX, dot. Each is one file or folder.

mod angles;
mod c;
mod constants;
mod docs;
mod dot;
mod expression;
mod latex;
mod lines;
mod literal;
mod plan;
mod rust;

pub use c::{CFiles, COptions, Precision, Sines, SymbolicTable, c, c_name};
pub use dot::dot;
pub use latex::{flexible_latex, latex};
pub use rust::{FILE_HEAD, RustOptions, flexible_rust, rust};
