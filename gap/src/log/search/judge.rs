//! What the findings are worth: intervals, what is left on unseen time, what else would do.

use nalgebra::DMatrix;
use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::blocks::Blocks;
use super::candidates::without_each;
use super::fit::{Fitted, Problem, Term, residual};
use super::sums::{Rows, Solver, Stack, sum};
use super::{Asked, CHANCE, Round, State, is_worse};
use crate::log::effects::{LogEffect, Spot};
use crate::log::scene::Column;

/// Rivals of one finding that are told.
const RIVALS: usize = 5;

/// One finding beside all others.
pub struct Judged {
    /// With its values.
    pub term: Term,
    /// The chance that something unrelated does as well.
    pub chance: f64,
    /// What would do instead, with what it leaves for each that the finding leaves; the best first.
    pub rivals: Vec<(Term, f64)>,
}

/// What a log says at the end.
pub struct Verdict {
    /// In the order in which they were added.
    pub findings: Vec<Judged>,
    /// The model.
    pub fit: Fitted,
    /// What it leaves and asks.
    pub state: State,
    /// Correlation time of what it leaves in each joint, s.
    pub correlation: Vec<f64>,
    /// How the time is divided.
    pub blocks: Blocks,
}

/// Judges each term beside the others, and drops those that are not told from accident, or have become
/// what no such thing is, one after the other.
pub fn judged(
    problem: &Problem<'_>,
    last: &Round,
    wanted: &[(&'static dyn LogEffect, Spot)],
    seed: u64,
) -> Verdict {
    let (mut fit, mut state) = (last.fit.clone(), last.state.clone());
    loop {
        // Were a finding unrelated, what is left would be left without it too: so long are the blocks.
        let correlation = problem.correlation(&fit.residual);
        let longest = correlation.iter().copied().fold(0.0, f64::max);
        let blocks = Blocks::of(problem.scene.signals, longest);
        let without = |k: usize| -> Judged {
            let mut others = fit.terms.clone();
            let term = others.remove(k);
            let near = |(effect, spot): &&(&'static dyn LogEffect, Spot)| {
                let itself = effect.identifier() == term.effect.identifier() && *spot == term.spot;
                itself || spot.meets(term.spot)
            };
            let asked: Vec<_> = wanted.iter().filter(near).copied().collect();
            let lacks = problem.fit(&others, &state.sizes, &state.loads);
            Asked::of(problem, &lacks, &state, &blocks, &asked, seed).judge(term)
        };
        let all: Vec<Judged> = (0..fit.terms.len()).into_par_iter().map(without).collect();
        let wrong = |j: &Judged| !j.term.effect.may_be(&j.term.values);
        let worst = (0..all.len()).max_by(|a, b| {
            let doubt = |k: &usize| (wrong(&all[*k]), all[*k].chance);
            let (a, b) = (doubt(a), doubt(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        });
        match worst.filter(|k| wrong(&all[*k]) || all[*k].chance > CHANCE) {
            None => return Verdict { findings: all, fit, state, correlation, blocks },
            Some(worst) => {
                let mut terms = fit.terms.clone();
                let gone = terms.remove(worst);
                // What stood beside it alone goes with it.
                terms.retain(|t| {
                    t.spot != gone.spot || t.effect.beside() != Some(gone.effect.identifier())
                });
                fit = problem.fit(&terms, &state.sizes, &state.loads);
                state = State::of(problem, &fit);
            }
        }
    }
}

impl Asked {
    /// The finding that the model lacks.
    fn judge(&self, term: Term) -> Judged {
        let same =
            |t: &Term| t.effect.identifier() == term.effect.identifier() && t.spot == term.spot;
        let Some(own) = self.candidates.iter().position(|c| same(&c.term)) else {
            // It adds to what has gone: nothing speaks for it.
            return Judged { term, chance: 1.0, rivals: Vec::new() };
        };
        let left = |k: usize| self.candidates[k].squares.iter().sum::<f64>();
        let best = &self.candidates[own].squares;
        let mut rivals: Vec<usize> = (0..self.candidates.len())
            .filter(|k| {
                let rival = &self.candidates[*k];
                *k != own
                    && self.chances[*k] <= CHANCE
                    && rival.term.effect.may_be(&rival.term.values)
                    && !is_worse(&rival.squares, best)
            })
            .collect();
        rivals.sort_by(|a, b| left(*a).total_cmp(&left(*b)));
        rivals.truncate(RIVALS);
        let ratio = |k: usize| (left(k) / left(own)).sqrt();
        let rivals = rivals.into_iter().map(|k| (self.candidates[k].term.clone(), ratio(k)));
        Judged { chance: self.chances[own], rivals: rivals.collect(), term }
    }
}

/// What a fit leaves of rows that its values have not seen, and 95 % intervals of its values.
pub struct Unseen {
    /// Of each joint; of rows that no block has, NaN.
    pub residual: Vec<Vec<f64>>,
    /// Half the width of each column's interval.
    pub half_widths: Vec<f64>,
}

impl Unseen {
    /// Of a fit told in these sizes.
    pub fn of(problem: &Problem<'_>, fit: &Fitted, sizes: &[f64], blocks: &Blocks) -> Unseen {
        let rows = Rows { counts: problem.counts.clone(), sizes: sizes.to_vec() };
        let all: Vec<&Column> = fit.columns.iter().chain([&fit.left]).collect();
        let stack = Stack::of(&all, &rows);
        let products = stack.products(&stack, blocks);
        let mut unseen: Vec<Vec<f64>> =
            problem.target.iter().map(|rows| vec![f64::NAN; rows.len()]).collect();
        for (fold, values) in without_each(&products, blocks).into_iter().enumerate() {
            let left = residual(&fit.columns, &fit.left, &values);
            let own = blocks.rows.iter().zip(&blocks.fold).filter(|(_, f)| **f == fold);
            for range in own.map(|(range, _)| range.clone()) {
                for ((to, from), counts) in unseen.iter_mut().zip(&left).zip(&problem.counts) {
                    range.clone().filter(|k| counts[*k]).for_each(|k| to[k] = from[k]);
                }
            }
        }
        Unseen { residual: unseen, half_widths: half_widths(&products, &fit.values) }
    }

    /// Root mean square of each joint's rows that were held out; 0 of a joint that has none.
    pub fn sizes(&self) -> Vec<f64> {
        let size = |rows: &Vec<f64>| {
            let used = rows.iter().filter(|x| x.is_finite());
            let (sum, count) = used.fold((0.0, 0.0), |(sum, n), x| (sum + x * x, n + 1.0));
            if count > 0.0 { f64::sqrt(sum / count) } else { 0.0 }
        };
        self.residual.iter().map(size).collect()
    }
}

/// Blocks as the independent numbers that they are: `A⁻¹ (Σ s_b s_bᵀ) A⁻¹` (Liang & Zeger 1986), with
/// Student's t of as many.
fn half_widths(products: &[DMatrix<f64>], values: &[f64]) -> Vec<f64> {
    let n = values.len();
    let count = products.len() as f64;
    let Some(whole) = sum(products.iter()) else { return vec![0.0; n] };
    let mut left = values.to_vec();
    left.iter_mut().for_each(|x| *x = -*x);
    left.push(1.0);
    let pulls: Vec<_> = products
        .iter()
        .map(|product| product.rows(0, n) * nalgebra::DVector::from_column_slice(&left))
        .collect();
    let solver = Solver::of(&whole.view((0, 0), (n, n)).into_owned());
    let solved = solver.solve(&DMatrix::from_columns(&pulls));
    let t = StudentsT::new(0.0, 1.0, (count - 1.0).max(1.0));
    let t = t.map_or(f64::INFINITY, |t| t.inverse_cdf(0.975)) * (count / (count - 1.0)).sqrt();
    (0..n).map(|k| t * solved.row(k).norm()).collect()
}
