//! What leaving the complementary stiffness K_C out costs (Dumas et al., eqs. 14-15).

use nalgebra::Vector6;
use stiffarm_kernels::{Output, Unstable};

use super::{DexterityError, block, check_posture};
use crate::simulate::{rotation, translation};
use crate::whole::Whole;

/// The two indices of one posture under one wrench.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Influence {
    /// ν_p (eq. 14): the difference of the sizes of the two point displacements, as a part of the
    /// larger; 0 without a displacement.
    pub nu_p: f64,
    /// ν_r (eq. 15): the largest difference of the three small rotations, rad.
    pub nu_r: f64,
    /// The size of the difference of the two displacements as vectors, as a part of the larger:
    /// unlike ν_p it sees a displacement that only turns.
    pub vector: f64,
}

/// Compares the deflection with K_C and without, both about the unloaded posture `q` under the
/// wrench `w` (base axes, tool origin). K_X itself is not formed, so singular postures do no harm:
/// `K_X⁻¹ = J (Kθ − K_C)⁻¹ Jᵀ`.
///
/// # Errors
/// [`DexterityError::Posture`]; [`DexterityError::Unstable`] under a load that buckles the arm.
pub fn influence<'a>(
    whole: impl Into<Whole<'a>>,
    q: &[f64],
    w: &Vector6<f64>,
) -> Result<Influence, DexterityError> {
    let whole = whole.into();
    check_posture(whole.arm, q)?;
    let deflection = |output| -> Result<Vector6<f64>, Unstable> {
        Ok(block(whole, output, q, w)?.column(0).into_owned())
    };
    let with = deflection(Output::Deflection)?;
    let without = deflection(Output::DeflectionFirstOrder)?;
    let (p, p0) = (translation(&with), translation(&without));
    let larger = p.norm().max(p0.norm());
    let part = |difference: f64| if larger > 0.0 { difference / larger } else { 0.0 };
    Ok(Influence {
        nu_p: part((p.norm() - p0.norm()).abs()),
        nu_r: (rotation(&with) - rotation(&without)).amax(),
        vector: part((p - p0).norm()),
    })
}
