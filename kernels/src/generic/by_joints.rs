//! Derivatives by the joint values, by the rules of a turning body: of two joints the one nearer the base carries the
//! other's twist along.

use std::vec::Vec;

use nalgebra::{DMatrix, DVector, Matrix6, Matrix6xX, Vector3, Vector6};

use super::arm::{Arm, Convention};
use super::links::Link;
use super::spatial::{blocks, lower, stack, upper, wrench_transport};
use super::textbook::{Textbook, block};
use crate::{Motion, Output, Unstable};

/// Singular values below this part of the largest are those of a singular posture.
const SINGULAR: f64 = 1e-12;

/// The outputs of this file.
pub(super) const TEXTBOOK: &[(Output, Textbook)] = &[
    (Output::Hessian, |arm, q, _| Ok(arm.hessian(q).into_iter().flat_map(block).collect())),
    (Output::JacobianRate, |arm, state, _| {
        let (q, rates) = state.split_at(arm.dof());
        Ok(block(arm.jacobian_rate(q, rates)))
    }),
    (Output::ComplianceByJoints, |arm, q, _| {
        Ok(arm.compliance_by_joints(q).into_iter().flat_map(block).collect())
    }),
    (Output::DeflectionByJoints, |arm, q, w| arm.deflection_by_joints(q, w).map(block)),
    (Output::Manipulability, |arm, q, _| Ok(Vec::from([arm.manipulability(q)]))),
    (Output::ManipulabilityByJoints, |arm, q, _| Ok(block(arm.manipulability_by_joints(q)))),
];

/// The joints' twists at the tool, and how each changes by each joint.
struct Twists {
    velocity: Vec<Vector3<f64>>,
    spin: Vec<Vector3<f64>>,
}

impl Twists {
    /// ∂v_b/∂q_k.
    fn velocity_by(&self, k: usize, b: usize) -> Vector3<f64> {
        self.spin[k.min(b)].cross(&self.velocity[k.max(b)])
    }

    /// ∂ω_b/∂q_k.
    fn spin_by(&self, k: usize, b: usize) -> Vector3<f64> {
        if k < b { self.spin[k].cross(&self.spin[b]) } else { Vector3::zeros() }
    }
}

impl Arm {
    fn twists(&self, q: &[f64]) -> Twists {
        let (axes, p) = (self.axes(q), self.tool_origin(q));
        let velocity = axes.iter().map(|axis| axis.velocity(&p)).collect();
        Twists { velocity, spin: axes.iter().map(|axis| axis.spin()).collect() }
    }

    /// The kinematic Hessian, ∂J/∂q_i for each joint i, each 6×n (Haviland & Corke).
    pub fn hessian(&self, q: &[f64]) -> Vec<Matrix6xX<f64>> {
        let (n, twists) = (self.dof(), self.twists(q));
        let column = |i, j| stack(twists.velocity_by(i, j), twists.spin_by(i, j));
        let by = |i| Matrix6xX::from_columns(&(0..n).map(|j| column(i, j)).collect::<Vec<_>>());
        (0..n).map(by).collect()
    }

    /// J̇, 6×n, at these joint rates.
    pub fn jacobian_rate(&self, q: &[f64], rates: &[f64]) -> Matrix6xX<f64> {
        let parts = self.hessian(q).into_iter().zip(rates);
        parts.fold(Matrix6xX::zeros(self.dof()), |sum, (by, rate)| sum + by * *rate)
    }

    /// ∂C/∂q_i for each joint i, each 6×6: both factors of `J_j J_jᵀ/k_j`, and the links.
    pub fn compliance_by_joints(&self, q: &[f64]) -> Vec<Matrix6<f64>> {
        let jacobian = self.jacobian(q);
        let by_joint = |(i, by): (usize, Matrix6xX<f64>)| {
            let joints = self.joints.iter().enumerate().map(|(j, joint)| {
                let half = by.column(j) * jacobian.column(j).transpose() * joint.compliance;
                half + half.transpose()
            });
            joints.sum::<Matrix6<f64>>() + self.links_compliance_by(q, i)
        };
        self.hessian(q).into_iter().enumerate().map(by_joint).collect()
    }

    /// ∂δd/∂q_i, 6×n, of the deflection `J x` with `(Kθ − K_C) x = Jᵀ w` and of the links.
    ///
    /// # Errors
    /// [`Unstable`] as from [`Arm::deflection`].
    pub fn deflection_by_joints(
        &self,
        q: &[f64],
        w: &Vector6<f64>,
    ) -> Result<Matrix6xX<f64>, Unstable> {
        let (jacobian, k_c) = (self.jacobian(q), self.complementary_stiffness(q, w));
        let x = self.joints_deflection(&self.joint_torque(q, w), &k_c)?;
        let mut all = Matrix6xX::zeros(self.dof());
        for (i, by) in self.hessian(q).into_iter().enumerate() {
            // A rigid joint does not turn, whatever its torque.
            let right: DVector<f64> = by.tr_mul(w) + self.complementary_stiffness_by(q, w, i) * &x;
            let moved = self.joints_deflection(&right, &k_c)?;
            all.set_column(i, &(by * &x + &jacobian * moved + self.links_compliance_by(q, i) * w));
        }
        Ok(all)
    }

    /// ∂K_C/∂q_k, n×n.
    fn complementary_stiffness_by(&self, q: &[f64], w: &Vector6<f64>, k: usize) -> DMatrix<f64> {
        let (twists, f, m) = (self.twists(q), upper(w), lower(w));
        let spin = &twists.spin;
        DMatrix::from_fn(self.dof(), self.dof(), |j, i| {
            let (nearer, farther) = (i.min(j), i.max(j));
            let force = twists.spin_by(k, nearer).cross(&twists.velocity[farther])
                + spin[nearer].cross(&twists.velocity_by(k, farther));
            let moment =
                twists.spin_by(k, i).cross(&spin[j]) + spin[i].cross(&twists.spin_by(k, j));
            f.dot(&force) + if i < j { m.dot(&moment) } else { 0.0 }
        })
    }

    /// ∂/∂q_i of the links' flexibility at the tool, 6×6.
    fn links_compliance_by(&self, q: &[f64], i: usize) -> Matrix6<f64> {
        let tool = self.tool_origin(q);
        let (axes, twists) = (self.axes(q), self.twists(q));
        let of_link = |link: &Link<'_>| {
            let to_tip = wrench_transport(&tool, &link.tip);
            let row = link.row - 1;
            let revolute = self.joints[i].motion == Motion::Revolute;
            let carries =
                i < row || i == row && self.convention == Convention::Standard && revolute;
            if carries {
                // Beam and tool turn as one body.
                let turn = blocks(&twists.spin[i].cross_matrix());
                let whole = to_tip.transpose() * link.flexibility() * to_tip;
                turn * whole + whole * turn.transpose()
            } else if i == row && !revolute {
                to_tip.transpose() * link.stretched(&axes[i].direction) * to_tip
            } else {
                // The tool alone moves.
                let moved =
                    wrench_transport(&twists.velocity[i], &Vector3::zeros()) - Matrix6::identity();
                let half = moved.transpose() * link.flexibility() * to_tip;
                half + half.transpose()
            }
        };
        self.links(q).iter().map(of_link).sum()
    }

    /// Yoshikawa's manipulability: the product of the singular values of J.
    pub fn manipulability(&self, q: &[f64]) -> f64 {
        self.jacobian(q).svd(false, false).singular_values.product()
    }

    /// `w tr(J⁺ ∂J/∂q_i)`, n; zero at a singular posture. J⁺ is `R⁻¹ Qᵀ`, of more than six joints that of Jᵀ = Q R:
    /// singular vectors would do, but where two singular values are nearly equal they come out wrong by up to 1e-11.
    pub fn manipulability_by_joints(&self, q: &[f64]) -> DVector<f64> {
        let (n, jacobian) = (self.dof(), self.jacobian(q));
        let values = jacobian.clone().svd(false, false).singular_values;
        if values.min() <= SINGULAR * values.max() {
            return DVector::zeros(n);
        }
        let tall = |matrix: &Matrix6xX<f64>| match n > 6 {
            true => DMatrix::from_column_slice(6, n, matrix.as_slice()).transpose(),
            false => DMatrix::from_column_slice(6, n, matrix.as_slice()),
        };
        let (basis, triangle) = tall(&jacobian).qr().unpack();
        let slopes = self.hessian(q).into_iter().map(|by| {
            let solved = triangle.solve_upper_triangular(&basis.tr_mul(&tall(&by)));
            // No entry of the diagonal is zero where no singular value is.
            values.product() * solved.map_or(f64::NAN, |solved| solved.trace())
        });
        DVector::from_iterator(n, slopes)
    }
}
