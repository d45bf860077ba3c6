//! Any output by its name, laid out as generated kernels lay it out.

use std::vec::Vec;

use nalgebra::{Isometry3, Vector6};

use super::arm::Arm;
use crate::{Output, Unstable};

/// The columns x, y, z and origin of a frame, one after the other.
fn columns(frame: &Isometry3<f64>) -> Vec<f64> {
    let rotation = frame.rotation.to_rotation_matrix();
    rotation.matrix().iter().chain(frame.translation.vector.iter()).copied().collect()
}

impl Arm {
    /// `output` at the joint values `q` under the wrench `w` as one column-major block of
    /// [`Output::shape`].
    ///
    /// # Errors
    /// [`Unstable`] as from [`Arm::deflection`] and [`Arm::deflection_with_gravity`].
    pub fn evaluate(&self, output: Output, q: &[f64], w: &[f64; 6]) -> Result<Vec<f64>, Unstable> {
        let w = Vector6::from_column_slice(w);
        Ok(match output {
            Output::Pose => columns(&self.pose(q)),
            Output::Frames => self.frames(q)[1..].iter().flat_map(columns).collect(),
            Output::Jacobian => self.jacobian(q).as_slice().to_vec(),
            Output::JacobianTool => self.jacobian_tool(q).as_slice().to_vec(),
            Output::ComplementaryStiffness => {
                self.complementary_stiffness(q, &w).as_slice().to_vec()
            }
            Output::JointTorque => self.joint_torque(q, &w).as_slice().to_vec(),
            Output::GravityTorque => self.gravity_torque(q).as_slice().to_vec(),
            Output::GravityStiffness => self.gravity_stiffness(q).as_slice().to_vec(),
            Output::Compliance => self.compliance(q).as_slice().to_vec(),
            Output::DeflectionFirstOrder => self.deflection_first_order(q, &w).as_slice().to_vec(),
            Output::Deflection => self.deflection(q, &w)?.as_slice().to_vec(),
            Output::DeflectionWithGravity => {
                self.deflection_with_gravity(q, &w)?.as_slice().to_vec()
            }
            Output::ParameterJacobian => self.parameter_jacobian(q).as_slice().to_vec(),
            Output::StiffnessRegressor => self.stiffness_regressor(q, &w).as_slice().to_vec(),
        })
    }
}
