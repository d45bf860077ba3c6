//! Compensation of the static deflection at the end-effector: Lin, Chiang & Cui, *An improved
//! method for on-line calculation and compensation of the static deflection at a robot
//! end-effector*, J. Robotic Systems 8(2), 1991.
//!
//! * [`pose_jacobian`], [`orientation_jacobian`], [`differential_jacobian`]: the paper's three
//!   Jacobians (eqs. 5, 25 and 37-41).
//! * [`generalized_forces`]: the load and all weights at every joint (eq. 8).
//! * [`deflections`]: what the links do to the tool, of any table: YT, YC and YD (eqs. 18-36, 46).
//! * [`ParallelElbow`]: all inverse solutions of an arm whose axes 2, 3 and 4 are parallel.
//! * [`correction`], [`plan`]: the joint corrections, and the ten steps.
//!
//! # Definitions
//!
//! * Any one consistent system of units, radians. A twist or displacement is `[dx dy dz drx dry
//!   drz]`, a wrench `[fx fy fz mx my mz]`. The tool's load is constant in base axes and acts at
//!   the tool origin.
//! * Frames are those of `stiffarm_kernels::generic`; the paper's table is a standard one.
//! * Deflections are displacements of the arm, so that a load along −y gives a negative y; the
//!   paper's tables print their magnitudes.
//! * The closed forms of the paper's two arms, eqs. 15 to 46 and the appendix, stand in its data file
//!   with their corrections: they are what these functions are tested against.

mod correction;
mod deflections;
mod forces;
mod inverse;
mod jacobians;
mod plan;

pub use correction::{Correction, correction};
pub use deflections::{Deflections, deflections};
pub use forces::generalized_forces;
pub use inverse::{InverseError, Missing, ParallelElbow, Solution};
pub use jacobians::{differential_jacobian, orientation_jacobian, pose_jacobian};
pub use plan::{Measure, Model, plan};

use stiffarm_kernels::Unstable;

/// Why no deflection or compensation could be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CompensateError {
    /// The target has no inverse solution.
    #[error(transparent)]
    Inverse(#[from] InverseError),
    /// The joint springs do not hold the load.
    #[error(transparent)]
    Unstable(#[from] Unstable),
}
