//! What a candidate added to the model explains: on all rows, and on rows that no fit has seen.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::products::Products;
use super::screen::Screen;
use crate::diagnose::fit::{Basis, Squares, principal};

/// A direction of a candidate whose part left beside the model is smaller than this is not its own:
/// the square of a ratio of sizes of 1e-4.
const OWN: f64 = 1e-8;

/// Rounds in which a variance and what is left at it settle: each is nearer by the part of the
/// numbers that are hardly decided.
const ROUNDS: usize = 6;

/// Kept in a fold's normal matrix where the rows that are left do not decide a direction.
const RIDGE: f64 = 1e-9;

/// A candidate fitted beside the model.
#[derive(Clone, Debug)]
pub(crate) struct Score {
    /// By how much the weighted squares fall.
    pub(crate) drop: f64,
    /// Its values.
    pub(crate) values: DVector<f64>,
    /// Directions that are its own.
    pub(crate) rank: usize,
    /// Part of its size that is left beside the model, 0 to 1.
    pub(crate) own: f64,
}

/// Sums of squares on rows that no fit has seen.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct HeldOut {
    /// Weighted.
    pub(crate) white: f64,
    /// Of what is measured first, m² (rad²).
    pub(crate) plain: f64,
}

/// A candidate's products, the model's coordinates such that its normal matrix is the identity.
pub(crate) struct Own {
    pub(crate) zx: DMatrix<f64>,
    pub(crate) xr: DVector<f64>,
    pub(crate) xx: DMatrix<f64>,
}

impl Own {
    /// The candidate fitted beside the model, whose products with the gap are `zr`.
    pub(crate) fn score(&self, zr: &DVector<f64>, least: &[f64]) -> Score {
        let v = &self.xx - self.zx.tr_mul(&self.zx);
        let u = &self.xr - self.zx.tr_mul(zr);
        let size = self.xx.trace();
        let own = if size > 0.0 { (v.trace() / size).max(0.0).sqrt() } else { 0.0 };
        let (values, rank) = solve(&v, &self.xx, &u, least);
        let drop = 2.0 * values.dot(&u) - values.dot(&(&v * &values));
        Score { drop, values, rank, own }
    }
}

/// Minimum of `xᵀ v x − 2 uᵀ x` over the values that are physical; the directions that are `own`.
fn solve(
    v: &DMatrix<f64>,
    sizes: &DMatrix<f64>,
    u: &DVector<f64>,
    least: &[f64],
) -> (DVector<f64>, usize) {
    Squares { matrix: v, right: u, sizes: sizes.diagonal(), decided: OWN }.solve(least)
}

impl Screen<'_> {
    fn own(&self, candidate: usize) -> Own {
        let (range, t) = (self.range(candidate), &self.total);
        Own {
            zx: t.zx.columns_range(range.clone()).into_owned(),
            xr: t.xr.rows_range(range).into_owned(),
            xx: t.xx[candidate].clone(),
        }
    }

    /// A candidate fitted to all rows.
    pub(crate) fn score(&self, candidate: usize) -> Score {
        self.own(candidate).score(&self.total.zr, &self.candidates[candidate].least)
    }

    /// A candidate of many numbers, each held to its tolerance, fitted to all rows at the variance
    /// of what it leaves, which `variance` makes of squares and a number of parameters; and its cost:
    /// how far its numbers are from 0, and by how much the data narrow them (the evidence of a linear
    /// model with a normal prior, MacKay 1992).
    pub(crate) fn tolerated(
        &self,
        candidate: usize,
        variance: impl Fn(f64, usize) -> f64,
    ) -> (Score, f64) {
        let own = self.own(candidate);
        let held = DVector::from_column_slice(&self.candidates[candidate].held);
        let scaled = |m: DMatrix<f64>| m.map_with_location(|r, c, x| x / (held[r] * held[c]));
        let size = held.len();
        let data = scaled(&own.xx - own.zx.tr_mul(&own.zx)) - DMatrix::identity(size, size);
        let (seen, turn) = principal(data);
        let right = turn.tr_mul(&(&own.xr - own.zx.tr_mul(&self.total.zr)).component_div(&held));
        let mut unit = variance(self.left(), 0);
        let (mut drop, mut decided) = (0.0, 0.0);
        let mut values = DVector::zeros(size);
        for _ in 0..ROUNDS {
            values = right.zip_map(&seen, |u, seen| u / (seen + unit));
            drop = 2.0 * values.dot(&right) - values.dot(&values.component_mul(&seen));
            decided = seen.map(|seen| seen / (seen + unit)).sum();
            unit = variance((self.left() - drop).max(0.0), decided.round() as usize);
        }
        let narrowed: f64 = seen.map(|seen| (seen / unit).ln_1p()).sum();
        let cost = values.norm_squared() + narrowed;
        let values = (turn * values).component_div(&held);
        (Score { drop, values, rank: decided.round() as usize, own: 1.0 }, cost)
    }

    /// Each block's part in the fall of the squares: `Σ_b` over these, flipped in sign or not, is
    /// what the candidate would explain of a gap so flipped. Columns are whitened so that their
    /// sum's square is the fall. `left` is [`Screen::left_by_block`].
    pub(crate) fn shares(&self, candidate: usize, left: &[DVector<f64>]) -> DMatrix<f64> {
        let range = self.range(candidate);
        let t = &self.total;
        let zx = t.zx.columns_range(range.clone());
        let v = &t.xx[candidate] - zx.tr_mul(&zx);
        let whiten = Basis::decided(&v, &t.xx[candidate].diagonal(), OWN).t;
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
    pub(crate) fn left_by_block(&self) -> Vec<DVector<f64>> {
        self.blocks.iter().map(|block| &block.zr - &block.zz * &self.total.zr).collect()
    }

    /// The folds with the model fitted to the others.
    pub(crate) fn trained(&self) -> Vec<Trained> {
        (0..self.folds.len()).map(|fold| Trained::new(self, fold)).collect()
    }

    /// Held-out squares with a candidate (or without any).
    pub(crate) fn held_out(&self, trained: &[Trained], candidate: Option<usize>) -> HeldOut {
        let mut sum = HeldOut::default();
        for fold in trained {
            let (y, values, range) = match candidate {
                None => (fold.right.clone(), DVector::zeros(0), 0..0),
                Some(c) => {
                    let (y, values) = fold.fit(self, c);
                    (y, values, self.range(c))
                }
            };
            let z = fold.back(&y);
            let left = |p: &Products| {
                let zx = p.zx.columns_range(range.clone());
                let model = z.dot(&(&p.zz * &z)) - 2.0 * z.dot(&p.zr);
                let own = match candidate {
                    None => 0.0,
                    Some(c) => {
                        values.dot(&(&p.xx[c] * &values))
                            - 2.0 * values.dot(&p.xr.rows_range(range.clone()))
                            + 2.0 * z.dot(&(zx * &values))
                    }
                };
                p.rr + model + own
            };
            sum.white += left(&self.folds[fold.fold]);
            sum.plain += left(&self.plain[fold.fold]);
        }
        HeldOut { white: sum.white.max(0.0), plain: sum.plain.max(0.0) }
    }
}

/// The model fitted to all folds but one.
pub(crate) struct Trained {
    fold: usize,
    root: Cholesky<f64, nalgebra::Dyn>,
    /// In the root's coordinates.
    right: DVector<f64>,
    zx: DMatrix<f64>,
}

impl Trained {
    fn new(screen: &Screen<'_>, fold: usize) -> Self {
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

    /// The candidate's values, and the model's in the root's coordinates.
    fn fit(&self, screen: &Screen<'_>, candidate: usize) -> (DVector<f64>, DVector<f64>) {
        let range = screen.range(candidate);
        let (t, f) = (&screen.total, &screen.folds[self.fold]);
        let zx = self.zx.columns_range(range.clone());
        let sizes = &t.xx[candidate] - &f.xx[candidate];
        let v = &sizes - zx.tr_mul(&zx);
        let right = t.xr.rows_range(range.clone()) - f.xr.rows_range(range);
        let u = right - zx.tr_mul(&self.right);
        let (values, _) = solve(&v, &sizes, &u, &screen.candidates[candidate].least);
        (&self.right - zx * &values, values)
    }

    /// From the root's coordinates to the model's.
    fn back(&self, y: &DVector<f64>) -> DVector<f64> {
        let mut z = y.clone();
        self.root.l_dirty().tr_solve_lower_triangular_mut(&mut z);
        z
    }
}
