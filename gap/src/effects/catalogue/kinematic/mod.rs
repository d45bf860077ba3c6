//! Lengths, angles, zeros and frames.

mod base_frame;
mod bearing_wobble;
mod geometry;
mod instrument_scale;
mod joint_coupling;
mod joint_offset;
mod joint_ratio;
mod link_geometry;
mod motor_error;
mod tool_frame;
mod transmission_error;

pub use base_frame::BaseFrame;
pub use bearing_wobble::BearingWobble;
pub use geometry::Geometry;
pub use instrument_scale::InstrumentScale;
pub use joint_coupling::{JointCoupling, MotorCoupling};
pub use joint_offset::{JointOffset, JointOffsetInMotion};
pub use joint_ratio::JointRatio;
pub use link_geometry::LinkGeometry;
pub use motor_error::MotorError;
pub use tool_frame::ToolFrame;
pub use transmission_error::TransmissionError;
