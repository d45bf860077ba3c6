//! Exact forms: quotients of polynomials in symbols, sines and cosines.

pub mod derived;
pub mod evaluate;
pub mod field;
pub mod graph;
pub mod polynomial;
pub(crate) mod print;
pub mod product;
pub mod rational;
