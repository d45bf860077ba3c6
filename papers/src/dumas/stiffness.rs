//! The Cartesian stiffness of a loaded arm (Dumas et al., eqs. 8-10).

use nalgebra::{Matrix6, Vector6};
use stiffarm_gap::dexterity::{DexterityError, check_posture};
use stiffarm_kernels::generic::Arm;

/// Below this ratio of the singular values of J (m and rad) a posture counts as singular: the
/// inverse would hold no correct digit of the compliance's square.
const SINGULAR: f64 = 1e-10;

/// Why no stiffness describes a posture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoStiffness {
    /// Joint values that do not fit the arm, or a posture without an inverse of J.
    #[error(transparent)]
    Posture(#[from] DexterityError),
    /// K_X needs a square Jacobian.
    #[error("found {found} joints, expected 6: with any other number J has no inverse")]
    NotSquare {
        /// Of the arm.
        found: usize,
    },
    /// A joint without a spring.
    #[error("joint {joint} is rigid: give it a stiffness")]
    Rigid {
        /// From 1.
        joint: usize,
    },
}

/// `K_X = J⁻ᵀ (Kθ − K_C) J⁻¹`, 6×6, base axes at the tool origin, N/m, N/rad, N·m/rad (Dumas et
/// al., eq. 10), under the wrench `w` that is constant in base axes. Under a moment K_C, and with
/// it K_X, is not symmetric. Links count as rigid.
///
/// # Errors
/// [`DexterityError::Singular`] where J has no inverse; [`NoStiffness::NotSquare`] if the arm
/// has not six joints; [`NoStiffness::Rigid`] names the first joint without a spring.
pub fn cartesian_stiffness(
    arm: &Arm,
    q: &[f64],
    w: &Vector6<f64>,
) -> Result<Matrix6<f64>, NoStiffness> {
    check_posture(arm, q)?;
    if arm.dof() != 6 {
        return Err(NoStiffness::NotSquare { found: arm.dof() });
    }
    if let Some(rigid) = arm.joints.iter().position(|j| j.compliance == 0.0) {
        return Err(NoStiffness::Rigid { joint: rigid + 1 });
    }
    let springs = Vector6::from_iterator(arm.joints.iter().map(|j| 1.0 / j.compliance));
    let jacobian: Matrix6<f64> = arm.jacobian(q).fixed_columns::<6>(0).into_owned();
    let values = jacobian.singular_values();
    let ratio = if values.max() > 0.0 { values.min() / values.max() } else { 0.0 };
    if ratio < SINGULAR || !ratio.is_finite() {
        return Err(DexterityError::Singular { ratio }.into());
    }
    let k_c: Matrix6<f64> = arm.complementary_stiffness(q, w).fixed_view::<6, 6>(0, 0).into_owned();
    let stiffness = Matrix6::from_diagonal(&springs) - k_c;
    let inverse = jacobian.try_inverse().ok_or(DexterityError::Singular { ratio })?;
    Ok(inverse.transpose() * stiffness * inverse)
}
