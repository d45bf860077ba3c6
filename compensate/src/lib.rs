//! Compensation of the static deflection at the end-effector: set-points of any arm, its joint
//! limits kept, at equilibrium in the loaded geometry ([`mod@reach`]), with every effect of its robot file
//! ([`Whole`](stiffarm_gap::whole::Whole)): what must be known to compensate one, the effect says itself
//! ([`Depends`](stiffarm_gap::effects::Depends)).
//!
//! SI units, radians. A load is a wrench `[fx fy fz mx my mz]`, constant in base axes, and acts at
//! the tool origin.

pub mod controller;
#[cfg(test)]
#[path = "../../gap/src/fixture.rs"]
#[allow(dead_code, reason = "the arms of gap's tests, of which few are needed here")]
mod fixture;
pub mod points;
pub mod program;
pub mod reach;

use stiffarm_gap::diagnose::LARGEST;
#[cfg(test)]
use stiffarm_gap::{effects, simulate};
use stiffarm_gap::{io, measurement, rng, robot, whole};

/// Why no compensation could be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CompensateError {
    /// As many joint values are needed as the arm has joints.
    #[error("found {found} joint values, expected {expected}: one for each joint of the arm")]
    JointValues {
        /// Joints of the arm.
        expected: usize,
        /// Values given.
        found: usize,
    },
    /// A number that is not a number, infinite, or so large that its square is.
    #[error("{what} is not a number below {LARGEST:e}: check its unit")]
    NotFinite {
        /// Which number.
        what: &'static str,
    },
    /// A setting that cannot be worked with.
    #[error("found {found} as {what}, expected a positive number")]
    NotPositive {
        /// Which setting.
        what: &'static str,
        /// As given.
        found: f64,
    },
    /// A prismatic joint without limits cannot be searched.
    #[error("joint {joint} is prismatic and has no limits: give it limits, or a start")]
    Unlimited {
        /// From 1.
        joint: usize,
    },
    /// An effect depends on what is not known.
    #[error("{effect} is not compensated without knowing {unknown}")]
    Unknown {
        /// In words.
        effect: String,
        /// On what it depends.
        unknown: &'static str,
    },
    /// The joint springs do not hold the load.
    #[error("the arm has no stable rest under its load: the joint springs would buckle")]
    Unstable,
}

/// Refuses a vector with which nothing can be worked out.
fn finite<'a>(
    what: &'static str,
    values: impl IntoIterator<Item = &'a f64>,
) -> Result<(), CompensateError> {
    if values.into_iter().all(|value| value.abs() < LARGEST) {
        Ok(())
    } else {
        Err(CompensateError::NotFinite { what })
    }
}
