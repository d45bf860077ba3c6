//! What an equation should be, in the generator's graph, and how what is printed is held against it.

pub mod arithmetic;
pub mod derived;
pub mod field;
pub mod forms;
pub mod polynomial;
pub(crate) mod print;
pub mod product;
pub mod reader;
pub mod reading;
pub mod truth;
