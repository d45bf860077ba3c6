//! The Cartesian stiffness of a loaded arm (Dumas et al., eqs. 8-10).

use nalgebra::{Matrix6, Vector6};
use stiffarm_gap::dexterity::DexterityError;
use stiffarm_kernels::generic::Arm;

/// Below this ratio of the singular values of J (m and rad) a posture counts as singular: the
/// inverse would hold no correct digit of the compliance's square.
const SINGULAR: f64 = 1e-10;

/// `K_X = J⁻ᵀ (Kθ − K_C) J⁻¹`, 6×6, base axes at the tool origin, N/m, N/rad, N·m/rad (Dumas et
/// al., eq. 10), under the wrench `w` that is constant in base axes. Under a moment K_C, and with
/// it K_X, is not symmetric. Links count as rigid.
///
/// # Errors
/// [`DexterityError::Singular`] where J has no inverse.
pub fn cartesian_stiffness(
    arm: &Arm,
    q: &[f64],
    w: &Vector6<f64>,
) -> Result<Matrix6<f64>, DexterityError> {
    let springs = Vector6::from_iterator(arm.joints.iter().map(|j| 1.0 / j.compliance));
    let jacobian: Matrix6<f64> = arm.jacobian(q).fixed_columns::<6>(0).into_owned();
    let values = jacobian.singular_values();
    let ratio = if values.max() > 0.0 { values.min() / values.max() } else { 0.0 };
    if ratio < SINGULAR || !ratio.is_finite() {
        return Err(DexterityError::Singular { ratio });
    }
    let k_c: Matrix6<f64> = arm.complementary_stiffness(q, w).fixed_view::<6, 6>(0, 0).into_owned();
    let stiffness = Matrix6::from_diagonal(&springs) - k_c;
    let inverse = jacobian.try_inverse().ok_or(DexterityError::Singular { ratio })?;
    Ok(inverse.transpose() * stiffness * inverse)
}
