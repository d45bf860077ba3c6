//! The discrete gradient law, eqs. 9, 14 and 15, corrected; eq. 12 is judged in the ledger.
//!
//! `e = w_d − w` is the wrench error in base axes (eq. 8), `V = eᵀ P e/2` (eq. 9), G = ∂w/∂q, T the
//! sampling period in seconds. Eq. 14 must have the S that eq. 15 has:
//!
//! ```text
//! (14)  q̇_n = λ_n S_n G_nᵀ P e_n
//! (15)  λ_n = (1/T) eᵀP G S Gᵀ P e / (eᵀP G S Gᵀ P G S Gᵀ P e)
//! ```
//!
//! With this λ_n a step `T q̇_n` goes to the minimum of V along its line, as far as V is quadratic.
//!
//! P is given by its diagonal. P = 1, as in the paper ("with proper dimensional units"), weights a
//! newton metre like a newton; `1/l²` for moments counts a moment error like the force error that
//! makes it over the length l. In newton millimetres the moments would outweigh everything.

use nalgebra::{DVector, Matrix6xX, Vector6};

/// `V = eᵀ P e/2` (eq. 9), N² where P makes moments forces.
pub fn value(p: &Vector6<f64>, e: &Vector6<f64>) -> f64 {
    e.dot(&e.component_mul(p)) / 2.0
}

/// `Gᵀ P e`: steepest descent of V in the joint values.
pub fn descent(g: &Matrix6xX<f64>, p: &Vector6<f64>, e: &Vector6<f64>) -> DVector<f64> {
    g.tr_mul(&e.component_mul(p))
}

/// One step of the discrete law, `T q̇_n` by eqs. 14 and 15, rad; it does not depend on T. S brings
/// every element of the descent down to `limit`, if there is one. `None` where there is no descent.
pub fn step(
    g: &Matrix6xX<f64>,
    p: &Vector6<f64>,
    e: &Vector6<f64>,
    limit: Option<f64>,
) -> Option<DVector<f64>> {
    let descent = descent(g, p, e);
    let limit = limit.unwrap_or(f64::INFINITY);
    let limited = |e: f64| if e.abs() > limit { limit * e.signum() } else { e };
    let direction = descent.map(limited);
    let change = g * &direction;
    let gain =
        descent.dot(&direction) / (2.0 * value(p, &Vector6::from_column_slice(change.as_slice())));
    gain.is_finite().then(|| direction * gain)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The step is the minimum of the linearised V along its line, with any S.
    #[test]
    fn eq_15_is_the_minimum_along_the_line() {
        let g = Matrix6xX::from_fn(3, |r, c| ((5 * r + 3 * c + r * c) % 7) as f64 - 3.0);
        let p = Vector6::new(1.0, 1.0, 1.0, 1.5, 1.5, 1.5);
        let e = Vector6::new(1.0, -0.5, 0.2, 0.3, -0.7, 0.9);
        for limit in [None, Some(1.0)] {
            let step = step(&g, &p, &e, limit).unwrap();
            let value = |t: f64| value(&p, &(e - &g * &step * t));
            let slope = (value(1.0 + 1e-4) - value(1.0 - 1e-4)) / 2e-4;
            assert!(slope.abs() < 1e-10 && value(1.0) < value(0.0), "{slope}");
        }
    }
}
