//! What runs on the microcontroller and on the host alike: kernels of five arms, the inputs that
//! they are given, and a control loop that uses them. Nothing here needs more than `core`.
#![no_std]
#![forbid(unsafe_code)]

#[path = "../../../../examples/computed_torque/step.rs"]
pub mod computed_torque;
pub mod draw;
pub mod everything;
pub mod figures;
#[path = "../../../../examples/impedance/step.rs"]
pub mod impedance;
pub mod outputs;
pub mod path;
pub mod real;
pub mod record;
pub mod robots;
pub mod set_point;
#[path = "../../../../examples/computed_torque/simulated.rs"]
pub mod simulated;
pub mod source;
pub mod swing;

pub use real::Real;
