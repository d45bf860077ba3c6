//! Compensation of force errors: joint corrections with which a flexible arm puts the wanted wrench
//! on its environment (Bicchi & Melchiorri, sections 3-5).
//!
//! A wrist sensor gives the wrench in the displaced tool. In the base frame it is `w = K_E ᴱw`,
//! which depends on the posture and on all deformations; wanted is `w_d`. [`compensate`] moves the
//! joints so that `V = eᵀ P e/2`, `e = w_d − w`, gets as small as it can.
//!
//! * Wrenches are in base axes about the base's origin, N and N·m, and act *on* the robot.
//! * Only as many components of e can be brought to zero as the joints move independently, and the
//!   size of a force that turns with the tool never changes. What remains is reported
//!   ([`Outcome::error`], [`Outcome::ended`], [`Outcome::rank`]) and not hidden.
//! * Joint limits are not regarded.

mod compensate;
pub mod law;
mod newton;
mod weights;

pub use compensate::{Ended, Gradient, Method, Outcome, Stop, Task, compensate};
pub use weights::Weights;

use crate::chain::ChainError;

/// Why no compensation could be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ForceError {
    /// A length that cannot weight moments.
    #[error(
        "found {found} as the length that weights moments, expected a positive number of metres"
    )]
    Length {
        /// As given.
        found: f64,
    },
    /// A number that is infinite or not a number.
    #[error("{what} is not a finite number")]
    NotFinite {
        /// Which number.
        what: &'static str,
    },
    /// The arm has no rest under its load at the joint values to start from.
    #[error("at the joint values to start from: {0}")]
    Start(#[source] ChainError),
    /// A step of the chosen method led to joint values at which the arm has no rest.
    #[error("step {step} led to joint values without rest: {source}")]
    Step {
        /// Number of the step, from 1.
        step: usize,
        /// What the arm says there.
        source: ChainError,
    },
}
