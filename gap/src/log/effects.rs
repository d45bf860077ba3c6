//! The laws in motion with which models of a log begin.

use crate::effects::{
    CommandLatency, CoulombFriction, InMotion, JointElasticity, Laws, LinkInertia, ServoDroop,
    TorqueOffset, ViscousFriction,
};

// alias: old path
pub use crate::effects::{IN_MOTION as CATALOGUE, InMotion as LogEffect, Spot};

/// The laws that a log is asked for.
pub type Catalogue = Laws<dyn InMotion>;

/// What the simple model of a drive has.
pub(super) const COULOMB: &dyn InMotion = &CoulombFriction;
pub(super) const VISCOUS: &dyn InMotion = &ViscousFriction;
pub(super) const OFFSET: &dyn InMotion = &TorqueOffset;

/// What the simple model of servos has.
pub(super) const LATENCY: &dyn InMotion = &CommandLatency;

/// What a log has a joint's spring as: in rows of commands, and of torques.
pub(super) const DROOP: &dyn InMotion = &ServoDroop;
pub(super) const ELASTICITY: &dyn InMotion = &JointElasticity;

/// What the robot file tells of its links.
pub(super) const LINKS: &dyn InMotion = &LinkInertia;
