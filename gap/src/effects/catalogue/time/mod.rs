//! What goes with time, temperature, or the moment of a reading.

mod drift;
mod joint_warming;
mod latency;
mod settling_lag;
mod slip;
mod thermal_growth;

pub use drift::Drift;
pub use joint_warming::JointWarming;
pub use latency::{CommandLatency, Latency, TorqueLatency, TorqueShift};
pub use settling_lag::SettlingLag;
pub use slip::Slip;
pub use thermal_growth::ThermalGrowth;
