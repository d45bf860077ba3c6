//! How stiff one direction looks: 1/c of the compliance matrix against the element of its inverse
//! (Knapczyk & Ryska, *Stiffness matrix analysis of six-revolute serial manipulator*, eqs. 4-8 and
//! A.1-A.3).

use nalgebra::{DVector, Matrix3, Matrix6, Matrix6xX, Vector6};
use stiffarm_kernels::generic::Arm;

/// Below this reciprocal condition a block of the compliance has no inverse.
const SINGULAR: f64 = 1e-12;

/// The diagonal of the compliance and what may be called stiffness along one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Apparent {
    /// What each joint adds to each diagonal element of C, 6×n: `J_ij²/k_j` (A.1-A.3: `c_ii` is the
    /// sum of row i; the prefactor printed `1/κ_j` must read `1/k_j`, that is `κ_j`).
    pub by_joint: Matrix6xX<f64>,
    /// Diagonal of C, links included: m/N three times, rad/(N·m) three times.
    pub compliance: Vector6<f64>,
    /// `1/c_ii`: force along the axis over the motion along it, everything free to give way. This
    /// is what a single pull with a dial gauge beside it measures. Infinite where nothing gives.
    pub free: Vector6<f64>,
    /// Diagonal of the inverse of the translations' 3×3 block of C, N/m: the other two translations
    /// held, rotations free. None if the block has no inverse.
    pub translations_held: Option<DVector<f64>>,
    /// Diagonal of `K = C⁻¹` (eq. 4 with K_C = 0), all five other motions held. None if C has no
    /// inverse, as with rigid joints or in a singular posture.
    pub all_held: Option<Vector6<f64>>,
}

/// Compliance and stiffness along each axis of the base at the tool origin, unloaded. Always
/// `free ≤ translations_held ≤ all_held`: holding can only stiffen, so 1/c₃₃ is not the element
/// k₃₃ of the stiffness matrix.
pub fn apparent(arm: &Arm, q: &[f64]) -> Apparent {
    let mut by_joint = arm.jacobian(q);
    for (mut column, joint) in by_joint.column_iter_mut().zip(&arm.joints) {
        column.apply(|element| *element = *element * *element * joint.compliance);
    }
    let matrix = arm.compliance(q);
    let compliance: Vector6<f64> = matrix.diagonal();
    let block: Matrix3<f64> = matrix.fixed_view::<3, 3>(0, 0).into_owned();
    let regular = |values: &[f64]| {
        let most = values.iter().fold(0.0, |m: f64, v| m.max(*v));
        values.iter().all(|v| *v > SINGULAR * most)
    };
    let held = regular(block.singular_values().as_slice()).then(|| block.try_inverse()).flatten();
    let all: Option<Matrix6<f64>> =
        regular(matrix.singular_values().as_slice()).then(|| matrix.try_inverse()).flatten();
    Apparent {
        by_joint,
        compliance,
        free: compliance.map(|c| 1.0 / c),
        translations_held: held.map(|k| DVector::from_column_slice(k.diagonal().as_slice())),
        all_held: all.map(|k| k.diagonal()),
    }
}
