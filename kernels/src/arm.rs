//! An arm that is known when a program is compiled: what control loops are written against.

use crate::{Convention, DhRow, Scalar};

/// A generated arm of N joints, computed with numbers `S`. What it can compute are the traits of [`has`](crate::has),
/// one for each output:
///
/// ```
/// use stiffarm_kernels::{Arm, Scalar, has};
///
/// /// Joint rates that a wrench on the tool moves compliant joints at: `q̇ = b Jᵀ w`.
/// fn yielding<S: Scalar, const N: usize, A>(arm: &A, q: &[S; N], wrench: &[S; 6], b: S) -> [S; N]
/// where
///     A: has::JointTorque<N, S>,
/// {
///     arm.joint_torque(&arm.posture(q), wrench).map(|torque| b * torque)
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no arm of this number of joints, computed with these numbers",
    note = "the arm of a generated module is its `Robot`: `arm::Robot`, or `arm::Robot::new(&parameters)`"
)]
pub trait Arm<const N: usize, S: Scalar = f64> {
    /// The arm's name.
    const NAME: &'static str;
    /// The table as it was written, base to tip.
    const DH: [DhRow; N];
    /// Limits of the joints, rad (prismatic joint: m), where the table has them.
    const LIMITS: [Option<[f64; 2]>; N];
    /// Sines, cosines and displacements of the joints, as the outputs need them.
    type Posture: Copy;

    /// The posture at joint values `q`, rad (prismatic joint: m): once for all outputs.
    fn posture(&self, q: &[S; N]) -> Self::Posture;
}

/// An arm whose table has no symbolic parameters.
#[diagnostic::on_unimplemented(
    message = "the table of `{Self}` has symbolic parameters, or it is no arm of this number of joints"
)]
pub trait Numeric<const N: usize> {
    /// How the rows become transforms.
    const CONVENTION: Convention;
    /// The rows in numbers, base to tip.
    const ROWS: [Row; N];
    /// Gravity, m/s², base axes.
    const GRAVITY: [f64; 3];
}

/// One row of the Denavit-Hartenberg table in numbers, with what hangs on it. It says nothing about beams.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Row {
    /// rad; of a revolute joint the offset.
    pub theta: f64,
    /// m; of a prismatic joint the offset.
    pub d: f64,
    /// m.
    pub a: f64,
    /// rad.
    pub alpha: f64,
    /// N·m/rad (prismatic joint: N/m); `None` is rigid.
    pub stiffness: Option<f64>,
    /// kg.
    pub mass: f64,
    /// Centre of that mass in the row's own frame, m.
    pub com: [f64; 3],
}
