//! Joint corrections through the inverse differential Jacobian (step 9 of Lin, Chiang & Cui).

use nalgebra::{DMatrix, DVector, Vector6};
use stiffarm_kernels::generic::Arm;

use super::differential_jacobian;

/// Below this part of the largest a singular value of J'' counts as zero.
const SINGULAR: f64 = 1e-10;

/// What a displacement of the tool is in the joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Correction {
    /// dq, rad (length for prismatic joints).
    pub joints: DVector<f64>,
    /// What the joints leave of the displacement, tool axes: nothing for six joints away from
    /// singular postures.
    pub left: Vector6<f64>,
}

/// `dq = J''⁻¹ d`: the joint changes that displace the tool by `displacement`, which is in tool
/// axes at the tool origin. Least squares where there are fewer joints or J'' is singular, the
/// shortest change where there are more.
///
/// The paper's Add_1 to Add_6 are the corrections of the deflection, to be subtracted. What is left
/// after them is of second order; set-points that leave nothing, within the joints' limits, are found
/// by [`reach`](stiffarm_gap::compensate::reach::reach).
pub fn correction(arm: &Arm, q: &[f64], displacement: &Vector6<f64>) -> Correction {
    let jacobian = differential_jacobian(arm, q);
    let svd = DMatrix::from_fn(6, q.len(), |row, joint| jacobian[(row, joint)]).svd(true, true);
    let least = SINGULAR * svd.singular_values.iter().copied().fold(0.0, f64::max);
    let wanted = DVector::from_column_slice(displacement.as_slice());
    // Both sides of the decomposition were asked for.
    let joints = svd.solve(&wanted, least).unwrap_or_else(|_| DVector::zeros(q.len()));
    let left = displacement - &jacobian * &joints;
    Correction { joints, left }
}
