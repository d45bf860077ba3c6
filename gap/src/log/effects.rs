//! The laws in motion with which models of a log begin.

use crate::effects::{
    CommandLatency, CoulombFriction, InMotion, JointElasticity, Laws, LinkInertia, Payload,
    ServoDroop, TorqueLatency, TorqueOffset, TorqueScale, TorqueShift, ViscousFriction,
};

pub use crate::effects::{IN_MOTION as CATALOGUE, InMotion as LogEffect, Spot};

/// The laws that a log is asked for.
pub type Catalogue = Laws<dyn InMotion>;

/// What the simple model of a drive has.
pub(super) const COULOMB: &dyn InMotion = &CoulombFriction;
pub(super) const VISCOUS: &dyn InMotion = &ViscousFriction;
pub(super) const OFFSET: &dyn InMotion = &TorqueOffset;

/// A torque that is told too large or too small.
pub(super) const SCALE: &dyn InMotion = &TorqueScale;

/// Torques that are told late: as a finding, and as a scan over delays asks for them.
pub(super) const LATE: &dyn InMotion = &TorqueLatency;
pub(super) const SHIFT: &dyn InMotion = &TorqueShift;

/// What the simple model of servos has.
pub(super) const LATENCY: &dyn InMotion = &CommandLatency;

/// What a log has a joint's spring as: in rows of commands, and of torques.
pub(super) const DROOP: &dyn InMotion = &ServoDroop;
pub(super) const ELASTICITY: &dyn InMotion = &JointElasticity;

/// What is held in runs.
pub(super) const PAYLOAD: &dyn InMotion = &Payload;

/// What the robot file tells of its links.
pub(super) const LINKS: &dyn InMotion = &LinkInertia;
