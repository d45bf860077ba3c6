//! The definitions against differences, closed forms, printed tables and independent methods.

mod base;
mod cantilever;
mod differences;
mod dumas2011;
mod dynamics;
mod equilibrium;
mod evaluate;
mod inverse;
mod lin1991;
mod support;
mod virtual_work;
