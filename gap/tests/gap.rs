//! The diagnosis on what others measured, on plants that are written down in closed form, and on any input.

mod agreement;
mod fuzz;
mod lin;
mod log;
mod one_file;
mod ur10;
