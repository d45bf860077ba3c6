//! One pass over the data: the products of everything that may be added with everything that is
//! already in the model, gathered by blocks of poses. All that is asked of the candidates
//! afterwards (how much each explains, held out, under flipped signs) is algebra on these.
//!
//! Memory is blocks × parameters in the model × numbers of all candidates; time is linear in rows.

use nalgebra::{DMatrix, DVector, Matrix6xX, Vector6};
use rayon::prelude::*;

use super::basis::Basis;
use super::candidate::Candidate;
use super::folds::Folds;
use super::model::Model;
use super::problem::Problem;
use super::refit::Fit;

/// Products of one set of rows: `z` are the model's parameters (in the coordinates of
/// [`Screen::basis`]), `x` the candidates' numbers, `r` what is left.
#[derive(Clone, Debug)]
pub(crate) struct Products {
    pub(crate) zz: DMatrix<f64>,
    pub(crate) zr: DVector<f64>,
    pub(crate) rr: f64,
    /// k × all numbers of all candidates.
    pub(crate) zx: DMatrix<f64>,
    pub(crate) xr: DVector<f64>,
    /// p×p of each candidate with itself.
    pub(crate) xx: Vec<DMatrix<f64>>,
}

impl Products {
    fn zeros(k: usize, sizes: &[usize]) -> Self {
        let all = sizes.iter().sum();
        Self {
            zz: DMatrix::zeros(k, k),
            zr: DVector::zeros(k),
            rr: 0.0,
            zx: DMatrix::zeros(k, all),
            xr: DVector::zeros(all),
            xx: sizes.iter().map(|p| DMatrix::zeros(*p, *p)).collect(),
        }
    }

    pub(crate) fn add(&mut self, other: &Products) {
        self.zz += &other.zz;
        self.zr += &other.zr;
        self.rr += other.rr;
        self.zx += &other.zx;
        self.xr += &other.xr;
        for (mine, theirs) in self.xx.iter_mut().zip(&other.xx) {
            *mine += theirs;
        }
    }

    /// Of whitened rows: `z` is c×k, `x` c×all, `r` has c numbers.
    fn add_rows(&mut self, z: &DMatrix<f64>, x: &DMatrix<f64>, r: &DVector<f64>, at: &[usize]) {
        self.zz.gemm_tr(1.0, z, z, 1.0);
        self.zr.gemv_tr(1.0, z, r, 1.0);
        self.rr += r.norm_squared();
        self.zx.gemm_tr(1.0, z, x, 1.0);
        self.xr.gemv_tr(1.0, x, r, 1.0);
        for (product, &from) in self.xx.iter_mut().zip(at) {
            let columns = x.columns(from, product.ncols());
            product.gemm_tr(1.0, &columns, &columns, 1.0);
        }
    }

    fn turned(&mut self, t: &DMatrix<f64>) {
        self.zz = t.tr_mul(&self.zz) * t;
        self.zr = t.tr_mul(&self.zr);
        self.zx = t.tr_mul(&self.zx);
    }
}

/// The candidates against a fitted model.
pub(crate) struct Screen<'c> {
    pub(crate) candidates: &'c [Candidate],
    /// First number of each candidate.
    pub(crate) at: Vec<usize>,
    pub(crate) basis: Basis,
    /// Of each block of poses.
    pub(crate) blocks: Vec<Products>,
    /// Of all rows.
    pub(crate) total: Products,
    /// The same of each fold.
    pub(crate) folds: Vec<Products>,
    /// Of each fold, what is measured first alone (positions, or rotations without them), in m or
    /// rad; empty products where they were not wanted.
    pub(crate) plain: Vec<Products>,
    pub(crate) has_plain: bool,
}

/// What the model keeps fitted while candidates are screened.
pub(crate) struct Kept<'k> {
    pub(crate) fit: &'k Fit,
    /// Effects of the model that are taken out, so that others may stand in for them; ascending.
    pub(crate) without: &'k [usize],
    /// Columns of further candidates that are fitted along.
    pub(crate) along: &'k [Candidate],
    /// Whether held-out gaps are wanted in m and rad too, not only weighted.
    pub(crate) plain: bool,
    /// Whether whole folds are blocks enough: where neither signs are flipped nor halves drawn.
    pub(crate) coarse: bool,
}

impl<'k> Kept<'k> {
    /// All of a fit's model.
    pub(crate) fn all(fit: &'k Fit) -> Self {
        Self { fit, without: &[], along: &[], plain: false, coarse: false }
    }
}

/// The rows of one block, six numbers each, one below the other.
struct Stack {
    z: DMatrix<f64>,
    x: DMatrix<f64>,
    r: DVector<f64>,
}

impl Stack {
    fn new(
        problem: &Problem<'_>,
        kept: &Kept<'_>,
        candidates: &[Candidate],
        rows: &[usize],
        k: usize,
    ) -> Self {
        let all: usize = candidates.iter().map(|c| c.size).sum();
        let mut stack = Self {
            z: DMatrix::zeros(6 * rows.len(), k),
            x: DMatrix::zeros(6 * rows.len(), all),
            r: DVector::zeros(6 * rows.len()),
        };
        for (index, &row) in rows.iter().enumerate() {
            let (z, x, r) = kept.row(problem, candidates, row, k);
            stack.z.rows_mut(6 * index, 6).copy_from(&z);
            stack.x.rows_mut(6 * index, 6).copy_from(&x);
            stack.r.rows_mut(6 * index, 6).copy_from(&r);
        }
        stack
    }

    /// Adds the products of some components, weighted.
    fn add_to(&self, sum: &mut Products, of: &[usize], weights: &Vector6<f64>, at: &[usize]) {
        let rows: Vec<usize> =
            (0..self.r.len() / 6).flat_map(|row| of.iter().map(move |c| 6 * row + c)).collect();
        let scale = DVector::from_fn(rows.len(), |i, _| weights[rows[i] % 6]);
        let pick = |m: &DMatrix<f64>| {
            let mut picked = m.select_rows(&rows);
            picked.column_iter_mut().for_each(|mut c| c.component_mul_assign(&scale));
            picked
        };
        let r = self.r.select_rows(&rows).component_mul(&scale);
        sum.add_rows(&pick(&self.z), &pick(&self.x), &r, at);
    }
}

impl<'c> Screen<'c> {
    pub(crate) fn new(
        problem: &Problem<'_>,
        folds: &Folds,
        kept: &Kept<'_>,
        candidates: &'c [Candidate],
        weights: &Vector6<f64>,
    ) -> Self {
        let sizes: Vec<usize> = candidates.iter().map(|c| c.size).collect();
        let at: Vec<usize> = sizes
            .iter()
            .scan(0, |next, size| {
                let here = *next;
                *next += size;
                Some(here)
            })
            .collect();
        let k = kept.columns(problem);
        let first = if problem.measures_position() { 0 } else { 3 };
        let main: Vec<usize> =
            problem.measured.iter().copied().filter(|c| *c < first + 3 && *c >= first).collect();
        let of_block = match kept.coarse {
            true => folds.rows_of_folds(problem.data),
            false => folds.rows_of_blocks(problem.data),
        };
        let unit = Vector6::repeat(1.0);
        let parts: Vec<(Products, Products)> = of_block
            .par_iter()
            .map(|rows| {
                let stack = Stack::new(problem, kept, candidates, rows, k);
                let mut white = Products::zeros(k, &sizes);
                stack.add_to(&mut white, &problem.measured, weights, &at);
                let mut plain = Products::zeros(k, if kept.plain { &sizes } else { &[] });
                if kept.plain {
                    stack.add_to(&mut plain, &main, &unit, &at);
                }
                (white, plain)
            })
            .collect();
        let (mut blocks, plains): (Vec<_>, Vec<_>) = parts.into_iter().unzip();
        let mut total = Products::zeros(k, &sizes);
        blocks.iter().for_each(|b| total.add(b));
        let basis = Basis::new(&total.zz);
        blocks.par_iter_mut().for_each(|b| b.turned(&basis.t));
        total.turned(&basis.t);
        let sum = |of: &[Products], k: usize, turn: bool| -> Vec<Products> {
            let sizes: &[usize] = if turn && !kept.plain { &[] } else { &sizes };
            let mut sums = vec![Products::zeros(k, sizes); folds.count];
            for (block, products) in of.iter().enumerate() {
                let fold = if kept.coarse { block } else { folds.of_block[block] };
                sums[fold].add(products);
            }
            if turn {
                sums.iter_mut().for_each(|s| s.turned(&basis.t));
            }
            sums
        };
        let plain = sum(&plains, k, true);
        let folds = sum(&blocks, basis.rank(), false);
        Self { candidates, at, blocks, total, folds, plain, has_plain: kept.plain, basis }
    }

    /// Columns of a candidate in the products.
    pub(crate) fn range(&self, candidate: usize) -> std::ops::Range<usize> {
        let from = self.at[candidate];
        from..from + self.candidates[candidate].size
    }

    /// Sum of squares left without any candidate.
    pub(crate) fn left(&self) -> f64 {
        self.total.rr - self.total.zr.norm_squared()
    }
}

impl Kept<'_> {
    /// For each parameter of the model whether it is kept.
    fn is_kept(&self, problem: &Problem<'_>) -> Vec<bool> {
        let mut kept = vec![true; Model::nuisances(problem)];
        for (index, found) in self.fit.model.found.iter().enumerate() {
            let is = !self.without.contains(&index);
            kept.extend(std::iter::repeat_n(is, found.values.len()));
        }
        kept
    }

    fn columns(&self, problem: &Problem<'_>) -> usize {
        let kept = self.is_kept(problem).into_iter().filter(|k| *k).count();
        kept + self.along.iter().map(|c| c.size).sum::<usize>()
    }

    /// Blocks of one row in plain units, 6×k and 6×all, and what is left of the gap with the effects
    /// that are taken out given back.
    pub(crate) fn row(
        &self,
        problem: &Problem<'_>,
        candidates: &[Candidate],
        row: usize,
        k: usize,
    ) -> (Matrix6xX<f64>, Matrix6xX<f64>, Vector6<f64>) {
        let (model, sims) = (&self.fit.model, &self.fit.predicted.sims);
        let is_kept = self.is_kept(problem);
        let fitted = is_kept.len();
        let along: usize = self.along.iter().map(|c| c.size).sum();
        let all: usize = candidates.iter().map(|c| c.size).sum();
        let both = model.change(problem, sims, row, |scene| {
            let mut block = Matrix6xX::zeros(fitted + along + all);
            block.columns_mut(0, fitted).copy_from(&model.block(problem, row, scene));
            let mut column = fitted;
            for candidate in self.along.iter().chain(candidates) {
                block.columns_mut(column, candidate.size).copy_from(&candidate.block(scene));
                column += candidate.size;
            }
            block
        });
        let mut r = self.fit.predicted.gaps[row];
        let x = both.columns(fitted + along, all).into_owned();
        let values = std::iter::repeat_n(&0.0, Model::nuisances(problem))
            .chain(model.found.iter().flat_map(|f| &f.values));
        let mut z = Matrix6xX::zeros(k);
        let mut column = 0;
        for ((index, kept), value) in is_kept.iter().enumerate().zip(values) {
            if *kept {
                z.set_column(column, &both.column(index));
                column += 1;
            } else {
                r += both.column(index) * *value;
            }
        }
        z.columns_mut(column, along).copy_from(&both.columns(fitted, along));
        (z, x, r)
    }
}
