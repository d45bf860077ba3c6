//! The effects that stiffarm knows, one file each.

mod drive;
mod elastic;
mod friction;
mod kinematic;
mod mass;
mod time;

use super::{AtRest, InMotion};

pub use drive::*;
pub use elastic::*;
pub use friction::*;
pub use kinematic::*;
pub use mass::*;
pub use time::*;

/// How they act at rest, in the order in which equally good explanations are preferred.
pub const AT_REST: [&dyn AtRest; 33] = [
    &JointOffset,
    &JointCompliance,
    &Backlash,
    &JointRatio,
    &SettlingLag,
    &Latency,
    &FrictionHysteresis,
    &JointHardening,
    &LoadedBacklash,
    &SoftZone,
    &TransmissionError,
    &MotorError,
    &Counterbalance,
    &JointCoupling,
    &LinkCompliance,
    &BearingCompliance,
    &LinkWeight,
    &WrenchScale,
    &PayloadCom,
    &LinkCom,
    &GravityTilt,
    &BaseCompliance,
    &ThermalGrowth,
    &JointWarming,
    &InstrumentScale,
    &BearingWobble,
    &LinkGeometry,
    &Geometry,
    &BaseFrame,
    &ToolFrame,
    &Slip,
    &Drift,
    &GeometricStiffness,
];

/// How they act in motion, in that order.
pub static IN_MOTION: [&dyn InMotion; 26] = [
    &CoulombFriction,
    &ViscousFriction,
    &FrictionCurve,
    &Stribeck,
    &Presliding,
    &LoadFriction,
    &TorqueSaturation,
    &AsymmetricFriction,
    &TorqueOffset,
    &TorqueScale,
    &RotorInertia,
    &LinkInertia,
    &Payload,
    &GravityDirection,
    &JointOffsetInMotion,
    &CounterbalanceInMotion,
    &MotorCoupling,
    &TorqueRipple,
    &JointElasticity,
    &WarmUp::ByMinute,
    &WarmUp::ByKelvin,
    &TorqueLatency,
    &CommandLatency,
    &TrackingLag,
    &ServoDroop,
    &BacklashInMotion,
];

/// The one that adds to the spring of a joint.
pub(crate) const JOINT_SPRING: &dyn AtRest = &JointCompliance;
