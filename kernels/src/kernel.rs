//! What every generated robot module offers, whatever its table.

use core::fmt;

use crate::{Scalar, Unstable};

/// A pose: the axes of a frame as columns, and its origin, m; both in base axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<S> {
    /// `rotation[0]` is the frame's x axis, `[1]` its y, `[2]` its z.
    pub rotation: [[S; 3]; 3],
    /// The frame's origin.
    pub position: [S; 3],
}

impl<S: Copy> Pose<S> {
    /// The pose as the first three rows of its homogeneous matrix: columns x, y, z, origin.
    pub fn columns(self) -> [[S; 3]; 4] {
        let [x, y, z] = self.rotation;
        [x, y, z, self.position]
    }
}

/// Copies `values` into `out`.
///
/// # Errors
/// [`Error::Length`] if the two differ in length.
pub fn fill<S: Copy>(out: &mut [S], values: &[S]) -> Result<(), Error> {
    if out.len() != values.len() {
        return Err(Error::Length);
    }
    out.copy_from_slice(values);
    Ok(())
}

/// Operations of a kernel beyond its sines and cosines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ops {
    /// Additions and subtractions.
    pub add: u32,
    /// Multiplications.
    pub mul: u32,
    /// Sign changes that no other operation absorbs.
    pub neg: u32,
    /// Reciprocals and square roots (the solve of the deflection not counted).
    pub div: u32,
    /// Sine-cosine pairs.
    pub sin_cos: u32,
}

impl Ops {
    /// Additions and multiplications together.
    pub const fn flops(self) -> u32 {
        self.add + self.mul
    }
}

/// Whether a joint turns or slides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// `q` adds to theta.
    Revolute,
    /// `q` adds to d.
    Prismatic,
}

/// One row of the Denavit-Hartenberg table as it was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DhRow {
    /// The row's label.
    pub joint: &'static str,
    /// Revolute or prismatic.
    pub motion: Motion,
    /// Offset of theta, as text (`pi/2`).
    pub theta: &'static str,
    /// d (or its offset), m, as text.
    pub d: &'static str,
    /// a, m, as text.
    pub a: &'static str,
    /// alpha, as text.
    pub alpha: &'static str,
    /// Joint stiffness, as text; `rigid` where there is none.
    pub stiffness: &'static str,
}

/// The quantities that a robot module computes; [`Kernels::evaluate`] writes each as one
/// column-major block of [`Output::shape`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Output {
    /// Tool pose: columns x, y, z, origin (3×4).
    Pose,
    /// Poses of frames 1 to n, side by side (3×4n).
    Frames,
    /// Geometric Jacobian, base axes, at the tool origin, translation rows first (6×n).
    Jacobian,
    /// The same in tool axes: Paul's differential Jacobian (6×n).
    JacobianTool,
    /// K_C for a wrench constant in base axes: row j, column i is ∂(column j of J)ᵀ/∂q_i · w (n×n).
    ComplementaryStiffness,
    /// Jᵀw (n).
    JointTorque,
    /// The torque of the links' weights, positive like Jᵀw: what the weights do to the joint (n).
    GravityTorque,
    /// ∂(gravity torque)/∂q, the weights' part of K_C (n×n).
    GravityStiffness,
    /// Σ J_j J_jᵀ/k_j plus the links as beams, base axes, at the tool origin (6×6).
    Compliance,
    /// J Kθ⁻¹ Jᵀ w plus the links: to first order in the load (6).
    DeflectionFirstOrder,
    /// J (Kθ − K_C)⁻¹ Jᵀ w plus the links (6).
    Deflection,
    /// The same under the wrench and the links' weights together (6).
    DeflectionWithGravity,
    /// Twist of the tool per unit of each entry of the table: theta, d, a, alpha of each row, then
    /// the tool's translation and rotation vector (6×(4n+6)).
    ParameterJacobian,
    /// ∂(first-order deflection)/∂(compliance of joint j): J_j J_jᵀ w (6×n); Dumas et al. 2011, eq. 21.
    StiffnessRegressor,
}

impl Output {
    /// Every output, in the order in which documentation and checks list them.
    pub const EACH: [Output; 14] = [
        Output::Pose,
        Output::Frames,
        Output::Jacobian,
        Output::JacobianTool,
        Output::ComplementaryStiffness,
        Output::JointTorque,
        Output::GravityTorque,
        Output::GravityStiffness,
        Output::Compliance,
        Output::DeflectionFirstOrder,
        Output::Deflection,
        Output::DeflectionWithGravity,
        Output::ParameterJacobian,
        Output::StiffnessRegressor,
    ];

    /// The function's name in a generated module.
    pub const fn name(self) -> &'static str {
        match self {
            Output::Pose => "pose",
            Output::Frames => "frames",
            Output::Jacobian => "jacobian",
            Output::JacobianTool => "jacobian_tool",
            Output::ComplementaryStiffness => "complementary_stiffness",
            Output::JointTorque => "joint_torque",
            Output::GravityTorque => "gravity_torque",
            Output::GravityStiffness => "gravity_stiffness",
            Output::Compliance => "compliance",
            Output::DeflectionFirstOrder => "deflection_first_order",
            Output::Deflection => "deflection",
            Output::DeflectionWithGravity => "deflection_with_gravity",
            Output::ParameterJacobian => "parameter_jacobian",
            Output::StiffnessRegressor => "stiffness_regressor",
        }
    }

    /// Rows and columns for an arm of `n` joints.
    pub const fn shape(self, n: usize) -> (usize, usize) {
        match self {
            Output::Pose => (3, 4),
            Output::Frames => (3, 4 * n),
            Output::Jacobian | Output::JacobianTool | Output::StiffnessRegressor => (6, n),
            Output::ComplementaryStiffness | Output::GravityStiffness => (n, n),
            Output::JointTorque | Output::GravityTorque => (n, 1),
            Output::Compliance => (6, 6),
            Output::DeflectionFirstOrder | Output::Deflection | Output::DeflectionWithGravity => {
                (6, 1)
            }
            Output::ParameterJacobian => (6, 4 * n + 6),
        }
    }
}

/// Why an evaluation by slices did not take place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Error {
    /// `q` or `out` is not of the robot's and output's length.
    Length,
    /// The arm is not stable under the load.
    Unstable,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Length => {
                f.write_str("a slice is not of the length that the robot's output has")
            }
            Error::Unstable => Unstable.fmt(f),
        }
    }
}

impl core::error::Error for Error {}

impl From<Unstable> for Error {
    fn from(_: Unstable) -> Self {
        Error::Unstable
    }
}

/// A generated robot behind a pointer: what the command line, checks and benches go through. Code
/// that knows its robot calls the module's functions instead.
pub trait Kernels<S: Scalar> {
    /// The arm's name.
    fn name(&self) -> &'static str;

    /// Number of joints.
    fn dof(&self) -> usize;

    /// Writes `output` at the joint values `q` (rad, m) under `wrench` (N, N·m; base axes, at the
    /// tool origin) into `out`, column by column. Outputs that need no wrench ignore it.
    ///
    /// # Errors
    /// [`Error::Length`] where a slice has the wrong length, [`Error::Unstable`] where the deflection
    /// has no stable equilibrium; `out` is then as it was.
    fn evaluate(
        &self,
        output: Output,
        q: &[S],
        wrench: &[S; 6],
        out: &mut [S],
    ) -> Result<(), Error>;
}
