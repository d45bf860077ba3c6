//! An arm's outputs, a method each. Written by tools/outputs.py.

use pyo3::prelude::*;
use stiffarm_kernels::Output;

use super::Arm;
use super::evaluate::Beside;
use super::method::methods;

methods! {
    /// Pose of the tool in base axes.
    ///
    /// T = A_1 A_2 … A_n T_tool
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// Result: (4, 4), in m (axes: 1).
    pose(q) Pose;

    /// Poses of frames 1 to n in base axes.
    ///
    /// T_i = A_1 A_2 … A_i
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// Result: (n, 4, 4), in m (axes: 1).
    frames(q) Frames;

    /// Geometric Jacobian, base axes, at the tool origin.
    ///
    /// J_j = [z_j × (p − p_j); z_j] of a revolute joint, [z_j; 0] of a prismatic one
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// Result: (6, n), in m/rad (prismatic joint: 1), rad/rad (prismatic joint: 0).
    jacobian(q) Jacobian;

    /// Geometric Jacobian, tool axes, at the tool origin: Paul's differential Jacobian.
    ///
    /// blockdiag(Rᵀ, Rᵀ) J with R the tool's rotation
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// Result: (6, n), in m/rad (prismatic joint: 1), rad/rad (prismatic joint: 0).
    jacobian_tool(q) JacobianTool;

    /// Geometric Jacobian, base axes, at the base's origin (of the world, in which the base stands): the spatial Jacobian.
    ///
    /// [p_j × z_j; z_j] of a revolute joint, [z_j; 0] of a prismatic one
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// Result: (6, n), in m/rad (prismatic joint: 1), rad/rad (prismatic joint: 0).
    jacobian_spatial(q) JacobianSpatial;

    /// K_C: how the joint torques of a wrench that is constant in base axes change with the posture.
    ///
    /// (K_C)_ji = ∂(J_j)ᵀ/∂q_i · w; unsymmetric under a moment
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// wrench: force and moment on the tool, N and N·m, base axes, at the tool's origin.
    /// Result: (n, n), in N·m/rad (prismatic joint: N, two of them: N/m).
    complementary_stiffness(q; wrench) ComplementaryStiffness;

    /// Joint torques of the wrench.
    ///
    /// τ = Jᵀ w
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// wrench: force and moment on the tool, N and N·m, base axes, at the tool's origin.
    /// Result: (n,), in N·m (prismatic joint: N).
    joint_torque(q; wrench) JointTorque;

    /// Joint torques of the links' weights, positive like Jᵀ w: what the weights do to the joints, −g(q) of the equations of motion. The motors hold the opposite, g(q).
    ///
    /// τ_g,j = Σ_k m_k g · (z_j × (c_k − p_j)) over the masses beyond joint j
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// Result: (n,), in N·m (prismatic joint: N).
    weight_torque(q) WeightTorque;

    /// K_G: how the torques of the links' weights change with the posture, the weights' part of K_C.
    ///
    /// (K_G)_ji = ∂τ_g,j/∂q_i
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// Result: (n, n), in N·m/rad (prismatic joint: N, two of them: N/m).
    weight_stiffness(q) WeightStiffness;

    /// Compliance of the tool, base axes, at the tool origin; links as Euler-Bernoulli beams.
    ///
    /// C = Σ_j J_j J_jᵀ/k_j + Σ links
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// Result: (6, 6), in m/N and m/(N·m), rad/N and rad/(N·m).
    compliance(q) Compliance;

    /// Displacement of the tool under the wrench, base axes, at the tool origin, to first order in the load.
    ///
    /// δd = J K_θ⁻¹ Jᵀ w + the links as beams
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// wrench: force and moment on the tool, N and N·m, base axes, at the tool's origin.
    /// Result: (6,), in m, rad.
    deflection_first_order(q; wrench) DeflectionFirstOrder;

    /// Displacement of the tool under the wrench, base axes, at the tool origin, with the stiffness of the loaded geometry.
    ///
    /// δd = J (K_θ − K_C)⁻¹ Jᵀ w + the links as beams
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// wrench: force and moment on the tool, N and N·m, base axes, at the tool's origin.
    /// Result: (6,), in m, rad.
    ///
    /// Raises Unstable where the arm has no stable equilibrium; the others are in `out`.
    deflection(q; wrench) Deflection;

    /// Displacement of the tool under the wrench and the links' weights, base axes, at the tool origin.
    ///
    /// δd = J (K_θ − K_C − K_G)⁻¹ (Jᵀ w + τ_g) + the links under tip load and own weight
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// wrench: force and moment on the tool, N and N·m, base axes, at the tool's origin.
    /// Result: (6,), in m, rad.
    ///
    /// Raises Unstable where the arm has no stable equilibrium; the others are in `out`.
    deflection_with_gravity(q; wrench) DeflectionWithGravity;

    /// Twist of the tool per unit of each entry of the table, base axes, at the tool origin.
    ///
    /// J_p,k = ∂T/∂(entry k), as a twist
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// Result: (6, 4 n + 6), in m/rad (length: 1), rad/rad (length: 0).
    parameter_jacobian(q) ParameterJacobian;

    /// Displacement of the tool per unit of each joint's compliance under the wrench, base axes, at the tool origin: the regressor of joint springs.
    ///
    /// B_j = ∂δd/∂(1/k_j) = J_j J_jᵀ w
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// wrench: force and moment on the tool, N and N·m, base axes, at the tool's origin.
    /// Result: (6, n), in N·m²/rad (prismatic joint: N), N·m (prismatic joint: 0).
    compliance_regressor(q; wrench) ComplianceRegressor;

    /// Torques of the joints' motors for a motion, at the joints.
    ///
    /// τ = M(q) q̈ + b(q, q̇), b with the weights, with centrifugal and Coriolis forces and with friction; sign(0) = 0 of a joint at rest
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// qd: their rates, in rad/s (prismatic joint: m/s).
    /// qdd: their accelerations, in rad/s² (prismatic joint: m/s²).
    /// Result: (n,), in N·m (prismatic joint: N).
    inverse_dynamics(q, qd, qdd) InverseDynamics;

    /// Torques of the joints' motors where no joint accelerates: weights, centrifugal and Coriolis forces, friction; at rest g(q), the opposite of the weight torque.
    ///
    /// b(q, q̇) = τ(q, q̇, 0)
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// qd: their rates, in rad/s (prismatic joint: m/s).
    /// Result: (n,), in N·m (prismatic joint: N).
    bias(q, qd) Bias;

    /// Mass matrix: torques of the joints' motors per unit of each joint's acceleration.
    ///
    /// M_ji = ∂τ_j/∂q̈_i; twice the kinetic energy is q̇ᵀ M q̇
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// Result: (n, n), in kg·m² (prismatic joint: kg·m, two of them: kg).
    mass_matrix(q) MassMatrix;

    /// Kinematic Hessian: how the geometric Jacobian, base axes, at the tool origin, changes by each joint.
    ///
    /// H_i = ∂J/∂q_i
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// Result: (n, 6, n), in m/rad² (a prismatic joint: m/rad), rad/rad².
    hessian(q) Hessian;

    /// Rate of the geometric Jacobian, base axes, at the tool origin: the tool accelerates by J q̈ + J̇ q̇.
    ///
    /// J̇ = Σ_i ∂J/∂q_i q̇_i
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// qd: their rates, in rad/s (prismatic joint: m/s).
    /// Result: (6, n), in m/(rad s) (prismatic joint: 1/s), 1/s.
    jacobian_rate(q, qd) JacobianRate;

    /// How the compliance of the tool, base axes, at the tool origin, changes by each joint.
    ///
    /// ∂C/∂q_i
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// Result: (n, 6, 6), in m/N and m/(N·m), per rad (prismatic joint: m), rad/N and rad/(N·m), per rad (m).
    compliance_by_joints(q) ComplianceByJoints;

    /// How the displacement of the tool under the wrench, base axes, at the tool origin, changes by each joint, with the stiffness of the loaded geometry.
    ///
    /// ∂δd/∂q_i, of J x with (K_θ − K_C) ∂x/∂q_i = ∂τ/∂q_i + ∂K_C/∂q_i x
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// wrench: force and moment on the tool, N and N·m, base axes, at the tool's origin.
    /// Result: (6, n), in m/rad (prismatic joint: 1), rad/rad (prismatic joint: rad/m).
    ///
    /// Raises Unstable where the arm has no stable equilibrium; the others are in `out`.
    deflection_by_joints(q; wrench) DeflectionByJoints;

    /// Manipulability at the tool origin: the product of the Jacobian's singular values, zero where the tool cannot move in some direction.
    ///
    /// w = √det(J Jᵀ); of fewer than six joints √det(Jᵀ J)
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// Result: (), in m per rad for each singular value of a translation.
    manipulability(q) Manipulability;

    /// Gradient of the manipulability by the joints; zero at a singular posture, where there is none.
    ///
    /// ∂w/∂q_i = w tr(J⁺ ∂J/∂q_i)
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// Result: (n,), in that of the manipulability, per rad (prismatic joint: m).
    manipulability_by_joints(q) ManipulabilityByJoints;

    /// How the torques of the joints' motors for a motion change by each joint value.
    ///
    /// ∂τ_j/∂q_i of τ(q, q̇, q̈)
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// qd: their rates, in rad/s (prismatic joint: m/s).
    /// qdd: their accelerations, in rad/s² (prismatic joint: m/s²).
    /// Result: (n, n), in N·m/rad (prismatic joint: N, two of them: N/m).
    inverse_dynamics_by_joints(q, qd, qdd) InverseDynamicsByJoints;

    /// How the torques of the joints' motors for a motion change by each joint's rate, whatever the accelerations; dry friction's step at rest apart.
    ///
    /// ∂τ_j/∂q̇_i of τ(q, q̇, q̈); that by q̈_i is the mass matrix
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// qd: their rates, in rad/s (prismatic joint: m/s).
    /// Result: (n, n), in N·m·s/rad (prismatic joint: N·s, two of them: N·s/m).
    inverse_dynamics_by_rates(q, qd) InverseDynamicsByRates;

    /// Accelerations of the joints under their motors' torques.
    ///
    /// q̈ = M(q)⁻¹ (τ − b(q, q̇)); none where a joint moves no mass and M is not positive definite
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// qd: their rates, in rad/s (prismatic joint: m/s).
    /// tau: torques of the joints' motors, in N·m (prismatic joint: N).
    /// Result: (n,), in rad/s² (prismatic joint: m/s²).
    ///
    /// Raises Unstable where the arm has no stable equilibrium; the others are in `out`.
    forward_dynamics(q, qd, tau) ForwardDynamics;

    /// Torques of the joints' motors for a motion per unit of each link's moments of mass; rotors and friction apart.
    ///
    /// Y_k = ∂τ/∂π_k and τ = Y π; π of a link: m, m c_x, m c_y, m c_z, and xx, xy, yy, xz, yz, zz of its tensor of inertia about the row's origin, all in the row's axes
    ///
    /// q: joint values, base to tip, in rad (prismatic joint: m).
    /// qd: their rates, in rad/s (prismatic joint: m/s).
    /// qdd: their accelerations, in rad/s² (prismatic joint: m/s²).
    /// Result: (n, 10 n), in m/s² (first moments: m/s²·m, tensor: 1/s²; times m of a revolute joint).
    torque_regressor(q, qd, qdd) TorqueRegressor;
}
