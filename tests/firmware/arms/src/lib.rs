//! What runs on the microcontroller and on the host alike: kernels of five arms, the inputs that
//! they are given, and a control loop that uses them. Nothing here needs more than `core`.
#![no_std]
#![forbid(unsafe_code)]

pub mod draw;
pub mod figures;
#[path = "../../../../examples/impedance/step.rs"]
pub mod impedance;
pub mod outputs;
pub mod real;
pub mod record;
pub mod robots;
pub mod set_point;
pub mod source;

pub use real::Real;
