//! Motors, their sensors and servos.

mod torque_offset;
mod torque_ripple;
mod torque_saturation;
mod torque_scale;
mod tracking_lag;

pub use torque_offset::TorqueOffset;
pub use torque_ripple::TorqueRipple;
pub use torque_saturation::TorqueSaturation;
pub use torque_scale::TorqueScale;
pub use tracking_lag::TrackingLag;
