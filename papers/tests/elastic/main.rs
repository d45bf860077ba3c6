//! The elastic chain on arms of any kind: random tables of both conventions, and the collection's
//! robots.

mod against_textbook;
mod differences;
mod equilibrium;
mod random;
