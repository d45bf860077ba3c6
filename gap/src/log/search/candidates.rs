//! What could be added to a model: its held-out squares, and how likely chance is to do as well.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::blocks::Blocks;
use super::dictionary::{Dictionary, Entry};
use super::fit::{Fitted, Term, weights};
use super::normal_equations::Sums;
use crate::infer::{Basis, Columns, Products, Screen, Signs, unit};

/// So many of the candidates that take most of what is left are held out; the others take less.
const HELD_OUT: usize = 24;

/// What could be added to a model.
pub struct Asked {
    /// Squares that the model leaves of each block, held out, in the sizes.
    pub squares: Vec<f64>,
    /// All that were asked.
    pub candidates: Vec<Candidate>,
    /// Of each the chance that something unrelated does as well.
    pub p_values: Vec<f64>,
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
}

/// An entry of the dictionary as a candidate.
struct Linear<'s> {
    offer: usize,
    entry: usize,
    of: &'s Entry,
    least: Vec<f64>,
}

impl Columns for Linear<'_> {
    fn least(&self) -> &[f64] {
        &self.least
    }

    fn is_linearized(&self) -> bool {
        self.of.done.is_some()
    }
}

impl Asked {
    /// Asks a fit, told in these sizes, for some of the offers, each about the values that do best.
    pub fn of(
        dict: &Dictionary<'_>,
        fit: &Fitted,
        sizes: &[f64],
        (blocks, sums): (&Blocks, &Sums),
        offers: &[usize],
        seed: u64,
    ) -> Asked {
        let linear = |&offer: &usize| {
            let entries = dict.offers[offer].entries.iter().enumerate();
            entries.map(move |(entry, of)| {
                let least = vec![f64::NEG_INFINITY; of.columns.len()];
                Linear { offer, entry, of, least }
            })
        };
        let all: Vec<Linear<'_>> = offers.iter().flat_map(linear).collect();
        let screen = screen(fit, sizes, (blocks, sums), &all);
        let trained = screen.trained();
        let squares = screen.held_out_by_block(&trained, None);
        let mut from = 0;
        // Of the entries of an offer the best, by its number.
        let of_offer = |entries: &[Linear<'_>]| {
            let own = from..from + entries.len();
            from = own.end;
            own
        };
        let ranges: Vec<_> = all.chunk_by(|a, b| a.offer == b.offer).map(of_offer).collect();
        let best = |range: &core::ops::Range<usize>| {
            let scores = range.clone().map(|c| (c, screen.score(c)));
            let best = scores.reduce(|a, b| if b.1.drop > a.1.drop { b } else { a });
            let (c, score) = best.expect("an offer has entries");
            let mut term = dict.term(all[c].offer, all[c].entry);
            let from = term.values.iter().map(|at| if all[c].is_linearized() { *at } else { 0.0 });
            term.values = from.zip(score.values.iter()).map(|(from, by)| from + by).collect();
            let (seen, gain) = (score.rank > 0, score.drop);
            (c, Candidate { term, squares: squares.clone(), seen, gain })
        };
        let mut candidates: Vec<(usize, Candidate)> = ranges.par_iter().map(best).collect();
        let mut gains: Vec<f64> = candidates.iter().map(|(_, c)| c.takes()).collect();
        gains.sort_by(|a, b| b.total_cmp(a));
        let least = gains.get(HELD_OUT).copied().unwrap_or(f64::NEG_INFINITY);
        candidates.par_iter_mut().filter(|(_, c)| c.takes() > least).for_each(|(c, candidate)| {
            candidate.squares = screen.held_out_by_block(&trained, Some(*c));
        });
        let p_values = p_values(&screen, &ranges, seed);
        let candidates = candidates.into_iter().map(|(_, candidate)| candidate).collect();
        Asked { squares, candidates, p_values }
    }
}

/// Candidates beside a fit.
fn screen<'c, 's>(
    fit: &Fitted,
    sizes: &[f64],
    (blocks, sums): (&Blocks, &Sums),
    candidates: &'c [Linear<'s>],
) -> Screen<'c, Linear<'s>> {
    let entries: Vec<&Entry> = candidates.iter().map(|candidate| candidate.of).collect();
    let of_blocks = sums.linearized(&fit.bordered().0, &entries, &weights(sizes));
    let widths: Vec<usize> = candidates.iter().map(Columns::columns).collect();
    let mut total = Products::zeros(fit.columns.len(), &widths);
    let prior = total.clone();
    of_blocks.iter().for_each(|block| total.add(block));
    let basis = Basis::ordered(&total.zz);
    let screen = Screen::new(candidates, basis, total, prior);
    screen.by_block(of_blocks, Vec::new(), &blocks.fold, blocks.folds)
}

/// Of each offer, whose entries stand in a range, the chance that something unrelated looks as good among as
/// many. Each candidate's blocks are told so that their squares add up to one.
fn p_values(
    screen: &Screen<'_, Linear<'_>>,
    ranges: &[core::ops::Range<usize>],
    seed: u64,
) -> Vec<f64> {
    let left = screen.left_by_block();
    let shares: Vec<DMatrix<f64>> = (0..screen.candidates.len())
        .into_par_iter()
        .map(|c| unit(&screen.shares(c, &left)))
        .collect();
    let signs = Signs::new(screen.blocks.len(), seed);
    let highest = signs.largest(&shares.iter().collect::<Vec<_>>());
    let found = |range: &core::ops::Range<usize>| {
        let own = shares[range.clone()].iter().map(|shares| shares.column_sum().norm_squared());
        signs.p_value(&highest, own.fold(0.0, f64::max))
    };
    ranges.iter().map(found).collect()
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
