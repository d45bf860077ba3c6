//! Linear least squares with lower bounds, from normal equations that can be added up.

use nalgebra::{DMatrix, DVector, Matrix6xX, Vector6};

/// Eigenvalues below this part of the largest are directions that the data does not determine.
const UNDETERMINED: f64 = 1e-12;

/// `Xᵀ X`, `Xᵀ r` and `rᵀ r` over some rows of whitened regressors `X` and residuals `r`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Normal {
    pub(crate) xx: DMatrix<f64>,
    pub(crate) xr: DVector<f64>,
    pub(crate) rr: f64,
}

impl Normal {
    pub(crate) fn zero(parameters: usize) -> Normal {
        Normal {
            xx: DMatrix::zeros(parameters, parameters),
            xr: DVector::zeros(parameters),
            rr: 0.0,
        }
    }

    /// Adds a row; both are weighted component by component.
    pub(crate) fn add_row(&mut self, block: &Matrix6xX<f64>, r: &Vector6<f64>, w: &Vector6<f64>) {
        let mut x = block.clone();
        for mut column in x.column_iter_mut() {
            column.component_mul_assign(w);
        }
        let r = r.component_mul(w);
        self.xx += x.tr_mul(&x);
        self.xr += x.tr_mul(&r);
        self.rr += r.norm_squared();
    }

    pub(crate) fn add(&mut self, other: &Normal) {
        self.xx += &other.xx;
        self.xr += &other.xr;
        self.rr += other.rr;
    }

    /// The `c ≥ least` that makes `|r − X c|²` least.
    pub(crate) fn solve(&self, least: &DVector<f64>) -> DVector<f64> {
        let mut fixed = vec![false; least.len()];
        loop {
            let c = self.solve_free(least, &fixed);
            let below = |k: &usize| !fixed[*k] && c[*k] < least[*k];
            let worst = (0..c.len()).filter(below).max_by(|a, b| {
                let lack = |k: usize| (least[k] - c[k]) * self.xx[(k, k)].sqrt();
                lack(*a).total_cmp(&lack(*b))
            });
            match worst {
                Some(k) => fixed[k] = true,
                None => return c,
            }
        }
    }

    /// The fixed ones at their bound, the others free: by the pseudo-inverse in units in which
    /// every column has length 1.
    fn solve_free(&self, least: &DVector<f64>, fixed: &[bool]) -> DVector<f64> {
        let mut c = least.map(|l| if l.is_finite() { l } else { 0.0 });
        let free: Vec<usize> = (0..c.len()).filter(|&k| !fixed[k]).collect();
        for &k in &free {
            c[k] = 0.0;
        }
        let scale = DVector::from_iterator(
            free.len(),
            free.iter().map(|&k| {
                let length = self.xx[(k, k)].sqrt();
                if length > 0.0 { 1.0 / length } else { 0.0 }
            }),
        );
        let rest = &self.xr - &self.xx * &c;
        let right = rest.select_rows(&free).component_mul(&scale);
        let solved = pseudo_inverse(&self.scaled(&free, &scale)) * right;
        for (slot, &k) in free.iter().enumerate() {
            c[k] = solved[slot] * scale[slot];
        }
        c
    }

    fn scaled(&self, free: &[usize], scale: &DVector<f64>) -> DMatrix<f64> {
        DMatrix::from_fn(free.len(), free.len(), |i, j| {
            self.xx[(free[i], free[j])] * scale[i] * scale[j]
        })
    }

    /// `|r|² − |r − X c|²`.
    pub(crate) fn explained(&self, c: &DVector<f64>) -> f64 {
        2.0 * c.dot(&self.xr) - c.dot(&(&self.xx * c))
    }

    /// Variances of the parameters for residuals of variance 1.
    pub(crate) fn variances(&self) -> DVector<f64> {
        let all: Vec<usize> = (0..self.xr.len()).collect();
        let scale = self.xx.diagonal().map(|d| if d > 0.0 { 1.0 / d.sqrt() } else { 0.0 });
        let inverse = pseudo_inverse(&self.scaled(&all, &scale));
        inverse.diagonal().component_mul(&scale.component_mul(&scale))
    }
}

fn pseudo_inverse(symmetric: &DMatrix<f64>) -> DMatrix<f64> {
    // Of no and of one parameter at once: nalgebra refuses an empty matrix, and permutations come
    // here ten thousand times.
    if symmetric.len() <= 1 {
        return symmetric.map(|e| if e > 0.0 { 1.0 / e } else { 0.0 });
    }
    let eigen = symmetric.clone().symmetric_eigen();
    let largest = eigen.eigenvalues.iter().fold(0.0, |m: f64, e| m.max(*e));
    let inverted = eigen
        .eigenvalues
        .map(|e| if largest > 0.0 && e > UNDETERMINED * largest { 1.0 / e } else { 0.0 });
    let turned = &eigen.eigenvectors * DMatrix::from_diagonal(&inverted);
    turned * eigen.eigenvectors.transpose()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn normal(truth: &[f64]) -> Normal {
        let mut normal = Normal::zero(truth.len());
        for k in 0..9 {
            let block = Matrix6xX::from_fn(truth.len(), |i, j| {
                ((1 + k) as f64 * (1.3 + i as f64 + 2.1 * j as f64)).sin()
                    * 10f64.powi(4 * j as i32)
            });
            let r = &block * DVector::from_column_slice(truth);
            normal.add_row(&block, &r, &Vector6::repeat(2.0));
        }
        normal
    }

    #[test]
    fn finds_the_truth_at_any_scale() {
        let truth = [3.0, -2.0e-4, 5.0e-8];
        let c = normal(&truth).solve(&DVector::from_element(3, f64::NEG_INFINITY));
        for (got, want) in c.iter().zip(truth) {
            assert!((got - want).abs() < 1e-9 * want.abs());
        }
        let whole = normal(&truth);
        assert!((whole.explained(&c) / whole.rr - 1.0).abs() < 1e-12);
    }

    #[test]
    fn keeps_to_the_bounds() {
        let c = normal(&[3.0, -2.0e-4]).solve(&DVector::zeros(2));
        assert!(c[0] > 0.0 && c[1] == 0.0);
        assert_eq!(normal(&[-3.0]).solve(&DVector::zeros(1))[0], 0.0);
        assert_eq!(normal(&[-3.0]).solve(&DVector::from_element(1, -1.0))[0], -1.0);
    }

    #[test]
    fn what_is_not_determined_stays_at_zero() {
        let c = Normal::zero(2).solve(&DVector::from_element(2, f64::NEG_INFINITY));
        assert_eq!(c, DVector::zeros(2));
        assert_eq!(Normal::zero(2).variances(), DVector::zeros(2));
    }
}
