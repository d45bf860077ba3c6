//! Masses, loads and gravity.

mod counterbalance;
mod gravity_tilt;
mod link_com;
mod link_inertia;
mod link_weight;
mod payload;
mod payload_com;
mod rotor_inertia;
mod wrench_scale;

pub use counterbalance::{Counterbalance, CounterbalanceInMotion};
pub use gravity_tilt::{GravityDirection, GravityTilt};
pub use link_com::LinkCom;
pub use link_inertia::LinkInertia;
pub use link_weight::LinkWeight;
pub use payload::Payload;
pub use payload_com::PayloadCom;
pub use rotor_inertia::RotorInertia;
pub use wrench_scale::WrenchScale;
