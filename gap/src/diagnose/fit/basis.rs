//! Least squares with directions that the data do not decide: found by rank, and left where they
//! are.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// A direction whose part of the (scaled) normal matrix is below this is not decided: the square of
/// a ratio of singular values of 3e-6, where rounding of the products begins to show.
pub(crate) const RANK: f64 = 1e-11;

/// Coordinates in which a normal matrix is the identity: `tᵀ A t = 1`, undecided directions left
/// out.
#[derive(Clone, Debug)]
pub(crate) struct Basis {
    /// k×rank.
    pub(crate) t: DMatrix<f64>,
}

impl Basis {
    pub(crate) fn new(normal: &DMatrix<f64>) -> Self {
        Self::decided(normal, &normal.diagonal(), RANK)
    }

    /// With the squared size of each unknown's column, if others were projected out of the matrix,
    /// and the part of it below which a direction is not decided.
    pub(crate) fn decided(normal: &DMatrix<f64>, sizes: &DVector<f64>, least: f64) -> Self {
        let k = normal.nrows();
        if k == 0 {
            return Self { t: DMatrix::zeros(0, 0) };
        }
        let scale = DVector::from_fn(k, |i, _| {
            let size = sizes[i].max(0.0).sqrt();
            if size > 0.0 { 1.0 / size } else { 0.0 }
        });
        let scaled = DMatrix::from_fn(k, k, |r, c| normal[(r, c)] * scale[r] * scale[c]);
        let (values, vectors) = principal(scaled);
        let kept: Vec<usize> = (0..k).filter(|&i| values[i] > least).collect();
        let t = DMatrix::from_fn(k, kept.len(), |r, c| {
            let i = kept[c];
            scale[r] * vectors[(r, i)] / values[i].sqrt()
        });
        Self { t }
    }

    pub(crate) fn rank(&self) -> usize {
        self.t.ncols()
    }

    /// The least-squares solution of least size in the undecided directions.
    pub(crate) fn solve(&self, right: &DVector<f64>) -> DVector<f64> {
        &self.t * self.t.tr_mul(right)
    }

    /// Variance of each unknown per unit of the numbers' variance.
    pub(crate) fn variances(&self) -> DVector<f64> {
        DVector::from_fn(self.t.nrows(), |r, _| self.t.row(r).norm_squared())
    }
}

/// Sweeps after which a decomposition is given up.
const MOST_SWEEPS: usize = 10_000;

/// Eigenvalues, none below 0, and vectors of a symmetric matrix that has none; of one that resists,
/// no direction is decided.
pub(crate) fn principal(matrix: DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
    let n = matrix.nrows();
    SymmetricEigen::try_new(matrix, f64::EPSILON, MOST_SWEEPS).map_or_else(
        || (DVector::zeros(n), DMatrix::identity(n, n)),
        |eigen| (eigen.eigenvalues.map(|value| value.max(0.0)), eigen.eigenvectors),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_undecided_direction_is_left_out() {
        // Only the sum of the first two unknowns is seen, and in units far apart.
        let rows = DMatrix::from_row_slice(3, 3, &[1.0, 1e6, 0.0, 2.0, 2e6, 1.0, 3.0, 3e6, 5.0]);
        let basis = Basis::new(&rows.tr_mul(&rows));
        assert_eq!(basis.rank(), 2);
        let truth = DVector::from_vec(vec![1.0, 2e-6, -3.0]);
        let right = rows.tr_mul(&(&rows * &truth));
        let found = basis.solve(&right);
        assert!((&rows * (found - truth)).amax() < 1e-9);
    }
}
