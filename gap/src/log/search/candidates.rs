//! What could be added to a model: its held-out squares, and how likely chance is to do as well.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::blocks::Blocks;
use super::fit::{Fitted, Term, weights};
use super::stock::{Entry, Mixed, Stock};
use super::sums::{Solver, Sums, quadratic, sum};
use crate::dice::{Dice, Stream};

/// Random signs; the smallest chance that they tell is one in so many.
const FLIPS: usize = 999;

/// So many candidates are asked at once.
const TOGETHER: usize = 32;

/// So many of the candidates that take most of what is left are held out; the others take less.
const HELD_OUT: usize = 24;

/// A model at its values, with the products of its columns, block by block.
pub struct Ground<'s> {
    stock: &'s Stock<'s>,
    blocks: &'s Blocks,
    sums: &'s Sums,
    weights: Vec<f64>,
    /// The columns, then the left side.
    columns: Vec<Mixed>,
    products: Vec<DMatrix<f64>>,
    /// Over all blocks, then without each fold.
    fits: Vec<Known>,
    /// Squares that are left, held out, of each block.
    pub squares: Vec<f64>,
}

/// The ground's columns alone, over some blocks.
struct Known {
    solver: Solver,
    values: DVector<f64>,
    right: DVector<f64>,
}

/// A term that could be added.
pub struct Candidate {
    /// With the values it would have.
    pub term: Term,
    /// Squares that are left with it, held out, of each block; without it where it was not held out.
    pub squares: Vec<f64>,
    /// Whether it says anything beside the model.
    pub seen: bool,
    /// By how much it makes the squares smaller that are fitted.
    gain: f64,
    /// How the blocks pull at its numbers, each told so that their squares add up to one; of each entry.
    scores: Vec<DMatrix<f64>>,
}

/// A candidate's columns, and what it does where it is linearised, beside the ground's.
struct Beside {
    count: usize,
    bends: bool,
    /// With the ground's columns and left side, of each block.
    cross: Vec<DMatrix<f64>>,
    /// With each other.
    own: Vec<DMatrix<f64>>,
}

/// What a candidate is beside the ground, over some blocks.
struct Fit {
    /// Of the candidate's numbers, and 1 of what it does where it is.
    values: DVector<f64>,
    /// By how much the ground's values change.
    change: DVector<f64>,
    gain: f64,
    seen: bool,
}

impl Known {
    fn of(products: &DMatrix<f64>) -> Known {
        let n = products.nrows() - 1;
        let solver = Solver::of(&products.view((0, 0), (n, n)).into_owned());
        let right = products.view((0, n), (n, 1)).into_owned();
        let values = solver.solve(&right).column(0).into_owned();
        Known { solver, values, right: right.column(0).into_owned() }
    }

    /// A candidate of which these are the products with the ground's columns and left side, and with
    /// itself, over the same blocks.
    fn with(&self, beside: &Beside, cross: &DMatrix<f64>, own: &DMatrix<f64>) -> Fit {
        let (n, q) = (self.values.len(), beside.count);
        let known = cross.rows(0, n).into_owned();
        let along = self.solver.solve(&known);
        let apart = own - known.tr_mul(&along);
        let right = cross.row(n).transpose() - along.tr_mul(&self.right);
        let mut wanted: DVector<f64> = right.rows(0, q).into_owned();
        if beside.bends {
            wanted -= apart.view((0, q), (q, 1)).column(0);
        }
        // Beside the ground: what is left of a column, of what it was.
        let told = Solver::apart(&apart.view((0, 0), (q, q)).into_owned(), &own.diagonal());
        let solver = Solver::of(&told);
        let found = solver.solve(&DMatrix::from_columns(std::slice::from_ref(&wanted)));
        let found = found.column(0).into_owned();
        let mut gain = found.dot(&wanted);
        if beside.bends {
            gain += 2.0 * right[q] - apart[(q, q)];
        }
        let values = if beside.bends { found.push(1.0) } else { found };
        Fit { change: &along * &values, values, gain, seen: solver.seen.contains(&true) }
    }
}

impl<'s> Ground<'s> {
    /// Of a fit, told in these sizes.
    pub fn of(
        stock: &'s Stock<'s>,
        fit: &Fitted,
        sizes: &[f64],
        blocks: &'s Blocks,
        sums: &'s Sums,
    ) -> Self {
        let (columns, _) = fit.bordered();
        let weights = weights(sizes);
        let products = sums.squares(&columns, &weights);
        let fits: Vec<Known> = parts(&products, blocks).iter().map(Known::of).collect();
        let squares = products.iter().zip(&blocks.fold).map(|(product, fold)| {
            let values = fits.get(fold + 1).map_or(&fits[0].values, |fit| &fit.values);
            quadratic(product, &values.clone().push(-1.0))
        });
        let squares = squares.collect();
        Ground { stock, blocks, sums, weights, columns, products, fits, squares }
    }

    /// Terms that the model lacks, each about the values that do best.
    pub fn candidates(&self, offers: &[usize]) -> Vec<Candidate> {
        let mut all: Vec<(Candidate, Beside)> =
            offers.par_iter().map(|offer| self.candidate(*offer)).collect();
        let mut gains: Vec<f64> = all.iter().map(|(c, _)| c.takes()).collect();
        gains.sort_by(|a, b| b.total_cmp(a));
        let least = gains.get(HELD_OUT).copied().unwrap_or(f64::NEG_INFINITY);
        all.par_iter_mut().filter(|(c, _)| c.takes() > least).for_each(|(c, beside)| {
            c.squares = self.held_out(beside);
        });
        all.into_iter().map(|(candidate, _)| candidate).collect()
    }

    fn candidate(&self, offer: usize) -> (Candidate, Beside) {
        let mut best: Option<(Candidate, Beside)> = None;
        let mut scores = Vec::new();
        for (k, entry) in self.stock.offers[offer].entries.iter().enumerate() {
            let beside = self.beside(entry);
            scores.push(self.scores(&beside));
            let (cross, own) = (total(&beside.cross), total(&beside.own));
            let fit = self.fits[0].with(&beside, &cross, &own);
            let better = best.as_ref().is_none_or(|(b, _)| fit.gain > b.gain);
            if better {
                let mut term = self.stock.term(offer, k);
                let from = entry.at.iter().map(|at| if beside.bends { *at } else { 0.0 });
                term.values = from.zip(fit.values.iter()).map(|(from, by)| from + by).collect();
                let squares = self.squares.clone();
                let (seen, gain) = (fit.seen, fit.gain);
                let candidate = Candidate { term, squares, seen, gain, scores: Vec::new() };
                best = Some((candidate, beside));
            }
        }
        let (mut candidate, beside) = best.expect("an offer has entries");
        candidate.scores = scores;
        (candidate, beside)
    }

    fn beside(&self, entry: &Entry) -> Beside {
        let all: Vec<Mixed> = entry.columns.iter().chain(&entry.done).cloned().collect();
        Beside {
            count: entry.columns.len(),
            bends: entry.done.is_some(),
            cross: self.sums.products(&self.columns, &all, &self.weights),
            own: self.sums.squares(&all, &self.weights),
        }
    }

    /// Squares that are left in each block by the fit to all folds but its own.
    fn held_out(&self, beside: &Beside) -> Vec<f64> {
        let (cross, own) = (parts(&beside.cross, self.blocks), parts(&beside.own, self.blocks));
        let of = |k: usize| self.fits[k].with(beside, &cross[k], &own[k]);
        let fits: Vec<Fit> = (0..self.fits.len()).map(of).collect();
        let n = self.columns.len() - 1;
        let square = |b: usize| {
            let fold = (self.blocks.fold[b] + 1).min(fits.len() - 1);
            let (fit, ground) = (&fits[fold], &self.fits[fold].values);
            // The left side less the ground's columns with the values that they have beside it.
            let mut values = ground - &fit.change;
            values = values.push(-1.0);
            let cross = beside.cross[b].tr_mul(&values);
            let left = quadratic(&self.products[b], &values);
            debug_assert_eq!(n + 1, values.len());
            (left + 2.0 * fit.values.dot(&cross) + fit.values.dot(&(&beside.own[b] * &fit.values)))
                .max(0.0)
        };
        (0..self.products.len()).map(square).collect()
    }

    /// What each block says for a candidate's numbers, beside all that the model does; one a row.
    fn scores(&self, beside: &Beside) -> DMatrix<f64> {
        let (known, q) = (&self.fits[0], beside.count);
        let n = known.values.len();
        let cross = total(&beside.cross);
        let cross = cross.view((0, 0), (n, q)).into_owned();
        let own = total(&beside.own);
        let along = known.solver.solve(&cross);
        let apart = own.view((0, 0), (q, q)) - cross.tr_mul(&along);
        let root = Solver::inverse_root(&apart, &own.diagonal());
        let residual = (-&known.values).push(1.0);
        let mut pulls = DMatrix::zeros(self.products.len(), q);
        for (b, (ground, cross)) in self.products.iter().zip(&beside.cross).enumerate() {
            let left = ground.rows(0, n) * &residual;
            let says = cross.columns(0, q).tr_mul(&residual) - along.tr_mul(&left);
            pulls.set_row(b, &(&root * says).transpose());
        }
        let size = pulls.norm();
        if size > 0.0 { pulls / size } else { pulls }
    }

    /// Of each candidate the chance that something unrelated looks as good among as many.
    ///
    /// Under the signs of whole blocks what is left is as likely as it is; the largest of all candidates
    /// under random signs is what each is held against (Westfall & Young 1993; signs by blocks:
    /// Cameron, Gelbach & Miller 2008).
    pub fn chances(&self, candidates: &[Candidate], seed: u64) -> Vec<f64> {
        let mut dice = Dice::new(seed, Stream::Visits);
        let count = self.products.len();
        let signs = DMatrix::from_fn(FLIPS, count, |_, _| dice.sign());
        let own = DMatrix::repeat(1, count, 1.0);
        let found: Vec<f64> =
            candidates.iter().map(|c| largest(core::slice::from_ref(c), &own)[0]).collect();
        let nothing = || DVector::zeros(FLIPS);
        let largest = candidates
            .par_chunks(TOGETHER)
            .map(|some| largest(some, &signs))
            .reduce(nothing, |a, b| a.sup(&b));
        let chance = |found: &f64| {
            // Signs that are all one are the data's own: of few blocks they come often.
            let as_good = largest.iter().filter(|size| **size >= found * (1.0 - 1e-12)).count();
            (1 + as_good) as f64 / (FLIPS + 1) as f64
        };
        found.iter().map(chance).collect()
    }
}

impl Candidate {
    /// What counts as one number: a direction does, however many it is told by.
    pub fn things(&self) -> f64 {
        self.term.effect.things() as f64
    }

    /// What it takes of the squares that are fitted, by each of its numbers.
    pub fn takes(&self) -> f64 {
        self.gain / self.things()
    }
}

/// By how much the blocks of that candidate pull together that does most, under signs, one a row: 1 on average where
/// they do not.
fn largest(candidates: &[Candidate], signs: &DMatrix<f64>) -> DVector<f64> {
    let scores: Vec<&DMatrix<f64>> = candidates.iter().flat_map(|c| &c.scores).collect();
    let count = scores.iter().map(|scores| scores.ncols()).sum();
    // Side by side: a product of many columns is blocked, many of a few are not.
    let all = scores.iter().flat_map(|scores| scores.iter().copied());
    let pulls = signs * DMatrix::from_iterator(signs.ncols(), count, all);
    let mut largest = DVector::zeros(signs.nrows());
    let mut from = 0;
    for scores in scores {
        let own = pulls.columns(from, scores.ncols());
        from += scores.ncols();
        for (size, row) in largest.iter_mut().zip(own.row_iter()) {
            *size = f64::max(*size, row.norm_squared());
        }
    }
    largest
}

fn total(products: &[DMatrix<f64>]) -> DMatrix<f64> {
    sum(products.iter()).unwrap_or_else(|| DMatrix::zeros(0, 0))
}

/// The sum of all, then that without each fold.
fn parts(products: &[DMatrix<f64>], blocks: &Blocks) -> Vec<DMatrix<f64>> {
    let whole = total(products);
    let without = |fold: usize| {
        let own = products.iter().zip(&blocks.fold).filter(|(_, f)| **f == fold).map(|(p, _)| p);
        sum(own).map_or_else(|| whole.clone(), |out| &whole - out)
    };
    let without: Vec<DMatrix<f64>> = (0..blocks.folds).map(without).collect();
    [whole].into_iter().chain(without).collect()
}

/// Values of least squares without each fold, of products by block.
pub fn without_each(products: &[DMatrix<f64>], blocks: &Blocks) -> Vec<DVector<f64>> {
    parts(products, blocks).iter().skip(1).map(|part| Known::of(part).values).collect()
}
