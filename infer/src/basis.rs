//! Least squares with directions that the data do not decide: found by rank, and left where they
//! are.

use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};

use super::limits::LEAST_OWN;

/// A direction whose part of the (scaled) normal matrix is below this is not decided: the square of
/// a ratio of singular values of 3e-6, where rounding of the products begins to show.
pub const RANK: f64 = 1e-11;

/// Where so much is left of every column beside those before it no direction is near [`RANK`], nor near
/// any other bound that is asked for.
const CLEAR: f64 = 1e-4;

/// Coordinates in which a normal matrix is the identity: `tᵀ A t = 1`, undecided directions left
/// out.
#[derive(Clone, Debug)]
pub struct Basis {
    /// k×rank.
    pub t: DMatrix<f64>,
}

impl Basis {
    /// A direction counts as undecided below [`RANK`] of the diagonal.
    pub fn new(normal: &DMatrix<f64>) -> Self {
        Self::decided(normal, &normal.diagonal(), RANK)
    }

    /// With the squared size of each unknown's column, if others were projected out of the matrix,
    /// and the part of it below which a direction is not decided.
    pub fn decided(normal: &DMatrix<f64>, sizes: &DVector<f64>, least: f64) -> Self {
        let k = normal.nrows();
        if k == 0 {
            return Self { t: DMatrix::zeros(0, 0) };
        }
        let scale = DVector::from_fn(k, |i, _| {
            let size = sizes[i].max(0.0).sqrt();
            if size > 0.0 { 1.0 / size } else { 0.0 }
        });
        let scaled = DMatrix::from_fn(k, k, |r, c| normal[(r, c)] * scale[r] * scale[c]);
        if let Some(mut t) = triangular(&scaled) {
            t.row_iter_mut().zip(scale.iter()).for_each(|(mut row, scale)| row *= *scale);
            return Self { t };
        }
        let (values, vectors) = principal(scaled);
        let kept: Vec<usize> = (0..k).filter(|&i| values[i] > least).collect();
        let t = DMatrix::from_fn(k, kept.len(), |r, c| {
            let i = kept[c];
            scale[r] * vectors[(r, i)] / values[i].sqrt()
        });
        Self { t }
    }

    /// Of the unknowns in their order: those of which no more than a billionth of the squared size stands
    /// apart from those before them stay 0.
    pub fn ordered(normal: &DMatrix<f64>) -> Self {
        let k = normal.nrows();
        let scale = normal.diagonal().map(|d| if d > 0.0 { 1.0 / d.sqrt() } else { 0.0 });
        let mut factor = DMatrix::zeros(k, k);
        let mut seen: Vec<usize> = Vec::with_capacity(k);
        for at in 0..k {
            let rank = seen.len();
            let mut row =
                DVector::from_fn(rank, |j, _| normal[(at, seen[j])] * scale[at] * scale[seen[j]]);
            factor.view((0, 0), (rank, rank)).solve_lower_triangular_mut(&mut row);
            let rest = normal[(at, at)] * scale[at] * scale[at] - row.norm_squared();
            if rest > LEAST_OWN {
                factor.view_mut((rank, 0), (1, rank)).tr_copy_from(&row);
                factor[(rank, rank)] = rest.sqrt();
                seen.push(at);
            }
        }
        let rank = seen.len();
        let mut inverse = DMatrix::identity(rank, rank);
        factor.view((0, 0), (rank, rank)).tr_solve_lower_triangular_mut(&mut inverse);
        let mut t = DMatrix::zeros(k, rank);
        for (at, row) in seen.into_iter().zip(inverse.row_iter()) {
            t.row_mut(at).copy_from(&(row * scale[at]));
        }
        Self { t }
    }

    /// Whether an unknown is decided, alone or with others.
    pub fn decides(&self, unknown: usize) -> bool {
        self.t.row(unknown).iter().any(|x| *x != 0.0)
    }

    /// How many directions are decided.
    pub fn rank(&self) -> usize {
        self.t.ncols()
    }

    /// The least-squares solution of least size in the undecided directions.
    pub fn solve(&self, right: &DVector<f64>) -> DVector<f64> {
        &self.t * self.t.tr_mul(right)
    }

    /// Variance of each unknown per unit of the numbers' variance.
    pub fn variances(&self) -> DVector<f64> {
        DVector::from_fn(self.t.nrows(), |r, _| self.t.row(r).norm_squared())
    }
}

/// The inverse of the transposed root of a scaled matrix that is far from undecided in any direction: far
/// less work than its principal directions.
fn triangular(scaled: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let root = Cholesky::new(scaled.clone())?;
    let is_clear = |pivot: &f64| pivot * pivot > CLEAR;
    root.l_dirty().diagonal().iter().all(is_clear).then(|| {
        let mut inverse = DMatrix::identity(scaled.nrows(), scaled.nrows());
        root.l_dirty().tr_solve_lower_triangular_mut(&mut inverse);
        inverse
    })
}

/// Sweeps after which a decomposition is given up.
const MOST_SWEEPS: usize = 10_000;

/// Eigenvalues, none below 0, and vectors of a symmetric matrix that has none; of one that resists,
/// no direction is decided.
pub fn principal(matrix: DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
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

    #[test]
    fn an_unknown_that_those_before_it_make_up_stays_zero() {
        let rows = DMatrix::from_row_slice(
            3,
            4,
            &[1.0, 1e6, 0.0, 0.0, 2.0, 2e6, 1.0, 0.0, 3.0, 3e6, 5.0, 0.0],
        );
        let basis = Basis::ordered(&rows.tr_mul(&rows));
        assert_eq!([0, 1, 2, 3].map(|k| basis.decides(k)), [true, false, true, false]);
        let found = basis.solve(&rows.tr_mul(&DVector::from_vec(vec![2.0, 1.0, -9.0])));
        let wanted = DVector::from_vec(vec![2.0, 0.0, -3.0, 0.0]);
        assert!((found - wanted).amax() < 1e-9);
    }
}
