//! The arms.

use stiffarm::robot;

robot! {
    /// Universal Robots UR10, rigid.
    pub mod ur10 from "../../../robots/arms/ur10.toml";
}
robot! {
    /// KUKA KR 240-2 (Dumas et al. 2011), a spring in every joint.
    pub mod kuka_kr240 from "../../../robots/arms/kuka_kr240.toml";
}
robot! {
    /// KUKA LBR iiwa 14: seven joints.
    pub mod iiwa14 from "../../../robots/arms/iiwa14.toml";
}
robot! {
    /// UR5 with springs: what the figures are of.
    pub mod ur5_springs from "ur5_springs.toml";
}
robot! {
    /// The same with no more than these outputs, in whose posture nothing else is.
    pub mod ur5_lean from "ur5_springs.toml";
    outputs: pose, jacobian, compliance;
}
robot! {
    /// The UR10, pose and Jacobian.
    pub mod ur10_lean from "../../../robots/arms/ur10.toml";
    outputs: pose, jacobian;
}
robot! {
    /// The UR10, every branch of its inverse kinematics.
    pub mod ur10_inverse from "../../../robots/arms/ur10.toml";
    outputs: inverse_kinematics;
}
robot! {
    /// The KR 240-2, likewise.
    pub mod kuka_kr240_inverse from "../../../robots/arms/kuka_kr240.toml";
    outputs: inverse_kinematics;
}
robot! {
    /// The KR 240-2, pose and Jacobian.
    pub mod kuka_kr240_lean from "../../../robots/arms/kuka_kr240.toml";
    outputs: pose, jacobian;
}
robot! {
    /// The UR10 as a loop of torques needs it.
    pub mod ur10_moving from "../../../robots/arms/ur10.toml";
    outputs: inverse_dynamics, bias, mass_matrix, forward_dynamics, torque_regressor, weight_torque,
             inverse_dynamics_by_joints, inverse_dynamics_by_rates;
}
robot! {
    /// Franka Emika Panda: seven joints, ten full numbers for every link.
    pub mod panda from "../../../robots/arms/panda.toml";
    outputs: inverse_dynamics, bias, mass_matrix, forward_dynamics, torque_regressor,
             inverse_dynamics_by_joints, inverse_dynamics_by_rates;
}
robot! {
    /// Something of everything: a joint that slides, beams, weights, oblique twists, a turned tool.
    pub mod various from "../../c/arm.toml";
}
