//! What can be derived of an arm.

/// A quantity that the generator derives; `all` is a set of them in one function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Output {
    /// Tool pose: columns x, y, z, origin (3×4).
    Pose,
    /// Poses of frames 1 to n side by side (3×4n).
    Frames,
    /// Geometric Jacobian in base axes at the tool origin (6×n).
    Jacobian,
    /// The same in tool axes (6×n).
    JacobianTool,
    /// K_C (n×n).
    ComplementaryStiffness,
    /// Jᵀw (n).
    JointTorque,
    /// Torque of the links' weights (n).
    GravityTorque,
    /// The weights' part of K_C (n×n).
    GravityStiffness,
    /// Joints and beams (6×6).
    Compliance,
    /// J Kθ⁻¹ Jᵀ w and the links (6).
    DeflectionFirstOrder,
    /// J (Kθ − K_C)⁻¹ Jᵀ w and the links (6).
    Deflection,
    /// The same under wrench and weights (6).
    DeflectionWithGravity,
    /// ∂pose/∂(every entry of the table) as twists (6×(4n+6)).
    ParameterJacobian,
    /// ∂deflection/∂(joint compliance) (6×n).
    StiffnessRegressor,
}

impl Output {
    /// Every output, in the order of documentation and generated text.
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

    /// What the fused function `all` computes.
    pub const ALL: [Output; 6] = [
        Output::Pose,
        Output::Jacobian,
        Output::ComplementaryStiffness,
        Output::JointTorque,
        Output::Compliance,
        Output::Deflection,
    ];

    /// The function's name in generated code.
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

    /// Whether the output is a vector, not a matrix that happens to have one column.
    pub const fn is_vector(self) -> bool {
        matches!(
            self,
            Output::JointTorque
                | Output::GravityTorque
                | Output::DeflectionFirstOrder
                | Output::Deflection
                | Output::DeflectionWithGravity
        )
    }

    /// Whether the output depends on the wrench on the tool.
    pub const fn needs_wrench(self) -> bool {
        matches!(
            self,
            Output::ComplementaryStiffness
                | Output::JointTorque
                | Output::DeflectionFirstOrder
                | Output::Deflection
                | Output::DeflectionWithGravity
                | Output::StiffnessRegressor
        )
    }

    /// Whether a load can leave the output without a value: the arm may be unstable under it.
    pub const fn is_fallible(self) -> bool {
        matches!(self, Output::Deflection | Output::DeflectionWithGravity)
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
