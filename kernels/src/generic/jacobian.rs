//! The geometric Jacobian (Dumas et al., eq. 1; Lin et al., eqs. 37-41).

use nalgebra::{DVector, Matrix6xX, Vector3, Vector6};

use super::arm::Arm;
use super::spatial::{lower, stack, upper};
use super::textbook::{Textbook, block};
use crate::Output;

/// The outputs of this file.
pub(super) const TEXTBOOK: &[(Output, Textbook)] = &[
    (Output::Jacobian, |arm, q, _| Ok(block(arm.jacobian(q)))),
    (Output::JacobianTool, |arm, q, _| Ok(block(arm.jacobian_tool(q)))),
    (Output::JacobianSpatial, |arm, q, _| Ok(block(arm.jacobian_spatial(q)))),
    (Output::JointTorque, |arm, q, w| Ok(block(arm.joint_torque(q, w)))),
    (Output::ComplianceRegressor, |arm, q, w| Ok(block(arm.compliance_regressor(q, w)))),
];

impl Arm {
    /// Geometric Jacobian, 6×n: the twist of the tool at the tool origin in base axes per unit of
    /// each joint's rate, translation rows first (Dumas et al., eqs. 1 and 31).
    ///
    /// Column i is `[z_i × (p − p_i); z_i]` for a revolute joint and `[z_i; 0]` for a prismatic
    /// one.
    pub fn jacobian(&self, q: &[f64]) -> Matrix6xX<f64> {
        self.jacobian_at(q, &self.tool_origin(q))
    }

    /// The twists of the last body at the world's origin, world axes, 6×n: the spatial Jacobian (Murray, Li & Sastry
    /// 1994, eq. 3.54).
    pub fn jacobian_spatial(&self, q: &[f64]) -> Matrix6xX<f64> {
        self.jacobian_at(q, &Vector3::zeros())
    }

    /// The twists of the last body at its point `p`, base axes, 6×n.
    fn jacobian_at(&self, q: &[f64], p: &Vector3<f64>) -> Matrix6xX<f64> {
        let mut jacobian = Matrix6xX::zeros(self.dof());
        for (i, axis) in self.axes(q).iter().enumerate() {
            jacobian.set_column(i, &stack(axis.velocity(p), axis.spin()));
        }
        jacobian
    }

    /// The same twists in tool axes, 6×n: Paul's differential Jacobian (Lin et al., eqs. 37-41,
    /// where the last component of eq. 38 must read `−a_x p_y + a_y p_x`).
    pub fn jacobian_tool(&self, q: &[f64]) -> Matrix6xX<f64> {
        let to_tool = self.pose(q).rotation.inverse();
        let mut jacobian = self.jacobian(q);
        for mut column in jacobian.column_iter_mut() {
            let twist: Vector6<f64> = column.clone_owned();
            column.copy_from(&stack(to_tool * upper(&twist), to_tool * lower(&twist)));
        }
        jacobian
    }

    /// `Jᵀ w`, n: torques (N·m; forces, N, of prismatic joints) by which the wrench `w` at the tool
    /// loads the joints (Dumas et al., eq. 3).
    pub fn joint_torque(&self, q: &[f64], w: &Vector6<f64>) -> DVector<f64> {
        self.jacobian(q).tr_mul(w)
    }

    /// Column j is `J_j (J_jᵀ w)`, 6×n: the deflection per unit of the compliance of joint j (Dumas
    /// et al., eqs. 20-21, the regressor of their identification): m, rad per rad/(N·m), or per m/N of a prismatic joint.
    pub fn compliance_regressor(&self, q: &[f64], w: &Vector6<f64>) -> Matrix6xX<f64> {
        let mut regressor = self.jacobian(q);
        for mut column in regressor.column_iter_mut() {
            let torque = column.dot(w);
            column *= torque;
        }
        regressor
    }
}
