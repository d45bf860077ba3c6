//! The table of outputs: one row each. Whatever prints, documents, evaluates or checks an output reads
//! it here.

use super::traits::{has, value};
use super::{Input, Part, Side};

/// The enum and its descriptions from the rows of the table.
macro_rules! outputs {
    ($(
        $output:ident {
            name: $name:ident,
            sentence: $sentence:literal,
            formula: $formula:literal,
            source: $source:literal,
            symbol: $symbol:literal,
            rows: $rows:ident [$($unit:literal),+],
            columns: $columns:ident,
            inputs: [$($input:ident),*],
            parts: [$($part:ident),*],
            fallible: $fallible:tt,
            fused: $fused:literal,
            $(on_request: $like:ident,)?
        }
    )+) => {
        /// The quantities that a robot module computes; [`Kernels::evaluate`](crate::Kernels::evaluate)
        /// writes each as one column-major block of [`Output::shape`].
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[cfg_attr(feature = "defmt", derive(defmt::Format))]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
        #[non_exhaustive]
        pub enum Output {
            $(
                #[doc = $sentence]
                #[doc = ""]
                #[doc = $formula]
                #[doc = $source]
                $output,
            )+
        }

        impl Output {
            /// Every output, in the order of documentation, generated text and checks.
            pub const EACH: [Output; [$(Output::$output),+].len()] = [$(Output::$output),+];

            /// The function's name in a generated module.
            pub const fn name(self) -> &'static str {
                match self { $(Output::$output => stringify!($name),)+ }
            }

            /// What it is, with the axes and the point that it is given in: one sentence.
            pub const fn sentence(self) -> &'static str {
                match self { $(Output::$output => $sentence,)+ }
            }

            /// Its definition in the papers' notation.
            pub const fn formula(self) -> &'static str {
                match self { $(Output::$output => $formula,)+ }
            }

            /// The paper and the equation of [`Output::formula`]; empty where it is the definition.
            pub const fn source(self) -> &'static str {
                match self { $(Output::$output => $source,)+ }
            }

            /// What its entries are called in LaTeX.
            pub const fn symbol(self) -> &'static str {
                match self { $(Output::$output => $symbol,)+ }
            }

            /// What its rows stand for.
            pub const fn rows(self) -> Side {
                match self { $(Output::$output => Side::$rows,)+ }
            }

            /// The unit of each of the [parts](Side::parts) of its rows.
            pub const fn units(self) -> &'static [&'static str] {
                match self { $(Output::$output => &[$($unit),+],)+ }
            }

            /// What its columns stand for.
            pub const fn columns(self) -> Side {
                match self { $(Output::$output => Side::$columns,)+ }
            }

            /// What its function is given.
            pub const fn inputs(self) -> &'static [Input] {
                match self { $(Output::$output => &[$(Input::$input),*],)+ }
            }

            /// What of the arm's file enters besides the rows of its table.
            pub const fn parts(self) -> &'static [Part] {
                match self { $(Output::$output => &[$(Part::$part),*],)+ }
            }

            /// Whether a load can leave the output without a value: the arm may be unstable under it.
            pub const fn is_fallible(self) -> bool {
                match self { $(Output::$output => $fallible,)+ }
            }

            /// Whether the fused function `all` computes it, too.
            pub const fn is_fused(self) -> bool {
                match self { $(Output::$output => $fused,)+ }
            }
        }

        impl Output {
            /// Of an output that is generated on request the one in whose working frame it is worked out.
            pub(super) const fn on_request(self) -> Option<Output> {
                match self {
                    $($(Output::$output => Some(Output::$like),)?)+
                    _ => None,
                }
            }
        }

        /// A trait for each output, implemented by the arms whose modules were generated with it: what asks for an
        /// output that an arm does not have does not compile.
        pub mod has {
            use super::{has, value};
            use crate::{Arm, Scalar, Unstable};

            $(has!($sentence $output $name [$($input)*] [$rows $columns] $fallible);)+
        }
    };
}

outputs! {
    Pose {
        name: pose,
        sentence: "Pose of the tool in base axes.",
        formula: "T = A_1 A_2 … A_n T_tool",
        source: "",
        symbol: "T",
        rows: Axes ["m (axes: 1)"],
        columns: Frame,
        inputs: [Joints],
        parts: [Tool],
        fallible: false,
        fused: true,
    }
    Frames {
        name: frames,
        sentence: "Poses of frames 1 to n in base axes.",
        formula: "T_i = A_1 A_2 … A_i",
        source: "",
        symbol: "T",
        rows: Axes ["m (axes: 1)"],
        columns: Frames,
        inputs: [Joints],
        parts: [],
        fallible: false,
        fused: false,
    }
    Jacobian {
        name: jacobian,
        sentence: "Geometric Jacobian, base axes, at the tool origin.",
        formula: "J_j = [z_j × (p − p_j); z_j] of a revolute joint, [z_j; 0] of a prismatic one",
        source: "Dumas et al. 2011, eq. 1",
        symbol: "J",
        rows: Twist ["m/rad (prismatic joint: 1)", "rad/rad (prismatic joint: 0)"],
        columns: Joints,
        inputs: [Joints],
        parts: [Tool],
        fallible: false,
        fused: true,
    }
    JacobianTool {
        name: jacobian_tool,
        sentence: "Geometric Jacobian, tool axes, at the tool origin: Paul's differential Jacobian.",
        formula: "blockdiag(Rᵀ, Rᵀ) J with R the tool's rotation",
        source: "Lin et al. 1991, eqs. 37 to 41",
        symbol: "{}^{T}\\!J",
        rows: Twist ["m/rad (prismatic joint: 1)", "rad/rad (prismatic joint: 0)"],
        columns: Joints,
        inputs: [Joints],
        parts: [Tool],
        fallible: false,
        fused: false,
    }
    JacobianSpatial {
        name: jacobian_spatial,
        sentence: "Geometric Jacobian, base axes, at the base's origin (of the world, in which the base stands): the \
                   spatial Jacobian.",
        formula: "[p_j × z_j; z_j] of a revolute joint, [z_j; 0] of a prismatic one",
        source: "Murray, Li & Sastry 1994, eq. 3.54",
        symbol: "J^{s}",
        rows: Twist ["m/rad (prismatic joint: 1)", "rad/rad (prismatic joint: 0)"],
        columns: Joints,
        inputs: [Joints],
        parts: [],
        fallible: false,
        fused: false,
    }
    ComplementaryStiffness {
        name: complementary_stiffness,
        sentence: "K_C: how the joint torques of a wrench that is constant in base axes change with the \
                   posture.",
        formula: "(K_C)_ji = ∂(J_j)ᵀ/∂q_i · w; unsymmetric under a moment",
        source: "Dumas et al. 2011, eq. 9",
        symbol: "K_{C}",
        rows: Joints ["N·m/rad (prismatic joint: N, two of them: N/m)"],
        columns: Joints,
        inputs: [Joints, Wrench],
        parts: [Tool],
        fallible: false,
        fused: true,
    }
    JointTorque {
        name: joint_torque,
        sentence: "Joint torques of the wrench.",
        formula: "τ = Jᵀ w",
        source: "Dumas et al. 2011, eq. 3",
        symbol: "\\tau",
        rows: Joints ["N·m (prismatic joint: N)"],
        columns: One,
        inputs: [Joints, Wrench],
        parts: [Tool],
        fallible: false,
        fused: true,
    }
    WeightTorque {
        name: weight_torque,
        sentence: "Joint torques of the links' weights, positive like Jᵀ w: what the weights do to the \
                   joints, −g(q) of the equations of motion. The motors hold the opposite, g(q).",
        formula: "τ_g,j = Σ_k m_k g · (z_j × (c_k − p_j)) over the masses beyond joint j",
        source: "",
        symbol: "\\tau_{g}",
        rows: Joints ["N·m (prismatic joint: N)"],
        columns: One,
        inputs: [Joints],
        parts: [Weights],
        fallible: false,
        fused: false,
    }
    WeightStiffness {
        name: weight_stiffness,
        sentence: "K_G: how the torques of the links' weights change with the posture, the weights' part \
                   of K_C.",
        formula: "(K_G)_ji = ∂τ_g,j/∂q_i",
        source: "",
        symbol: "K_{G}",
        rows: Joints ["N·m/rad (prismatic joint: N, two of them: N/m)"],
        columns: Joints,
        inputs: [Joints],
        parts: [Weights],
        fallible: false,
        fused: false,
    }
    Compliance {
        name: compliance,
        sentence: "Compliance of the tool, base axes, at the tool origin; links as Euler-Bernoulli beams.",
        formula: "C = Σ_j J_j J_jᵀ/k_j + Σ links",
        source: "Knapczyk & Ryska, eq. 4",
        symbol: "C",
        rows: Twist ["m/N and m/(N·m)", "rad/N and rad/(N·m)"],
        columns: Wrench,
        inputs: [Joints],
        parts: [Tool, Stiffness, Beams],
        fallible: false,
        fused: true,
    }
    DeflectionFirstOrder {
        name: deflection_first_order,
        sentence: "Displacement of the tool under the wrench, base axes, at the tool origin, to first \
                   order in the load.",
        formula: "δd = J K_θ⁻¹ Jᵀ w + the links as beams",
        source: "Dumas et al. 2011, eqs. 17 and 19",
        symbol: "\\delta d",
        rows: Twist ["m", "rad"],
        columns: One,
        inputs: [Joints, Wrench],
        parts: [Tool, Stiffness, Beams],
        fallible: false,
        fused: false,
    }
    Deflection {
        name: deflection,
        sentence: "Displacement of the tool under the wrench, base axes, at the tool origin, with the \
                   stiffness of the loaded geometry.",
        formula: "δd = J (K_θ − K_C)⁻¹ Jᵀ w + the links as beams",
        source: "Dumas et al. 2011, eqs. 7 and 10",
        symbol: "\\delta d",
        rows: Twist ["m", "rad"],
        columns: One,
        inputs: [Joints, Wrench],
        parts: [Tool, Stiffness, Beams],
        fallible: true,
        fused: true,
    }
    DeflectionWithGravity {
        name: deflection_with_gravity,
        sentence: "Displacement of the tool under the wrench and the links' weights, base axes, at the \
                   tool origin.",
        formula: "δd = J (K_θ − K_C − K_G)⁻¹ (Jᵀ w + τ_g) + the links under tip load and own weight",
        source: "",
        symbol: "\\delta d",
        rows: Twist ["m", "rad"],
        columns: One,
        inputs: [Joints, Wrench],
        parts: [Tool, Stiffness, Beams, Weights],
        fallible: true,
        fused: false,
    }
    ParameterJacobian {
        name: parameter_jacobian,
        sentence: "Twist of the tool per unit of each entry of the table, base axes, at the tool origin.",
        formula: "J_p,k = ∂T/∂(entry k), as a twist",
        source: "",
        symbol: "J_{p}",
        rows: Twist ["m/rad (length: 1)", "rad/rad (length: 0)"],
        columns: Entries,
        inputs: [Joints],
        parts: [Tool],
        fallible: false,
        fused: false,
    }
    ComplianceRegressor {
        name: compliance_regressor,
        sentence: "Displacement of the tool per unit of each joint's compliance under the wrench, base \
                   axes, at the tool origin: the regressor of joint springs.",
        formula: "B_j = ∂δd/∂(1/k_j) = J_j J_jᵀ w",
        source: "Dumas et al. 2011, eqs. 20 and 21",
        symbol: "B",
        rows: Twist ["N·m²/rad (prismatic joint: N)", "N·m (prismatic joint: 0)"],
        columns: Joints,
        inputs: [Joints, Wrench],
        parts: [Tool],
        fallible: false,
        fused: false,
    }
    InverseDynamics {
        name: inverse_dynamics,
        sentence: "Torques of the joints' motors for a motion, at the joints.",
        formula: "τ = M(q) q̈ + b(q, q̇), b with the weights, with centrifugal and Coriolis forces and with \
                  friction; sign(0) = 0 of a joint at rest",
        source: "Luh, Walker & Paul 1980, eqs. 6 to 15",
        symbol: "\\tau",
        rows: Joints ["N·m (prismatic joint: N)"],
        columns: One,
        inputs: [Joints, Rates, Accelerations],
        parts: [Weights, Inertias],
        fallible: false,
        fused: false,
    }
    Bias {
        name: bias,
        sentence: "Torques of the joints' motors where no joint accelerates: weights, centrifugal and \
                   Coriolis forces, friction; at rest g(q), the opposite of the weight torque.",
        formula: "b(q, q̇) = τ(q, q̇, 0)",
        source: "Walker & Orin 1982",
        symbol: "b",
        rows: Joints ["N·m (prismatic joint: N)"],
        columns: One,
        inputs: [Joints, Rates],
        parts: [Weights, Inertias],
        fallible: false,
        fused: false,
    }
    MassMatrix {
        name: mass_matrix,
        sentence: "Mass matrix: torques of the joints' motors per unit of each joint's acceleration.",
        formula: "M_ji = ∂τ_j/∂q̈_i; twice the kinetic energy is q̇ᵀ M q̇",
        source: "Walker & Orin 1982",
        symbol: "M",
        rows: Joints ["kg·m² (prismatic joint: kg·m, two of them: kg)"],
        columns: Joints,
        inputs: [Joints],
        parts: [Inertias],
        fallible: false,
        fused: false,
    }
    Hessian {
        name: hessian,
        sentence: "Kinematic Hessian: how the geometric Jacobian, base axes, at the tool origin, changes by each joint.",
        formula: "H_i = ∂J/∂q_i",
        source: "Haviland & Corke 2023, part 2",
        symbol: "H",
        rows: Twist ["m/rad² (a prismatic joint: m/rad)", "rad/rad²"],
        columns: JointsByJoints,
        inputs: [Joints],
        parts: [Tool],
        fallible: false,
        fused: false,
        on_request: Hessian,
    }
    JacobianRate {
        name: jacobian_rate,
        sentence: "Rate of the geometric Jacobian, base axes, at the tool origin: the tool accelerates by J q̈ + J̇ q̇.",
        formula: "J̇ = Σ_i ∂J/∂q_i q̇_i",
        source: "",
        symbol: "\\dot{J}",
        rows: Twist ["m/(rad s) (prismatic joint: 1/s)", "1/s"],
        columns: Joints,
        inputs: [Joints, Rates],
        parts: [Tool],
        fallible: false,
        fused: false,
        on_request: JacobianRate,
    }
    ComplianceByJoints {
        name: compliance_by_joints,
        sentence: "How the compliance of the tool, base axes, at the tool origin, changes by each joint.",
        formula: "∂C/∂q_i",
        source: "",
        symbol: "\\partial C",
        rows: Twist ["m/N and m/(N·m), per rad (prismatic joint: m)", "rad/N and rad/(N·m), per rad (m)"],
        columns: WrenchByJoints,
        inputs: [Joints],
        parts: [Tool, Stiffness, Beams],
        fallible: false,
        fused: false,
        on_request: Compliance,
    }
    DeflectionByJoints {
        name: deflection_by_joints,
        sentence: "How the displacement of the tool under the wrench, base axes, at the tool origin, changes by each \
                   joint, with the stiffness of the loaded geometry.",
        formula: "∂δd/∂q_i, of J x with (K_θ − K_C) ∂x/∂q_i = ∂τ/∂q_i + ∂K_C/∂q_i x",
        source: "",
        symbol: "\\partial \\delta d",
        rows: Twist ["m/rad (prismatic joint: 1)", "rad/rad (prismatic joint: rad/m)"],
        columns: Joints,
        inputs: [Joints, Wrench],
        parts: [Tool, Stiffness, Beams],
        fallible: true,
        fused: false,
        on_request: Deflection,
    }
    Manipulability {
        name: manipulability,
        sentence: "Manipulability at the tool origin: the product of the Jacobian's singular values, zero where the tool \
                   cannot move in some direction.",
        formula: "w = √det(J Jᵀ); of fewer than six joints √det(Jᵀ J)",
        source: "Yoshikawa 1985",
        symbol: "w",
        rows: One ["m per rad for each singular value of a translation"],
        columns: One,
        inputs: [Joints],
        parts: [Tool],
        fallible: false,
        fused: false,
        on_request: Manipulability,
    }
    ManipulabilityByJoints {
        name: manipulability_by_joints,
        sentence: "Gradient of the manipulability by the joints; zero at a singular posture, where there is none.",
        formula: "∂w/∂q_i = w tr(J⁺ ∂J/∂q_i)",
        source: "Haviland & Corke 2023, part 2",
        symbol: "\\partial w",
        rows: Joints ["that of the manipulability, per rad (prismatic joint: m)"],
        columns: One,
        inputs: [Joints],
        parts: [Tool],
        fallible: false,
        fused: false,
        on_request: Manipulability,
    }
    InverseDynamicsByJoints {
        name: inverse_dynamics_by_joints,
        sentence: "How the torques of the joints' motors for a motion change by each joint value.",
        formula: "∂τ_j/∂q_i of τ(q, q̇, q̈)",
        source: "Singh, Russell & Wensing 2022",
        symbol: "\\partial \\tau",
        rows: Joints ["N·m/rad (prismatic joint: N, two of them: N/m)"],
        columns: Joints,
        inputs: [Joints, Rates, Accelerations],
        parts: [Weights, Inertias],
        fallible: false,
        fused: false,
        on_request: InverseDynamics,
    }
    InverseDynamicsByRates {
        name: inverse_dynamics_by_rates,
        sentence: "How the torques of the joints' motors for a motion change by each joint's rate, whatever the \
                   accelerations; dry friction's step at rest apart.",
        formula: "∂τ_j/∂q̇_i of τ(q, q̇, q̈); that by q̈_i is the mass matrix",
        source: "Singh, Russell & Wensing 2022",
        symbol: "\\partial \\tau",
        rows: Joints ["N·m·s/rad (prismatic joint: N·s, two of them: N·s/m)"],
        columns: Joints,
        inputs: [Joints, Rates],
        parts: [Inertias],
        fallible: false,
        fused: false,
        on_request: Bias,
    }
    ForwardDynamics {
        name: forward_dynamics,
        sentence: "Accelerations of the joints under their motors' torques.",
        formula: "q̈ = M(q)⁻¹ (τ − b(q, q̇)); none where a joint moves no mass and M is not positive definite",
        source: "Walker & Orin 1982",
        symbol: "\\ddot q",
        rows: Joints ["rad/s² (prismatic joint: m/s²)"],
        columns: One,
        inputs: [Joints, Rates, Torques],
        parts: [Weights, Inertias],
        fallible: true,
        fused: false,
    }
    TorqueRegressor {
        name: torque_regressor,
        sentence: "Torques of the joints' motors for a motion per unit of each link's moments of mass; rotors and \
                   friction apart.",
        formula: "Y_k = ∂τ/∂π_k and τ = Y π; π of a link: m, m c_x, m c_y, m c_z, and xx, xy, yy, xz, yz, zz of its \
                  tensor of inertia about the row's origin, all in the row's axes",
        source: "Atkeson, An & Hollerbach 1986, eq. 11",
        symbol: "Y",
        rows: Joints ["m/s² (first moments: m/s²·m, tensor: 1/s²; times m of a revolute joint)"],
        columns: Moments,
        inputs: [Joints, Rates, Accelerations],
        parts: [Weights],
        fallible: false,
        fused: false,
    }
}
