//! What a candidate added to the model explains: on all rows, and on rows that no fit has seen.

use std::ops::Range;

use nalgebra::{Cholesky, DMatrix, DVector};

use super::basis::{Basis, principal};
use super::bounded::Squares;
use super::constants::LOOSE;
use super::limits::RIDGE;
use super::products::Products;
use super::screen::{Columns, Screen};

/// A direction of a candidate whose part left beside the model is smaller than this is not its own:
/// the square of a ratio of sizes of 1e-4.
const OWN: f64 = 1e-8;

/// A candidate fitted beside the model.
#[derive(Clone, Debug)]
pub struct Score {
    /// By how much the weighted squares fall.
    pub drop: f64,
    /// Its values.
    pub values: DVector<f64>,
    /// Directions that are its own.
    pub rank: usize,
    /// Part of its size that is left beside the model, 0 to 1.
    pub own: f64,
}

/// Sums of squares on rows that no fit has seen.
#[derive(Clone, Copy, Debug, Default)]
pub struct HeldOut {
    /// Weighted.
    pub white: f64,
    /// Of what is measured first, m² (rad²).
    pub plain: f64,
}

/// A candidate's products, the model's coordinates such that its normal matrix is the identity.
pub struct Own {
    /// k × its numbers.
    pub zx: DMatrix<f64>,
    /// With what the model leaves.
    pub xr: DVector<f64>,
    /// With itself.
    pub xx: DMatrix<f64>,
}

impl Own {
    /// The candidate fitted beside the model, whose products with the gap are `zr`.
    pub fn score(&self, zr: &DVector<f64>, of: &impl Columns) -> Score {
        let v = &self.xx - self.zx.tr_mul(&self.zx);
        let u = &self.xr - self.zx.tr_mul(zr);
        let size = self.xx.trace();
        let own = if size > 0.0 { (v.trace() / size).max(0.0).sqrt() } else { 0.0 };
        let (values, rank) = solve(v.clone(), &self.xx, u.clone(), of);
        let drop = 2.0 * values.dot(&u) - values.dot(&(&v * &values));
        Score { drop, values, rank, own }
    }

    /// [`price`] of the candidate's `values` beside the model.
    pub fn price(&self, held: &[f64], values: &DVector<f64>, numbers: usize, variance: f64) -> f64 {
        let products = &self.xx - self.zx.tr_mul(&self.zx);
        // What is added once, whatever the numbers, is none of them.
        let (own, count) = (&values.as_slice()[..held.len()], held.len());
        let products = products.view((0, 0), (count, count)).into_owned();
        price(products, held, Some(own), numbers, variance)
    }
}

/// What the evidence of a linear model loses to the priors of some numbers, twice its logarithm:
/// `ln |1 + S Vᵀ R⁻¹ V S|` (MacKay 1992, "Bayesian interpolation"), and what the scale of S costs.
///
/// Nobody knows before there are data how large an effect is, only what is usual. So the standard deviations have a
/// common factor, S = s · [`LOOSE`] · usual with s ≤ 1, which is the size of the `values` themselves: the most likely
/// one (Tipping 2001, "Sparse Bayesian learning"). There values of which the data decide γ cost γ (1 − s²) beyond
/// their prior penalty at s = 1. Any power of e of the scale is as likely as another from the least that the data show up
/// to the usual: it costs their number; beyond the usual the scale's density falls as Cauchy's. Two effects that
/// explain the same by as many usual numbers cost nearly the same then, whatever their units. Without `values` the
/// standard deviations are known, as makers' tolerances are.
///
/// `products` are those of the numbers beside the model with the priors of s = 1 added, `VᵀV + held²`; `variance` is
/// R. A number that is held to nothing has a prior worth one of the measured `numbers` (unit information, Kass and
/// Wasserman 1995: Schwarz' criterion).
pub fn price(
    mut products: DMatrix<f64>,
    held: &[f64],
    values: Option<&[f64]>,
    numbers: usize,
    variance: f64,
) -> f64 {
    let data: Vec<f64> = (0..held.len())
        .map(|k| (products[(k, k)] - held[k] * held[k]).max(0.0) / variance)
        .collect();
    let is_decided = |k: &usize| held[*k] > 0.0 && data[*k] > held[*k] * held[*k];
    let decided: Vec<usize> = (0..held.len()).filter(is_decided).collect();
    let (mut size, mut scale_cost) = (1.0, 0.0);
    if let Some(values) = values.filter(|_| !decided.is_empty()) {
        let prior_penalty: f64 = decided.iter().map(|k| (values[*k] * held[*k]).powi(2)).sum();
        let shown = decided.iter().map(|k| data[*k] / (held[*k] * held[*k])).fold(1.0, f64::max);
        let own = prior_penalty / decided.len() as f64;
        size = own.clamp(f64::EPSILON, 1.0);
        scale_cost = 2.0 * ((0.5 * shown.ln()).ln_1p() + (own * LOOSE * LOOSE).ln_1p());
    }
    let mut scale = DVector::zeros(held.len());
    for (k, held) in held.iter().enumerate() {
        let prior = if *held > 0.0 { held * held / size } else { data[k] / numbers.max(1) as f64 };
        products[(k, k)] = variance * (data[k] + prior);
        scale[k] = if prior > 0.0 { (prior * variance).sqrt().recip() } else { 0.0 };
    }
    let scaled = products.map_with_location(|r, c, x| x * scale[r] * scale[c]);
    // No direction is wider than its prior.
    let wide = principal(scaled).0.map(|wide| wide.max(1.0));
    let narrowed = wide.iter().map(|wide| wide.ln() + (1.0 - size) * (1.0 - 1.0 / wide));
    narrowed.sum::<f64>() + scale_cost
}

/// Minimum of `xᵀ v x − 2 uᵀ x` over the values that are physical; the directions that are `own`.
fn solve(
    v: DMatrix<f64>,
    sizes: &DMatrix<f64>,
    mut u: DVector<f64>,
    of: &impl Columns,
) -> (DVector<f64>, usize) {
    let sizes = sizes.diagonal();
    if !of.is_linearized() {
        return Squares { matrix: &v, right: &u, sizes, decided: OWN }.solve(&of.usual().least);
    }
    // The last column is added once, whatever the values of the others.
    let last = v.ncols() - 1;
    u -= v.column(last);
    let (matrix, right) = (v.view((0, 0), (last, last)).into_owned(), u.rows(0, last).into_owned());
    let sizes = sizes.rows(0, last).into_owned();
    let squares = Squares { matrix: &matrix, right: &right, sizes, decided: OWN };
    let (values, rank) = squares.solve(&of.usual().least);
    (values.push(1.0), rank)
}

impl<C: Columns> Screen<'_, C> {
    /// Its products.
    pub fn own(&self, candidate: usize) -> Own {
        let (range, t) = (self.range(candidate), &self.total);
        Own {
            zx: t.zx.columns_range(range.clone()).into_owned(),
            xr: t.xr.rows_range(range).into_owned(),
            xx: t.xx[candidate].clone(),
        }
    }

    /// A candidate fitted to all rows.
    pub fn score(&self, candidate: usize) -> Score {
        self.own(candidate).score(&self.total.zr, &self.candidates[candidate])
    }

    /// Each block's part in the fall of the squares: `Σ_b` over these, flipped in sign or not, is
    /// what the candidate would explain of a gap so flipped. Columns are whitened so that their
    /// sum's square is the fall. `left` is [`Screen::left_by_block`].
    pub fn shares(&self, candidate: usize, left: &[DVector<f64>]) -> DMatrix<f64> {
        let from = self.at[candidate];
        let range = from..from + self.candidates[candidate].usual().least.len();
        let t = &self.total;
        let zx = t.zx.columns_range(range.clone());
        let xx = t.xx[candidate].view((0, 0), (range.len(), range.len()));
        let v = xx - zx.tr_mul(&zx);
        let whiten = Basis::decided(&v, &xx.diagonal(), OWN).t;
        let mut shares = DMatrix::zeros(whiten.ncols(), self.blocks.len());
        for (b, (block, left)) in self.blocks.iter().zip(left).enumerate() {
            let cross = block.zx.columns_range(range.clone());
            let mine = block.xr.rows_range(range.clone()) - cross.tr_mul(&t.zr);
            let u = mine - zx.tr_mul(left);
            shares.set_column(b, &whiten.tr_mul(&u));
        }
        shares
    }

    /// The model's columns in each block with what it leaves of the gap there.
    pub fn left_by_block(&self) -> Vec<DVector<f64>> {
        self.blocks.iter().map(|block| &block.zr - &block.zz * &self.total.zr).collect()
    }

    /// The folds with the model fitted to the others.
    pub fn trained(&self) -> Vec<Trained> {
        (0..self.folds.len()).map(|fold| Trained::new(self, fold)).collect()
    }

    /// Held-out squares with a candidate (or without any).
    pub fn held_out(&self, trained: &[Trained], candidate: Option<usize>) -> HeldOut {
        let mut sum = HeldOut::default();
        for fold in trained {
            let fit = fold.with(self, candidate);
            sum.white += fit.left(&self.folds[fold.fold]);
            sum.plain += self.plain.get(fold.fold).map_or(0.0, |plain| fit.left(plain));
        }
        HeldOut { white: sum.white.max(0.0), plain: sum.plain.max(0.0) }
    }

    /// The same of each block, weighted.
    pub fn held_out_by_block(&self, trained: &[Trained], candidate: Option<usize>) -> Vec<f64> {
        let fits: Vec<With> = trained.iter().map(|fold| fold.with(self, candidate)).collect();
        let blocks = self.blocks.iter().zip(&self.fold_of_block);
        blocks.map(|(block, fold)| fits[*fold].left(block).max(0.0)).collect()
    }
}

/// The model fitted to all folds but one.
pub struct Trained {
    fold: usize,
    root: Cholesky<f64, nalgebra::Dyn>,
    /// In the root's coordinates.
    right: DVector<f64>,
    zx: DMatrix<f64>,
}

impl Trained {
    fn new<C>(screen: &Screen<'_, C>, fold: usize) -> Self {
        let (t, f) = (&screen.total, &screen.folds[fold]);
        let k = t.zz.nrows();
        let normal = DMatrix::identity(k, k) * (1.0 + RIDGE) - &f.zz;
        let root = Cholesky::new(normal)
            .unwrap_or_else(|| Cholesky::new_unchecked(DMatrix::identity(k, k)));
        let lower = root.l_dirty();
        let mut right = &t.zr - &f.zr;
        let mut zx = &t.zx - &f.zx;
        lower.solve_lower_triangular_mut(&mut right);
        lower.solve_lower_triangular_mut(&mut zx);
        Self { fold, right, zx, root }
    }

    /// The model with a candidate, or without any.
    fn with<C: Columns>(&self, screen: &Screen<'_, C>, candidate: Option<usize>) -> With {
        let Some(c) = candidate else {
            let values = DVector::zeros(0);
            return With { candidate, range: 0..0, z: self.back(&self.right), values };
        };
        let range = screen.range(c);
        let (t, f) = (&screen.total, &screen.folds[self.fold]);
        let zx = self.zx.columns_range(range.clone());
        let sizes = &t.xx[c] - &f.xx[c];
        let v = &sizes - zx.tr_mul(&zx);
        let right = t.xr.rows_range(range.clone()) - f.xr.rows_range(range.clone());
        let u = right - zx.tr_mul(&self.right);
        let (values, _) = solve(v, &sizes, u, &screen.candidates[c]);
        With { candidate, range, z: self.back(&(&self.right - zx * &values)), values }
    }

    /// From the root's coordinates to the model's.
    fn back(&self, y: &DVector<f64>) -> DVector<f64> {
        let mut z = y.clone();
        self.root.l_dirty().tr_solve_lower_triangular_mut(&mut z);
        z
    }
}

/// Values of the model and of a candidate, or of the model alone.
struct With {
    candidate: Option<usize>,
    /// The candidate's columns.
    range: Range<usize>,
    z: DVector<f64>,
    values: DVector<f64>,
}

impl With {
    /// Squares that they leave of some rows.
    fn left(&self, p: &Products) -> f64 {
        let Self { candidate, range, z, values } = self;
        let zx = p.zx.columns_range(range.clone());
        let model = z.dot(&(&p.zz * z)) - 2.0 * z.dot(&p.zr);
        let own = candidate.map_or(0.0, |c| {
            values.dot(&(&p.xx[c] * values)) - 2.0 * values.dot(&p.xr.rows_range(range.clone()))
                + 2.0 * z.dot(&(zx * values))
        });
        p.rr + model + own
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix2, Matrix4, Matrix4x2};

    use super::*;

    /// Against the determinant of the covariance of the data, `|R + V S² Vᵀ| / |R|`, which is that of the numbers by
    /// Sylvester's identity.
    #[test]
    fn numbers_are_narrowed_by_as_much_as_the_data_are_widened_by_their_prior() {
        let columns = Matrix4x2::new(1.0, 0.5, -0.3, 2.0, 0.7, 0.1, 0.2, -1.1);
        let (held, variance) = ([2.0, 0.4], 0.09);
        let scaled = columns * Matrix2::new(1.0 / held[0], 0.0, 0.0, 1.0 / held[1]);
        let widened = |size: f64| {
            let covariance = scaled * size * scaled.transpose();
            ((Matrix4::identity() * variance + covariance) / variance).determinant().ln()
        };
        let mut products = columns.tr_mul(&columns);
        (0..2).for_each(|k| products[(k, k)] += held[k] * held[k]);
        let of = |products, held: &[f64], values| price(products, held, values, 99, variance);
        let products = DMatrix::from_column_slice(2, 2, products.as_slice());
        assert!((of(products.clone(), &held, None) - widened(1.0)).abs() < 1e-12);
        // A tenth as large: and as many units as are decided, Sylvester's trace.
        let size = 0.01;
        let covariance = scaled * size * scaled.transpose();
        let whole = Matrix4::identity() * variance + covariance;
        let decided = (whole.try_inverse().unwrap() * covariance).trace();
        // One of the e-folds of scales that the data show, and hardly unusual.
        let shown = (0..2).map(|k| columns.column(k).norm() / held[k] / variance.sqrt());
        let folds = shown.fold(1.0, f64::max).ln();
        let price = of(products, &held, Some(&[0.05, 0.25]));
        let price = price - 2.0 * ((1.0 + folds).ln() + 1.09_f64.ln());
        assert!((price - widened(size) - (1.0 - size) * decided).abs() < 1e-12);
        // Held to nothing: one of the numbers that were measured.
        let alone = DMatrix::from_element(1, 1, 7.0);
        assert!((of(alone, &[0.0], Some(&[1.0])) - 100_f64.ln()).abs() < 1e-12);
        assert_eq!(of(DMatrix::zeros(2, 2), &[0.0; 2], None), 0.0);
    }
}
