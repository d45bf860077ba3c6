//! The complementary stiffness: how the joints' load changes as the arm moves under it
//! (Dumas et al., eqs. 6 and 9).

use nalgebra::{DMatrix, Vector3, Vector6};

use super::arm::Arm;
use super::kinematics::Axis;
use super::spatial::{lower, upper};
use super::textbook::{Textbook, block};
use crate::{Motion, Output};

/// `∂(v_j · f)/∂q_i` at row j, column i, for a constant force `f` on a point that all of `axes`
/// move with velocities `v_j`. Symmetric, since it holds the second derivatives of `f · p`.
///
/// Of two joints, the one nearer the base carries the other's velocity vector along: `v_b` rotates
/// with a revolute joint a ≤ b at the rate `z_a × v_b`, and does not change with a prismatic one.
pub(super) fn force_stiffness(
    axes: &[Axis],
    point: &Vector3<f64>,
    f: &Vector3<f64>,
) -> DMatrix<f64> {
    DMatrix::from_fn(axes.len(), axes.len(), |j, i| {
        let (nearer, farther) = (&axes[i.min(j)], &axes[i.max(j)]);
        f.dot(&nearer.spin().cross(&farther.velocity(point)))
    })
}

/// `∂(ω_j · m)/∂q_i` at row j, column i, for a constant moment `m`: joint i turns the axis of joint
/// j if both are revolute and i is nearer the base, so the matrix is strictly lower triangular.
fn moment_stiffness(axes: &[Axis], m: &Vector3<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(axes.len(), axes.len(), |j, i| {
        let both_turn = [i, j].iter().all(|&k| axes[k].motion == Motion::Revolute);
        if i < j && both_turn { m.dot(&axes[i].direction.cross(&axes[j].direction)) } else { 0.0 }
    })
}

/// The outputs of this file.
pub(super) const TEXTBOOK: &[(Output, Textbook)] =
    &[(Output::ComplementaryStiffness, |arm, q, w| Ok(block(arm.complementary_stiffness(q, w))))];

impl Arm {
    /// K_C, n×n, N·m/rad (N, N/m in the rows and columns of prismatic joints): row j, column i is
    /// `∂(column j of J)ᵀ/∂q_i · w` for a wrench constant in base axes (Dumas et al., eq. 9).
    ///
    /// A force gives a symmetric part, a moment a strictly lower triangular one; so `K_C − K_Cᵀ` is
    /// `m · (z_i × z_j)` below the diagonal, and `Kθ − K_C` is not symmetric under a moment.
    pub fn complementary_stiffness(&self, q: &[f64], w: &Vector6<f64>) -> DMatrix<f64> {
        let axes = self.axes(q);
        force_stiffness(&axes, &self.tool_origin(q), &upper(w)) + moment_stiffness(&axes, &lower(w))
    }
}
