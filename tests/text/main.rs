//! The generated text: the same from every form, the same on every run, and of a shape that the
//! compiler and a reader can digest.

mod forms;
mod golden;
mod literals;
mod mistakes;
mod readme;
mod scopes;
mod tables;
