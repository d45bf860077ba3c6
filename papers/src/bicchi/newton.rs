//! Steps to the least squares: Gauss and Newton's, and Levenberg and Marquardt's.
//!
//! With `r = P^½ e` and `J = P^½ G` both take `dq` from the singular values of J: where the joints
//! are redundant the shortest of all equivalent steps, where the arm is defective the step to the
//! smallest remainder.

use nalgebra::{DMatrix, DVector, Dyn, Matrix6xX, SVD, Vector6};

use super::Weights;

/// The linearised problem at one posture.
pub(super) struct Linear {
    svd: SVD<f64, Dyn, Dyn>,
    residual: DVector<f64>,
}

impl Linear {
    pub(super) fn new(g: &Matrix6xX<f64>, weights: &Weights, e: &Vector6<f64>) -> Self {
        let root = weights.root();
        let weighted = DMatrix::from_fn(6, g.ncols(), |r, c| root[r] * g[(r, c)]);
        let residual = DVector::from_fn(6, |r, _| root[r] * e[r]);
        Linear { svd: weighted.svd(true, true), residual }
    }

    /// The step in which each singular direction counts by `factor(singular value)`.
    fn step(&self, factor: impl Fn(f64) -> f64) -> DVector<f64> {
        let (Some(u), Some(v)) = (&self.svd.u, &self.svd.v_t) else {
            return DVector::zeros(0);
        };
        let along = u.tr_mul(&self.residual);
        let scaled = along.zip_map(&self.svd.singular_values, |a, s| a * factor(s));
        v.tr_mul(&scaled)
    }

    /// The largest singular value.
    pub(super) fn largest(&self) -> f64 {
        self.svd.singular_values.iter().copied().fold(0.0, f64::max)
    }

    /// Gauss and Newton's step, without the directions whose singular value is below `truncation`
    /// times the largest.
    pub(super) fn gauss_newton(&self, truncation: f64) -> DVector<f64> {
        let least = truncation * self.largest();
        self.step(|s| if s > least && s > 0.0 { 1.0 / s } else { 0.0 })
    }

    /// Levenberg and Marquardt's step: `(JᵀJ + μ) dq = Jᵀ r`.
    pub(super) fn damped(&self, mu: f64) -> DVector<f64> {
        self.step(|s| s / (s * s + mu))
    }

    /// How far V would fall by the damped step if it were quadratic: `dqᵀ (μ dq + Jᵀ r)/2`.
    pub(super) fn predicted(&self, step: &DVector<f64>, mu: f64) -> f64 {
        let gradient = self.gradient();
        step.dot(&(step * mu + gradient)) / 2.0
    }

    /// `Jᵀ r = Gᵀ P e`.
    pub(super) fn gradient(&self) -> DVector<f64> {
        self.step(|s| s)
    }

    /// Number of wrench components that the joints move independently: singular values above
    /// `truncation` times the largest.
    pub(super) fn rank(&self, truncation: f64) -> usize {
        let least = truncation * self.largest();
        self.svd.singular_values.iter().filter(|&&s| s > least && s > 0.0).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example(columns: usize) -> (Matrix6xX<f64>, Vector6<f64>) {
        let g = Matrix6xX::from_fn(columns, |r, c| ((5 * r + 3 * c + r * c) % 7) as f64 - 3.0);
        (g, Vector6::new(1.0, -0.5, 0.2, 0.3, -0.7, 0.9))
    }

    #[test]
    fn the_damped_step_solves_the_normal_equations() {
        for columns in [3, 8] {
            let (g, e) = example(columns);
            let weights = Weights::with_length(0.7).unwrap();
            let linear = Linear::new(&g, &weights, &e);
            let step = linear.damped(0.3);
            let p = nalgebra::Matrix6::from_diagonal(&weights.diagonal());
            let left = g.transpose() * p * &g * &step + &step * 0.3 - g.transpose() * p * e;
            assert!(left.amax() < 1e-12);
            assert!((linear.gradient() - g.transpose() * p * e).amax() < 1e-12);
            let fall = weights.value(&e) - weights.value(&(e - &g * &step));
            assert!((fall - linear.predicted(&step, 0.3)).abs() < 1e-12);
        }
    }

    #[test]
    fn a_redundant_arm_takes_the_shortest_step() {
        let (mut g, e) = example(2);
        g = g.resize_horizontally(3, 0.0);
        let second = g.column(1).clone_owned();
        g.set_column(2, &second);
        let linear = Linear::new(&g, &Weights::UNIT, &e);
        let step = linear.gauss_newton(1e-10);
        assert!((step[1] - step[2]).abs() < 1e-12);
        assert_eq!(linear.rank(1e-10), 2);
    }
}
