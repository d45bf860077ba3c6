//! The candidates against a model of a campaign: some of the gathered columns are the model's, each
//! parameter and each candidate's number held to what is usual of it.

use std::sync::Arc;

use nalgebra::DVector;

use super::candidate::Candidate;
use super::gather::Gathered;
use crate::diagnose::data::{Folds, Problem};
use crate::diagnose::fit::{Bond, Model};
use crate::infer::{self, Basis, Choice, Columns, Products, Usual, starts};
use crate::parallel;

/// The candidates against a fitted model.
pub(crate) type Screen<'c> = infer::Screen<'c, Candidate>;

impl Columns for Candidate {
    fn usual(&self) -> &Usual {
        &self.usual
    }

    fn is_tolerated(&self) -> bool {
        self.effect().is_some_and(|(effect, _)| effect.is_tolerated())
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

    /// The candidates beside what stays of `model`; `candidates` are the first of those that were gathered.
    pub(crate) fn screen<'c>(
        &self,
        problem: &Problem<'_>,
        folds: &Folds,
        gathered: &Gathered,
        model: &Model,
        candidates: &'c [Candidate],
    ) -> Screen<'c> {
        let choice = self.choice(problem, model, candidates);
        let sizes: Vec<usize> = candidates.iter().map(|c| c.size).collect();
        let mut prior = held(problem, model, &choice, &sizes);
        if !self.free {
            prior.hold(candidates);
        }
        let candidates_told = if self.free { &[] } else { candidates };
        hold_together(problem, model, &choice, candidates_told, &mut prior);
        let mut total = gathered.total.chosen(&choice);
        total.add(&prior);
        let basis = Basis::new(&total.zz);
        let screen = Screen::new(candidates, basis, total, prior);
        if self.whole {
            return screen;
        }
        let chosen =
            |of: &[Products]| -> Vec<Products> { parallel::each(of, &|p| p.chosen(&choice)) };
        let (blocks, plain) = (chosen(&gathered.blocks), chosen(&gathered.plain));
        screen.by_block(blocks, plain, &folds.of_block, folds.count)
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

/// Adds the products of what is known beside the rows: of parameters that stay, and of candidates that the model lacks.
fn hold_together(
    problem: &Problem<'_>,
    model: &Model,
    choice: &Choice,
    candidates: &[Candidate],
    products: &mut Products,
) {
    let values = model.values(problem).into_iter().enumerate();
    let is_kept = |at: usize| choice.kept.binary_search(&at).is_ok();
    let back: Vec<f64> = values.map(|(at, x)| if is_kept(at) { 0.0 } else { x }).collect();
    let numbers = starts(&candidates.iter().map(|c| c.size).collect::<Vec<_>>());
    for bond in Bond::all(problem, model) {
        let bond = bond.chosen(&choice.kept, &back);
        bond.add(&mut products.zz, &mut products.zr);
        products.rr += bond.square();
        let Some((joint, by)) = bond.spring else { continue };
        let lacking = candidates.iter().enumerate().filter(|(_, c)| c.is_spring_of(joint));
        for (candidate, _) in lacking {
            let number = numbers[candidate];
            bond.columns.iter().for_each(|(at, with)| products.zx[(*at, number)] += by * with);
            products.xr[number] += by * bond.left;
            Arc::make_mut(&mut products.xx)[candidate][(0, 0)] += by * by;
        }
    }
}
