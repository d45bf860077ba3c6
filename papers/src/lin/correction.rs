//! Joint corrections through the inverse differential Jacobian (step 9 of Lin, Chiang & Cui).

use nalgebra::{DMatrix, DVector, Vector6};
use stiffarm_kernels::generic::Arm;

use super::{CompensateError, differential_jacobian, finite};

/// How the differential Jacobian is inverted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Damping {
    /// The length that makes translations comparable to rotations: a translation by it counts as
    /// much as 1 rad. `None` is the arm's own size, the sum of its a, d and tool.
    pub length: Option<f64>,
    /// Where the smallest singular value is below this part of the largest, the posture counts as
    /// near a singular one and the inverse is damped: `σ/(σ² + λ²)`, `λ² = λ₀² (1 − (σ_min/λ₀)²)`
    /// with `λ₀ = threshold · σ_max`.
    pub threshold: f64,
}

impl Default for Damping {
    /// The arm's size, and one ten-thousandth.
    fn default() -> Self {
        Self { length: None, threshold: 1e-4 }
    }
}

/// What a displacement of the tool is in the joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Correction {
    /// dq, rad (length for prismatic joints).
    pub joints: DVector<f64>,
    /// The smallest singular value of the scaled Jacobian relative to the largest: 0 at singular
    /// postures. With fewer than six joints, of those directions that the joints have.
    pub conditioning: f64,
    /// Whether the inverse was damped.
    pub damped: bool,
    /// What the joints leave of the displacement, tool axes: nothing for six joints away from
    /// singular postures.
    pub left: Vector6<f64>,
}

/// `dq = J''⁻¹ d`: the joint changes that displace the tool by `displacement`, which is in tool
/// axes at the tool origin. Least squares where there are fewer joints or J'' is singular, the
/// shortest change where there are more.
///
/// The paper's Add_1 to Add_6 are the corrections of the deflection, to be subtracted.
///
/// # Errors
/// As [`steps`](crate::chain::steps); [`CompensateError::NotFinite`];
/// [`CompensateError::NotPositive`].
pub fn correction(
    arm: &Arm,
    q: &[f64],
    displacement: &Vector6<f64>,
    damping: Damping,
) -> Result<Correction, CompensateError> {
    finite("a component of the displacement", displacement)?;
    let jacobian = differential_jacobian(arm, q)?;
    let length = scale(arm, damping)?;
    let weight = |row: usize| if row < 3 { 1.0 / length } else { 1.0 };
    if q.is_empty() {
        let (joints, left) = (DVector::zeros(0), *displacement);
        return Ok(Correction { joints, conditioning: 0.0, damped: false, left });
    }
    let scaled = DMatrix::from_fn(6, q.len(), |row, joint| weight(row) * jacobian[(row, joint)]);
    finite("an element of the differential Jacobian", &scaled)?;
    let wanted = DVector::from_fn(6, |row, _| weight(row) * displacement[row]);
    let svd = scaled.svd(true, true);
    let sizes = &svd.singular_values;
    let (largest, smallest) = (sizes.max(), sizes.min());
    let conditioning = if largest > 0.0 { smallest / largest } else { 0.0 };
    let damped = conditioning < damping.threshold;
    let limit = damping.threshold * largest;
    let square = if damped { limit * limit - smallest * smallest } else { 0.0 };
    let inverse = |size: f64| if size > 0.0 { size / (size * size + square) } else { 0.0 };
    let joints = match (&svd.u, &svd.v_t) {
        (Some(u), Some(v)) => {
            v.tr_mul(&u.tr_mul(&wanted).zip_map(sizes, |along, size| along * inverse(size)))
        }
        _ => DVector::zeros(q.len()),
    };
    let left = displacement - &jacobian * &joints;
    Ok(Correction { joints, conditioning, damped, left })
}

/// The length that makes translations comparable to rotations.
pub(super) fn scale(arm: &Arm, damping: Damping) -> Result<f64, CompensateError> {
    let positive = |what, found: f64| {
        let fine = found > 0.0 && found.is_finite();
        if fine { Ok(found) } else { Err(CompensateError::NotPositive { what, found }) }
    };
    positive("the threshold of damping", damping.threshold)?;
    if let Some(length) = damping.length {
        return positive("the length that weights translations", length);
    }
    let lengths: f64 = arm.joints.iter().map(|joint| joint.a.abs() + joint.d.abs()).sum();
    let size = lengths + arm.tool.translation.vector.norm();
    Ok(if size > 0.0 { size } else { 1.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::rigid;

    #[test]
    fn what_the_joints_can_do_is_done_and_the_rest_is_told() {
        let (arm, q) = (rigid(), [0.4, -0.9, 1.3]);
        let change = DVector::from_vec(vec![1e-3, -2e-3, 5e-4]);
        let displacement = arm.jacobian_tool(&q) * &change;
        let found = correction(&arm, &q, &displacement, Damping::default()).unwrap();
        assert!((found.joints - change).amax() < 1e-16 && !found.damped);
        assert!(found.left.amax() < 1e-16);
        let out = Vector6::new(0.0, 0.0, 0.0, 1.0, 0.0, 0.0);
        assert!(correction(&arm, &q, &out, Damping::default()).unwrap().left.norm() > 0.1);
    }

    /// Stretched out, no joint moves the tool along the arm.
    #[test]
    fn near_a_singular_posture_the_corrections_stay_bounded() {
        let mut arm = rigid();
        for joint in &mut arm.joints {
            (joint.alpha, joint.d) = (0.0, 0.0);
        }
        arm.tool = nalgebra::Isometry3::identity();
        let along = Vector6::new(1e-3, 0.0, 0.0, 0.0, 0.0, 0.0);
        let damping = Damping { length: None, threshold: 1e-2 };
        let near =
            correction(&arm, &[0.2, 1e-3, 1e-3], &along, Damping { threshold: 1e-9, ..damping });
        let damped = correction(&arm, &[0.2, 1e-3, 1e-3], &along, damping).unwrap();
        assert!(!near.as_ref().unwrap().damped && damped.damped);
        assert!(damped.joints.norm() < near.unwrap().joints.norm());
        let wrong = Damping { length: Some(-1.0), threshold: 1e-2 };
        let text = correction(&arm, &[0.2, 0.0, 0.0], &along, wrong).unwrap_err().to_string();
        assert_eq!(
            text,
            "found -1 as the length that weights translations, expected a positive number"
        );
    }
}
