//! What could be added to a model: its evidence, its held-out squares, and how likely chance is to do as well.

use nalgebra::{DMatrix, DVector};

use super::blocks::Blocks;
use super::dictionary::Entry;
use super::explained::Explained;
use super::fit::Term;
use super::normal_equations::Sums;
use super::{LOOSE, Search};
use crate::infer::{Basis, Columns, Observations, Products, Ranked, Screen, Signs, unit};
use crate::parallel;

/// So many of the candidates that have most evidence are held out; the others have less.
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
    pub drop: f64,
    /// Twice the logarithm of its odds.
    pub gain: f64,
}

/// An entry of the dictionary as a candidate.
pub struct Linear<'s> {
    /// Its effect at a place.
    pub offer: usize,
    /// About which values.
    pub entry: usize,
    of: &'s Entry,
    least: Vec<f64>,
    held: Vec<f64>,
    multiplicity: usize,
}

impl Columns for Linear<'_> {
    fn least(&self) -> &[f64] {
        &self.least
    }

    fn held(&self) -> &[f64] {
        &self.held
    }

    fn multiplicity(&self) -> usize {
        self.multiplicity
    }

    fn is_linearized(&self) -> bool {
        self.of.done.is_some()
    }
}

impl<'s> Search<'s, '_> {
    /// The entries of some offers.
    pub(super) fn linear(&self, offers: &[usize]) -> Vec<Linear<'s>> {
        let dict = self.dict;
        let of_offer = |&offer: &usize| {
            let (effect, entries) = (dict.offers[offer].effect, &dict.offers[offer].entries);
            let is_same = |other: &&super::dictionary::Offer| {
                other.effect.identifier() == effect.identifier()
            };
            let all = dict.offers.iter().filter(is_same);
            let multiplicity = all.map(|other| other.entries.len()).sum();
            let entries = entries.iter().enumerate();
            entries.map(move |(entry, of)| {
                let least = vec![f64::NEG_INFINITY; of.columns.len()];
                // About other values than 0 what is usual says nothing of the step to the best.
                let usual = effect.parameters().iter().map(|p| match of.done {
                    None if p.usual.is_finite() => 1.0 / (LOOSE * p.usual),
                    _ => 0.0,
                });
                let held = usual.chain(std::iter::repeat(0.0)).take(least.len()).collect();
                Linear { offer, entry, of, least, held, multiplicity }
            })
        };
        offers.iter().flat_map(of_offer).collect()
    }

    /// Candidates beside a fit, over all rows or block by block.
    pub(super) fn screen_of<'c>(
        &self,
        now: &Explained,
        divided: Option<(&Blocks, &Sums)>,
        candidates: &'c [Linear<'s>],
    ) -> Screen<'c, Linear<'s>> {
        let entries: Vec<&Entry> = candidates.iter().map(|candidate| candidate.of).collect();
        let sums = divided.map_or(self.dict.whole(), |(_, sums)| sums);
        let columns = now.fit.bordered().0;
        let parts = sums.linearized(&columns, &entries, &self.weights(now));
        let widths: Vec<usize> = candidates.iter().map(Columns::columns).collect();
        let mut total = Products::zeros(now.fit.columns.len(), &widths);
        let mut prior = total.clone();
        prior.hold(candidates);
        parts.iter().chain([&prior]).for_each(|part| total.add(part));
        let basis = Basis::ordered(&total.zz);
        let screen = Screen::new(candidates, basis, total, prior);
        match divided {
            Some((blocks, _)) => screen.by_block(parts, Vec::new(), &blocks.fold, blocks.folds),
            None => screen,
        }
    }

    /// A ranked candidate as a term of a model.
    pub(super) fn term(&self, candidate: &Linear<'_>, values: &DVector<f64>) -> Term {
        let mut term = self.dict.term(candidate.offer, candidate.entry);
        let from = term.values.iter().map(|at| if candidate.is_linearized() { *at } else { 0.0 });
        term.values = from.zip(values.iter()).map(|(from, by)| from + by).collect();
        term
    }

    /// Asks a fit for some of the offers, each about the values that do best.
    pub fn asked(&self, now: &Explained, divided: (&Blocks, &Sums), offers: &[usize]) -> Asked {
        let all = self.linear(offers);
        let screen = self.screen_of(now, Some(divided), &all);
        let trained = screen.trained();
        let squares = screen.held_out_by_block(&trained, None);
        let ranked = screen.ranked(self.scale(now));
        let mut from = 0;
        let of_offer = |entries: &[Linear<'_>]| {
            let own = from..from + entries.len();
            from = own.end;
            own
        };
        let ranges: Vec<_> = all.chunk_by(|a, b| a.offer == b.offer).map(of_offer).collect();
        // Of the entries of an offer the best.
        let best = |range: &core::ops::Range<usize>| {
            let ranked = ranked.iter().find(|one| range.contains(&one.candidate));
            let (at, score, gain) = match ranked {
                Some(Ranked { candidate, score, gain, .. }) => (*candidate, score.clone(), *gain),
                None => (range.start, screen.score(range.start), f64::NEG_INFINITY),
            };
            let term = self.term(&all[at], &score.values);
            let (seen, drop) = (score.rank > 0, score.drop);
            (at, Candidate { term, squares: squares.clone(), seen, drop, gain })
        };
        let mut candidates: Vec<(usize, Candidate)> = parallel::each(&ranges, &best);
        let mut gains: Vec<f64> = candidates.iter().map(|(_, c)| c.gain).collect();
        gains.sort_by(|a, b| b.total_cmp(a));
        let least = gains.get(HELD_OUT).copied().unwrap_or(f64::NEG_INFINITY);
        parallel::change(&mut candidates, &|(at, candidate)| {
            if candidate.gain > least {
                candidate.squares = screen.held_out_by_block(&trained, Some(*at));
            }
        });
        let p_values = p_values(&screen, &ranges, self.seed);
        let candidates = candidates.into_iter().map(|(_, candidate)| candidate).collect();
        Asked { squares, candidates, p_values }
    }
}

/// Of each offer, whose entries stand in a range, the chance that something unrelated looks as good among as
/// many. Each candidate's blocks are told so that their squares add up to one.
fn p_values(
    screen: &Screen<'_, Linear<'_>>,
    ranges: &[core::ops::Range<usize>],
    seed: u64,
) -> Vec<f64> {
    let left = screen.left_by_block();
    let own = |c: usize| unit(&screen.shares(c, &left));
    let shares: Vec<DMatrix<f64>> = parallel::map(screen.candidates.len(), &own);
    let signs = Signs::new(screen.blocks.len(), seed);
    let highest = signs.largest(&shares.iter().collect::<Vec<_>>());
    let found = |range: &core::ops::Range<usize>| {
        let own = shares[range.clone()].iter().map(|shares| shares.column_sum().norm_squared());
        signs.p_value(&highest, own.fold(0.0, f64::max))
    };
    ranges.iter().map(found).collect()
}
