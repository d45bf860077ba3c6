//! The candidates against a fitted model: some of the gathered columns are the model's, in
//! coordinates in which its normal matrix is the identity, some are the candidates'.

use std::sync::Arc;

use nalgebra::DVector;
use rayon::prelude::*;

use super::candidate::Candidate;
use super::gather::Gathered;
use super::layout::starts;
use super::products::{Choice, Products};
use crate::diagnose::data::{Folds, Problem};
use crate::diagnose::fit::{Basis, Model};

/// The candidates against a fitted model.
pub(crate) struct Screen<'c> {
    pub(crate) candidates: &'c [Candidate],
    /// First number of each candidate.
    pub(crate) at: Vec<usize>,
    pub(crate) basis: Basis,
    /// Of all rows, and of what the model's parameters and each candidate's numbers are held to; `z`
    /// in the coordinates of `basis`.
    pub(crate) total: Products,
    /// The part of `total` that is what the parameters are held to, a measurement of each.
    pub(crate) prior: Products,
    /// The same of each block of poses; none where they were not wanted.
    pub(crate) blocks: Vec<Products>,
    /// The same of each fold.
    pub(crate) folds: Vec<Products>,
    /// Of each fold, what is measured first alone (positions, or rotations without them), in m or
    /// rad.
    pub(crate) plain: Vec<Products>,
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
    pub(crate) fn new(
        problem: &Problem<'_>,
        folds: &Folds,
        gathered: &Gathered,
        model: &Model,
        kept: Kept<'_>,
        candidates: &'c [Candidate],
    ) -> Self {
        let sizes: Vec<usize> = candidates.iter().map(|c| c.size).collect();
        let choice = kept.choice(problem, model, candidates);
        let mut prior = held(problem, model, &choice, &sizes);
        if !kept.free {
            hold(&mut prior, candidates);
        }
        let mut total = gathered.total.chosen(&choice);
        total.add(&prior);
        let basis = Basis::new(&total.zz);
        total.turned(&basis.t);
        prior.turned(&basis.t);
        let turned = |of: &[Products]| -> Vec<Products> {
            let each = of.par_iter().map(|products| {
                let mut chosen = products.chosen(&choice);
                chosen.turned(&basis.t);
                chosen
            });
            each.collect()
        };
        let (mut blocks, mut of_folds, mut plain) = (Vec::new(), Vec::new(), Vec::new());
        if !kept.whole {
            blocks = turned(&gathered.blocks);
            plain = turned(&gathered.plain);
            of_folds = vec![Products::zeros(basis.rank(), &sizes); folds.count];
            for (block, products) in blocks.iter().enumerate() {
                of_folds[folds.of_block[block]].add(products);
            }
        }
        let at = starts(&sizes);
        Self { candidates, at, basis, total, prior, blocks, folds: of_folds, plain }
    }

    /// Columns of a candidate in the products.
    pub(crate) fn range(&self, candidate: usize) -> std::ops::Range<usize> {
        let from = self.at[candidate];
        from..from + self.candidates[candidate].size
    }

    /// Sum of squares left without any candidate, and what it costs to hold the parameters.
    pub(crate) fn left(&self) -> f64 {
        self.total.rr - self.total.zr.norm_squared()
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
    products
}

/// Adds the same of the candidates' numbers.
fn hold(products: &mut Products, candidates: &[Candidate]) {
    for (own, candidate) in Arc::make_mut(&mut products.xx).iter_mut().zip(candidates) {
        let squares = candidate.held.iter().map(|held| held * held);
        own.set_diagonal(&DVector::from_iterator(candidate.size, squares));
    }
}
