//! What is derived, evaluated on its graph and beside the textbook, and what is written of it.

mod common;
mod derivation;
mod dynamics;
mod inverse;
mod latex;
mod places;
mod program;
