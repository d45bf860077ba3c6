//! The candidates against a model of a campaign: some of the gathered columns are the model's, each
//! parameter and each candidate's number held to what is usual of it.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::candidate::Candidate;
use super::gather::Gathered;
use crate::diagnose::data::{Folds, Problem};
use crate::diagnose::fit::Model;
use crate::infer::{self, Basis, Choice, Columns, Products, Score, principal};

/// Rounds in which a variance and what is left at it settle: each is nearer by the part of the
/// numbers that are hardly decided.
const ROUNDS: usize = 6;

/// The candidates against a fitted model.
pub(crate) type Screen<'c> = infer::Screen<'c, Candidate>;

impl Columns for Candidate {
    fn least(&self) -> &[f64] {
        &self.least
    }
}

/// What the model keeps fitted while candidates are screened.
#[derive(Clone, Copy, Default)]
pub(crate) struct Kept<'k> {
    /// Effects of the model that are taken out, so that others may stand in for them; ascending.
    pub(crate) without: &'k [usize],
    /// How many of the further columns that were gathered are fitted along.
    pub(crate) along: usize,
    /// Whether only sums over all rows are wanted: where nothing is held out, no signs are flipped
    /// and no halves drawn.
    pub(crate) whole: bool,
    /// Whether the candidates' numbers are held to nothing: where it is asked what the data show.
    pub(crate) free: bool,
}

impl Kept<'_> {
    /// Which columns of `gathered` stay, for the first candidates of those that were gathered.
    fn choice(&self, problem: &Problem<'_>, model: &Model, candidates: &[Candidate]) -> Choice {
        let mut kept: Vec<usize> = (0..Model::nuisances(problem)).collect();
        let (mut back, mut values) = (Vec::new(), Vec::new());
        let mut column = kept.len();
        for (index, found) in model.found.iter().enumerate() {
            let columns = column..column + found.values.len();
            column = columns.end;
            if self.without.contains(&index) {
                back.extend(columns);
                values.extend(&found.values);
            } else {
                kept.extend(columns);
            }
        }
        kept.extend(column..column + self.along);
        let numbers = candidates.iter().map(|c| c.size).sum();
        let values = DVector::from_vec(values);
        Choice { kept, back, values, candidates: candidates.len(), numbers }
    }
}

impl<'c> Screen<'c> {
    /// `candidates` are the first of those that were gathered.
    pub(crate) fn of(
        problem: &Problem<'_>,
        folds: &Folds,
        gathered: &Gathered,
        model: &Model,
        kept: Kept<'_>,
        candidates: &'c [Candidate],
    ) -> Self {
        let choice = kept.choice(problem, model, candidates);
        let sizes: Vec<usize> = candidates.iter().map(|c| c.size).collect();
        let mut prior = held(problem, model, &choice, &sizes);
        if !kept.free {
            hold(&mut prior, candidates);
        }
        let mut total = gathered.total.chosen(&choice);
        total.add(&prior);
        let basis = Basis::new(&total.zz);
        let screen = Self::new(candidates, basis, total, prior);
        if kept.whole {
            return screen;
        }
        let chosen = |of: &[Products]| -> Vec<Products> {
            of.par_iter().map(|p| p.chosen(&choice)).collect()
        };
        let (blocks, plain) = (chosen(&gathered.blocks), chosen(&gathered.plain));
        screen.by_block(blocks, plain, &folds.of_block, folds.count)
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
}

/// The products of a measurement of each parameter that stays, as 0 with the standard deviation to
/// which it is held, beside candidates of some sizes.
fn held(problem: &Problem<'_>, model: &Model, choice: &Choice, sizes: &[usize]) -> Products {
    let (held, values) = (model.held(problem), model.values(problem));
    let mut products = Products::zeros(choice.kept.len(), sizes);
    // Columns gathered along are free.
    for (at, &column) in choice.kept.iter().enumerate().filter(|(_, c)| **c < held.len()) {
        let weight = held[column].powi(2);
        products.zz[(at, at)] = weight;
        products.zr[at] = -weight * values[column];
        products.rr += weight * values[column].powi(2);
    }
    // The constants of the bench are kept, and before all else.
    for bond in model.bonds(problem) {
        bond.add(&mut products.zz, &mut products.zr);
        products.rr += bond.square();
    }
    products
}

/// Adds the same of the candidates' numbers.
fn hold(products: &mut Products, candidates: &[Candidate]) {
    for (own, candidate) in Arc::make_mut(&mut products.xx).iter_mut().zip(candidates) {
        let squares = candidate.held.iter().map(|held| held * held);
        own.set_diagonal(&DVector::from_iterator(candidate.size, squares));
    }
}
