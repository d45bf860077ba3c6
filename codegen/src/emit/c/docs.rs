//! What each function computes, in plain characters, for the comments of the header.

use crate::derive::Output;

/// A sentence and the formula.
pub(super) fn docs(output: Output) -> [&'static str; 2] {
    match output {
        Output::Pose => [
            "Pose of the tool in base axes: columns x, y, z, origin.",
            "T = A_1 A_2 ... A_n T_tool, m.",
        ],
        Output::Frames => [
            "Poses of frames 1 to n in base axes, one behind the other.",
            "T_i = A_1 A_2 ... A_i, m.",
        ],
        Output::Jacobian => [
            "Geometric Jacobian, base axes, at the tool origin: translation, then rotation.",
            "J_j = [z_j x (p - p_j); z_j] of a joint that turns, [z_j; 0] of one that slides.",
        ],
        Output::JacobianTool => [
            "Geometric Jacobian, tool axes, at the tool origin.",
            "blockdiag(R', R') J with R the tool's rotation.",
        ],
        Output::ComplementaryStiffness => [
            "K_C, N*m/rad: how the joint torques of a constant wrench change with the posture.",
            "(K_C)_ji = d(J_j)'/dq_i * w. Unsymmetric under a moment.",
        ],
        Output::JointTorque => ["Joint torques of the wrench, N*m (N).", "tau = J' w."],
        Output::GravityTorque => [
            "Joint torques of the links' weights, N*m (N); positive like J' w.",
            "tau_g,j = sum of m_k g * (z_j x (c_k - p_j)) over the masses beyond joint j.",
        ],
        Output::GravityStiffness => [
            "How the torques of the links' weights change with the posture, N*m/rad.",
            "d(tau_g,j)/dq_i: the weights' part of K_C.",
        ],
        Output::Compliance => [
            "Compliance of the tool, base axes, m/N, rad/N, rad/(N*m).",
            "C = sum of J_j J_j'/k_j + links as Euler-Bernoulli beams.",
        ],
        Output::DeflectionFirstOrder => [
            "Displacement of the tool under the wrench, base axes, m and rad, to first order.",
            "J K_theta^-1 J' w + links as beams.",
        ],
        Output::Deflection => [
            "Displacement of the tool under the wrench, base axes, m and rad, loaded geometry.",
            "J (K_theta - K_C)^-1 J' w + links as beams.",
        ],
        Output::DeflectionWithGravity => [
            "Displacement of the tool under the wrench and the links' weights, base axes, m and rad.",
            "J (K_theta - K_C - K_G)^-1 (J' w + tau_g) + links under tip load and own weight.",
        ],
        Output::ParameterJacobian => [
            "Twist of the tool per unit of each entry of the table, base axes, at the tool origin.",
            "Columns theta, d, a, alpha of each row, then the tool's translation and rotation.",
        ],
        Output::StiffnessRegressor => [
            "Displacement of the tool per unit of each joint's compliance, base axes.",
            "J_j J_j' w.",
        ],
    }
}
