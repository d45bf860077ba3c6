//! Compliance and deflection of the whole arm (Dumas et al., eqs. 4-17; links after Lin et al.).

use std::vec::Vec;

use nalgebra::{DMatrix, DVector, Matrix6, Vector6};

use super::arm::Arm;
use super::textbook::{Textbook, block};
use crate::{Output, Unstable};

/// The outputs of this file.
pub(super) const TEXTBOOK: &[(Output, Textbook)] = &[
    (Output::Compliance, |arm, q, _| Ok(block(arm.compliance(q)))),
    (Output::DeflectionFirstOrder, |arm, q, w| Ok(block(arm.deflection_first_order(q, w)))),
    (Output::Deflection, |arm, q, w| arm.deflection(q, w).map(block)),
    (Output::DeflectionWithGravity, |arm, q, w| arm.deflection_with_gravity(q, w).map(block)),
];

impl Arm {
    /// Compliance of the tool, 6×6, base axes, at the tool origin: `Σ J_j J_jᵀ/k_j` (Dumas et al.,
    /// eq. 17) plus the links as beams; m/N, rad/N = m/(N·m), rad/(N·m).
    pub fn compliance(&self, q: &[f64]) -> Matrix6<f64> {
        let jacobian = self.jacobian(q);
        let joints = jacobian.column_iter().zip(&self.joints);
        joints
            .map(|(column, joint)| column * column.transpose() * joint.compliance)
            .sum::<Matrix6<f64>>()
            + self.links_compliance(q)
    }

    /// Deflection of the tool to first order in the load, m and rad: `J Kθ⁻¹ Jᵀ w` joint by joint
    /// (Dumas et al., eqs. 17 and 19) plus the links one by one.
    pub fn deflection_first_order(&self, q: &[f64], w: &Vector6<f64>) -> Vector6<f64> {
        let jacobian = self.jacobian(q);
        let joints = jacobian.column_iter().zip(&self.joints);
        joints
            .map(|(column, joint)| column * (joint.compliance * column.dot(w)))
            .sum::<Vector6<f64>>()
            + self.links_deflection(q, w)
    }

    /// Deflection of the tool, m and rad, with the loaded geometry's stiffness:
    /// `J (Kθ − K_C)⁻¹ Jᵀ w` (Dumas et al., eqs. 7 and 10, without inverting J) plus the links.
    /// Rigid joints do not move.
    ///
    /// # Errors
    /// [`Unstable`] if the symmetric part of `Kθ − K_C` is not positive definite.
    pub fn deflection(&self, q: &[f64], w: &Vector6<f64>) -> Result<Vector6<f64>, Unstable> {
        let torque = self.joint_torque(q, w);
        let joints = self.joints_deflection(&torque, &self.complementary_stiffness(q, w))?;
        Ok(self.jacobian(q) * joints + self.links_deflection(q, w))
    }

    /// Deflection of the tool, m and rad, under the wrench and all weights: `J (Kθ − K_C − K_G)⁻¹
    /// (Jᵀ w + τ_g)` plus the links under the wrench, under their own weights and under what hangs
    /// beyond them. `τ_g` is [`Arm::weight_torque`], `K_G` [`Arm::weight_stiffness`].
    ///
    /// # Errors
    /// [`Unstable`] if the symmetric part of `Kθ − K_C − K_G` is not positive definite.
    pub fn deflection_with_gravity(
        &self,
        q: &[f64],
        w: &Vector6<f64>,
    ) -> Result<Vector6<f64>, Unstable> {
        let torque = self.joint_torque(q, w) + self.weight_torque(q);
        let load_stiffness = self.complementary_stiffness(q, w) + self.weight_stiffness(q);
        let joints = self.joints_deflection(&torque, &load_stiffness)?;
        Ok(self.jacobian(q) * joints + self.links_deflection(q, w) + self.links_sag(q))
    }

    /// `δθ` of all joints under `torque` where the arm is stable (as in [`crate::solve`]): `(Kθ − K) δθ = τ` over the compliant joints, 0 for the
    /// rigid ones (Dumas et al., eqs. 4-8).
    pub(super) fn joints_deflection(
        &self,
        torque: &DVector<f64>,
        load_stiffness: &DMatrix<f64>,
    ) -> Result<DVector<f64>, Unstable> {
        let compliant: Vec<usize> =
            (0..self.dof()).filter(|&j| self.joints[j].compliance != 0.0).collect();
        let mut all = DVector::zeros(self.dof());
        if compliant.is_empty() {
            return Ok(all);
        }
        let spring = |&j: &usize| 1.0 / self.joints[j].compliance;
        let springs = DVector::from_iterator(compliant.len(), compliant.iter().map(spring));
        let stiffness = DMatrix::from_diagonal(&springs)
            - load_stiffness.select_rows(&compliant).select_columns(&compliant);
        let symmetric_part = (&stiffness + stiffness.transpose()) / 2.0;
        symmetric_part.cholesky().ok_or(Unstable)?;
        let moved = stiffness.lu().solve(&torque.select_rows(&compliant)).ok_or(Unstable)?;
        for (&j, &angle) in compliant.iter().zip(moved.iter()) {
            all[j] = angle;
        }
        Ok(all)
    }
}
