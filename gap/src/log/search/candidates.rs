//! What could be added to a model of a log.

use nalgebra::DVector;

use super::blocks::Blocks;
use super::dictionary::Entry;
use super::explained::Explained;
use super::fit::Term;
use super::normal_equations::Sums;
use super::{LOOSE, Search};
use crate::infer::{self, Answer, Basis, Columns, Observations, Products, Screen, Usual};
use crate::parallel;

/// What could be added to a model.
pub struct Asked {
    /// Squares that the model leaves of the blocks, held out, in the sizes.
    pub left: f64,
    /// All that were asked.
    pub candidates: Vec<Candidate>,
}

/// A term that could be added.
pub struct Candidate {
    /// With the values it would have.
    pub term: Term,
    /// What it says.
    pub answer: Answer,
    /// Whether it says anything beside the model.
    pub seen: bool,
    /// By how much it makes the squares smaller that are fitted.
    pub drop: f64,
}

/// An entry of the dictionary as a candidate.
pub struct Linear<'s> {
    /// Its effect at a place.
    pub offer: usize,
    /// About which values.
    pub entry: usize,
    of: &'s Entry,
    usual: Usual,
}

impl Columns for Linear<'_> {
    fn usual(&self) -> &Usual {
        &self.usual
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
                let held = effect.parameters().iter().map(|p| match of.done {
                    None if p.usual.is_finite() => 1.0 / (LOOSE * p.usual),
                    _ => 0.0,
                });
                let held = held.chain(std::iter::repeat(0.0)).take(least.len()).collect();
                Linear { offer, entry, of, usual: Usual { least, held, multiplicity } }
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
        let asked = self.asked_by_block(now, divided, &all);
        let mut from = 0;
        let of_offer = |entries: &[Linear<'_>]| {
            let own = from..from + entries.len();
            from = own.end;
            own
        };
        let ranges: Vec<_> = all.chunk_by(|a, b| a.offer == b.offer).map(of_offer).collect();
        // Of the entries of an offer the best.
        let best = |range: &core::ops::Range<usize>| {
            let ranked = asked.ranked.iter().find(|one| range.contains(&one.candidate));
            let (at, score, answer) = match ranked {
                Some(one) => (one.candidate, one.score.clone(), asked.answer(one)),
                None => (range.start, asked.screen.score(range.start), asked.undecided()),
            };
            let term = self.term(&all[at], &score.values);
            Candidate { term, answer, seen: score.rank > 0, drop: score.drop }
        };
        Asked { left: asked.before.white, candidates: parallel::each(&ranges, &best) }
    }

    /// The questions of some candidates beside a fit.
    pub(super) fn asked_by_block<'c>(
        &self,
        now: &Explained,
        divided: (&Blocks, &Sums),
        candidates: &'c [Linear<'s>],
    ) -> infer::Asked<'c, Linear<'s>> {
        let screen = self.screen_of(now, Some(divided), candidates);
        infer::Asked::new(screen, self.scale(now), self.seed)
    }
}
