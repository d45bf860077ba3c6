//! The condition number of the Jacobian by the Frobenius norm, with a length that makes its rows
//! comparable (Dumas et al., eqs. 11-12).

use nalgebra::{DMatrix, Matrix3, Matrix6, Matrix6xX, Vector6};
use stiffarm_kernels::Output;
use stiffarm_kernels::generic::Arm;

use super::{DexterityError, block, check_posture};
use crate::whole::Whole;

/// `J_N = diag(I/L, I) J`, 6×n, without units: translations in units of `length`, m (Dumas et al.,
/// eq. 12).
///
/// # Errors
/// [`DexterityError::Posture`], [`DexterityError::Length`].
pub fn normalised_jacobian<'a>(
    whole: impl Into<Whole<'a>>,
    q: &[f64],
    length: f64,
) -> Result<Matrix6xX<f64>, DexterityError> {
    let whole = whole.into();
    check_posture(whole.arm, q)?;
    if !(length.is_finite() && length > 0.0) {
        return Err(DexterityError::Length { found: length });
    }
    let mut jacobian = block(whole, Output::Jacobian, q, &Vector6::zeros())?;
    let mut translations = jacobian.fixed_rows_mut::<3>(0);
    translations /= length;
    Ok(jacobian)
}

/// `κ_F(M) = (1/m) √(tr(M Mᵀ) tr((M Mᵀ)⁻¹))` of an m×n matrix, from 1 (isotropic) to infinity
/// (singular). Dumas et al. print `Mᵀ M` in eq. 11, which is singular wherever m < n; here it is
/// the smaller of the two products, and m the smaller dimension.
pub fn condition_number(m: &DMatrix<f64>) -> f64 {
    let smaller = m.nrows().min(m.ncols());
    if smaller == 0 {
        return f64::INFINITY;
    }
    let product = if m.nrows() <= m.ncols() { m * m.transpose() } else { m.tr_mul(m) };
    let Some(inverse) = product.clone().try_inverse() else { return f64::INFINITY };
    let square = product.trace() * inverse.trace();
    // Where the product is singular to rounding, its computed inverse may have any trace.
    if square.is_finite() && square > 0.0 { square.sqrt() / smaller as f64 } else { f64::INFINITY }
}

/// `1/κ_F(J_N)`, from 0 (singular) to 1 (isotropic): the dexterity of Dumas et al., Fig. 3.
///
/// # Errors
/// As [`normalised_jacobian`].
pub fn inverse_condition<'a>(
    whole: impl Into<Whole<'a>>,
    q: &[f64],
    length: f64,
) -> Result<f64, DexterityError> {
    let normalised = normalised_jacobian(whole, q, length)?;
    let normalised = DMatrix::from_fn(6, q.len(), |r, c| normalised[(r, c)]);
    Ok(1.0 / condition_number(&normalised))
}

/// The length that suits one posture best.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Best {
    /// m.
    pub length: f64,
    /// `1/κ_F(J_N)` with it.
    pub inverse_condition: f64,
}

/// The length with which a posture is conditioned best, in closed form.
///
/// With `a = tr J_v J_vᵀ`, `b = tr J_ω J_ωᵀ` and c, d the traces of the translation and rotation
/// blocks of `(J Jᵀ)⁻¹`, `36 κ² = (a/L² + b)(c L² + d)`, least where `L⁴ = a d/(b c)`; there
/// `6 κ = √(a c) + √(b d)`.
///
/// # Errors
/// [`DexterityError::TooFewJoints`] below six joints, [`DexterityError::Singular`].
pub fn best_length(arm: &Arm, q: &[f64]) -> Result<Best, DexterityError> {
    check_posture(arm, q)?;
    if arm.dof() < 6 {
        return Err(DexterityError::TooFewJoints { found: arm.dof() });
    }
    let jacobian = arm.jacobian(q);
    let square: Matrix6<f64> = &jacobian * jacobian.transpose();
    let inverse = square.try_inverse().ok_or(DexterityError::Singular { ratio: 0.0 })?;
    let traces = |m: &Matrix6<f64>| {
        let block = |at: usize| -> Matrix3<f64> { m.fixed_view::<3, 3>(at, at).into_owned() };
        (block(0).trace(), block(3).trace())
    };
    let ((a, b), (c, d)) = (traces(&square), traces(&inverse));
    let best = Best {
        length: (a * d / (b * c)).sqrt().sqrt(),
        inverse_condition: 6.0 / ((a * c).sqrt() + (b * d).sqrt()),
    };
    if best.length.is_finite() && best.length > 0.0 && best.inverse_condition.is_finite() {
        Ok(best)
    } else {
        Err(DexterityError::Singular { ratio: 0.0 })
    }
}
