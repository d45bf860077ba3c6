//! The gradient law of Bicchi & Melchiorri, eqs. 12-15, corrected.
//!
//! `e = w_d − w` is the wrench error in base axes (eq. 8), P the weights, G = ∂w/∂q, T the sampling
//! period in seconds. Eq. 12 must have λ inside its bracket, and eq. 14 the S that eq. 15 has:
//!
//! ```text
//! (12)  q̇ = [λ + eᵀP ẇ_d / (eᵀP G Gᵀ P e)] Gᵀ P e        then V̇ = −λ |Gᵀ P e|²
//! (14)  q̇_n = λ_n S_n G_nᵀ P e_n
//! (15)  λ_n = (1/T) eᵀP G S Gᵀ P e / (eᵀP G S Gᵀ P G S Gᵀ P e)
//! ```
//!
//! With this λ_n a step `T q̇_n` goes to the minimum of V along its line, as far as V is quadratic.
//! V̇ is zero, and not negative as eq. 10 asks, wherever Gᵀ P e = 0.

use nalgebra::{DVector, Matrix6xX, Vector6};

use super::Weights;

/// `Gᵀ P e`: steepest descent of V in the joint values.
pub fn descent(g: &Matrix6xX<f64>, weights: &Weights, e: &Vector6<f64>) -> DVector<f64> {
    g.tr_mul(&e.component_mul(&weights.diagonal()))
}

/// Joint rates by eq. 12, corrected, in 1/s: `lambda` in 1/(s N²), the wanted wrench moving at
/// `target_rate` (N/s, N·m/s). Zero where the error cannot be changed, Gᵀ P e = 0.
pub fn rates(
    g: &Matrix6xX<f64>,
    weights: &Weights,
    e: &Vector6<f64>,
    target_rate: &Vector6<f64>,
    lambda: f64,
) -> DVector<f64> {
    let descent = descent(g, weights, e);
    let square = descent.norm_squared();
    if square == 0.0 {
        return descent;
    }
    let feed = e.component_mul(&weights.diagonal()).dot(target_rate) / square;
    descent * (lambda + feed)
}

/// Joint rates by eq. 13, in 1/s: eq. 12 for a wanted wrench that stands still, or without regard
/// to its motion. V then falls outside a neighbourhood of e = 0 only.
pub fn simplified_rates(
    g: &Matrix6xX<f64>,
    weights: &Weights,
    e: &Vector6<f64>,
    lambda: f64,
) -> DVector<f64> {
    descent(g, weights, e) * lambda
}

/// The diagonal of `S_n`: it brings every element of `descent` down to `limit` and leaves those
/// below alone; without a limit S = I.
pub fn limiter(descent: &DVector<f64>, limit: Option<f64>) -> DVector<f64> {
    descent.map(|element| match limit {
        Some(limit) if element.abs() > limit => limit / element.abs(),
        _ => 1.0,
    })
}

/// The gain λ_n of eq. 15, 1/(s N²); `None` where the step would be infinite, `P^½ G S Gᵀ P e` = 0.
pub fn gain(
    g: &Matrix6xX<f64>,
    weights: &Weights,
    e: &Vector6<f64>,
    s: &DVector<f64>,
    period: f64,
) -> Option<f64> {
    let descent = descent(g, weights, e);
    let direction = descent.component_mul(s);
    let change = (g * &direction).component_mul(&weights.root());
    let gain = descent.dot(&direction) / change.norm_squared() / period;
    gain.is_finite().then_some(gain)
}

/// One step of the discrete law, `T q̇_n` by eqs. 14 and 15, rad (m); it does not depend on T.
/// `None` where there is no descent.
pub fn step(
    g: &Matrix6xX<f64>,
    weights: &Weights,
    e: &Vector6<f64>,
    limit: Option<f64>,
) -> Option<DVector<f64>> {
    let descent = descent(g, weights, e);
    let s = limiter(&descent, limit);
    let gain = gain(g, weights, e, &s, 1.0)?;
    Some(descent.component_mul(&s) * gain)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> (Matrix6xX<f64>, Weights, Vector6<f64>) {
        let g = Matrix6xX::from_fn(3, |r, c| ((5 * r + 3 * c + r * c) % 7) as f64 - 3.0);
        let e = Vector6::new(1.0, -0.5, 0.2, 0.3, -0.7, 0.9);
        (g, Weights::with_length(0.8).unwrap(), e)
    }

    /// The step is the minimum of the linearised V along its line, with any S.
    #[test]
    fn eq_15_is_the_minimum_along_the_line() {
        let (g, weights, e) = example();
        for limit in [None, Some(1.0)] {
            let step = step(&g, &weights, &e, limit).unwrap();
            let value = |t: f64| weights.value(&(e - &g * &step * t));
            let slope = (value(1.0 + 1e-4) - value(1.0 - 1e-4)) / 2e-4;
            assert!(slope.abs() < 1e-10 && value(1.0) < value(0.0), "{slope}");
        }
    }

    /// Eq. 12 with λ inside the bracket makes V̇ = −λ |Gᵀ P e|² for a moving target; eq. 13 does so
    /// for a target that stands still.
    #[test]
    fn the_continuous_law_lets_v_fall() {
        let (g, weights, e) = example();
        let moving = Vector6::new(0.4, 0.1, -2.0, 1.0, 0.0, 0.3);
        let fall = |target: &Vector6<f64>, rates: &DVector<f64>| {
            e.component_mul(&weights.diagonal()).dot(&(target - &g * rates))
        };
        let expected = -0.7 * descent(&g, &weights, &e).norm_squared();
        let full = fall(&moving, &rates(&g, &weights, &e, &moving, 0.7));
        assert!((full / expected - 1.0).abs() < 1e-12);
        let still = fall(&Vector6::zeros(), &simplified_rates(&g, &weights, &e, 0.7));
        assert!((still / expected - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_period_only_scales_the_gain() {
        let (g, weights, e) = example();
        let s = DVector::repeat(3, 1.0);
        let at = |period| gain(&g, &weights, &e, &s, period).unwrap();
        assert!((at(0.01) * 0.01 - at(1.0)).abs() < 1e-15);
    }

    #[test]
    fn without_descent_there_is_no_step() {
        let (g, weights, _) = example();
        let nothing = Vector6::zeros();
        assert_eq!(step(&g, &weights, &nothing, None), None);
        let still = rates(&g, &weights, &nothing, &Vector6::repeat(1.0), 1.0);
        assert_eq!(still, DVector::zeros(3));
    }
}
