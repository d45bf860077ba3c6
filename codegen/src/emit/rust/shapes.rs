//! How each output looks in Rust: its type, its places, its documentation.

use crate::derive::Output;

/// The type that a function returns, without `Result`.
pub(super) fn ty(output: Output, n: usize) -> String {
    let (rows, columns) = output.shape(n);
    match output {
        Output::Pose => "Pose<S>".to_string(),
        Output::Frames => format!("[Pose<S>; {n}]"),
        _ if output.is_vector() => format!("[S; {rows}]"),
        _ => format!("[[S; {rows}]; {columns}]"),
    }
}

/// A value of the type with every entry `zero`.
pub(super) fn zero(output: Output, n: usize) -> String {
    let (rows, columns) = output.shape(n);
    match output {
        Output::Pose => "Pose { rotation: [[zero; 3]; 3], position: [zero; 3] }".to_string(),
        Output::Frames => format!("[{}; {n}]", zero(Output::Pose, n)),
        _ if output.is_vector() => format!("[zero; {rows}]"),
        _ => format!("[[zero; {rows}]; {columns}]"),
    }
}

/// The place of column-major entry `entry`.
pub(super) fn place(output: Output, n: usize, entry: usize) -> String {
    let rows = output.shape(n).0;
    let (column, row) = (entry / rows, entry % rows);
    let pose = |column: usize| match column {
        3 => format!(".position[{row}]"),
        _ => format!(".rotation[{column}][{row}]"),
    };
    match output {
        Output::Pose => pose(column),
        Output::Frames => format!("[{}]{}", column / 4, pose(column % 4)),
        _ if output.is_vector() => format!("[{row}]"),
        _ => format!("[{column}][{row}]"),
    }
}

/// What the function computes: a sentence, and the formula in the papers' notation.
pub(super) fn docs(output: Output) -> [&'static str; 2] {
    match output {
        Output::Pose => ["Pose of the tool in base axes.", "T = A_1 A_2 … A_n T_tool, m."],
        Output::Frames => ["Poses of frames 1 to n in base axes.", "T_i = A_1 A_2 … A_i, m."],
        Output::Jacobian => [
            "Geometric Jacobian, base axes, at the tool origin; `[j][i]` is row i of column j.",
            "J_j = [z_j × (p − p_j); z_j] of a joint that turns, [z_j; 0] of one that slides: \
             m/rad and 1, or 1 and 0 (Dumas et al. 2011, eq. 1).",
        ],
        Output::JacobianTool => [
            "Geometric Jacobian, tool axes, at the tool origin; `[j][i]` is row i of column j.",
            "blockdiag(Rᵀ, Rᵀ) J with R the tool's rotation: Paul's differential Jacobian \
             (Lin et al. 1991, eqs. 37 to 41).",
        ],
        Output::ComplementaryStiffness => [
            "K_C, N·m/rad: how the joint torques of a constant wrench change with the posture; \
             `[i][j]` is row j of column i.",
            "(K_C)_ji = ∂(J_j)ᵀ/∂q_i · w (Dumas et al. 2011, eq. 9). Unsymmetric under a moment.",
        ],
        Output::JointTorque => {
            ["Joint torques of the wrench, N·m (N).", "τ = Jᵀ w (Dumas et al. 2011, eq. 3)."]
        }
        Output::GravityTorque => [
            "Joint torques of the links' weights, N·m (N); positive like Jᵀ w.",
            "τ_g,j = Σ_k m_k g · (z_j × (c_k − p_j)) over the masses beyond joint j.",
        ],
        Output::GravityStiffness => [
            "How the torques of the links' weights change with the posture, N·m/rad; `[i][j]` is \
             row j of column i.",
            "∂τ_g,j/∂q_i: the weights' part of K_C.",
        ],
        Output::Compliance => [
            "Compliance of the tool, base axes, m/N, rad/N, rad/(N·m); `[c][r]` is row r of column c.",
            "C = Σ_j J_j J_jᵀ/k_j + Σ links (Knapczyk & Ryska, eq. 4; links as Euler-Bernoulli beams).",
        ],
        Output::DeflectionFirstOrder => [
            "Displacement of the tool under the wrench, base axes, m and rad, to first order.",
            "δd = J K_θ⁻¹ Jᵀ w + the links as beams.",
        ],
        Output::Deflection => [
            "Displacement of the tool under the wrench, base axes, m and rad, with the loaded geometry.",
            "δd = J (K_θ − K_C)⁻¹ Jᵀ w + the links as beams (Dumas et al. 2011, eqs. 7 and 10).",
        ],
        Output::DeflectionWithGravity => [
            "Displacement of the tool under the wrench and the links' weights, base axes, m and rad.",
            "δd = J (K_θ − K_C − K_G)⁻¹ (Jᵀ w + τ_g) + the links under tip load and distributed weight.",
        ],
        Output::ParameterJacobian => [
            "Twist of the tool per unit of each entry of the table, base axes, at the tool origin; \
             `[k][i]` is row i of column k.",
            "Columns theta, d, a, alpha of each row, then the tool's translation and rotation vector.",
        ],
        Output::StiffnessRegressor => [
            "Displacement of the tool per unit of each joint's compliance, base axes; `[j][i]` is \
             row i of column j.",
            "J_j J_jᵀ w (Dumas et al. 2011, eq. 21).",
        ],
    }
}
