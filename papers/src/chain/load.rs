//! What acts on the tool.

use nalgebra::Vector6;

/// A wrench on the tool, N and N·m, about the tool's displaced origin; what the environment puts
/// on the robot (the negative of what the robot exerts).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Load {
    /// Constant in the tool's axes, as a wrist sensor gives it: it turns with the displaced tool.
    Follower(Vector6<f64>),
    /// Constant in the base's axes, such as a hanging weight.
    Dead(Vector6<f64>),
}

impl Load {
    /// The six numbers, in the axes of the load's own kind.
    pub fn wrench(&self) -> &Vector6<f64> {
        match self {
            Load::Follower(wrench) | Load::Dead(wrench) => wrench,
        }
    }
}
