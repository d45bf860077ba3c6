//! Looking for effects in a log: forwards, by evidence, confirmed on held-out blocks of time.
//!
//! Each round fits the model, divides the time by the correlation of what is left, and ranks every effect at every
//! place by its evidence. The best that chance does not explain, by the signs of whole blocks, and that leaves less of
//! the blocks that its fit has not seen is added. What another explains better then is exchanged for it. At the end every
//! finding is asked again beside all others, and what else would do instead is told.

mod along;
pub mod blocks;
pub mod candidates;
pub mod case;
pub mod converge;
pub mod delay;
pub mod dictionary;
pub mod explained;
pub mod fit;
mod friction;
pub mod judge;
pub mod nested;
pub mod normal_equations;
mod order;
pub mod residual;
pub mod ripples;
pub mod segments;
pub mod springs;
pub mod unseen;

use blocks::Blocks;
use candidates::{Asked, Candidate, Linear};
use case::{Case, Simple, Wanted};
use dictionary::Dictionary;
use explained::Explained;
use fit::{Links, Term};
use normal_equations::Sums;

use super::effects::{Catalogue, LogEffect};
use super::scene::Loads;
use crate::infer::constants::{LOOSE, SIGNIFICANT};
use crate::signal::Signals;

/// So many candidates are asked again by blocks of their own.
const AGAIN: usize = 4;

/// No log shows more.
const MOST: usize = 80;

/// Everything that a search works with.
pub struct Search<'s, 'a> {
    /// The log.
    pub dict: &'s Dictionary<'a>,
    /// What is known of the rigid links.
    pub links: &'s Links,
    /// Which of the dictionary's offers are asked for.
    pub offers: &'s [usize],
    /// Of random signs.
    pub seed: u64,
    candidates: Vec<Linear<'s>>,
}

/// One round: a model, and what could be added to it.
pub struct Round {
    /// The model.
    pub now: Explained,
    /// How the time is divided.
    pub blocks: Blocks,
    /// Who was asked, and what they said.
    pub asked: Asked,
}

/// Effects and places that are asked for, and about which values.
pub fn wanted(
    case: &Case<'_>,
    simple: &Simple,
    catalogue: &Catalogue,
    only: Option<&[String]>,
) -> Vec<Wanted> {
    let loads = Loads { delay: simple.delay, ..Loads::default() };
    let scene = case.scene(simple, case.signals, &loads);
    let named = |e: &&dyn LogEffect| {
        only.is_none_or(|names| names.iter().any(|name| name == e.identifier()))
    };
    let asked = catalogue.iter().filter(|e| e.domain() == case.kind.0).filter(named);
    let asked = asked.filter(|e| e.excluded(&scene).is_none());
    let at = |e: &'static dyn LogEffect| -> Vec<Wanted> {
        let spots = e.spots(&scene).into_iter();
        let probed = spots.map(|spot| (e, spot, e.probes(&scene, spot)));
        probed.filter(|(.., probes)| !probes.is_empty()).collect()
    };
    asked.flat_map(at).collect()
}

impl<'s, 'a> Search<'s, 'a> {
    /// Of a log, among some of its offers.
    pub fn new(
        dict: &'s Dictionary<'a>,
        links: &'s Links,
        offers: &'s [usize],
        seed: u64,
    ) -> Search<'s, 'a> {
        let mut search = Search { dict, links, offers, seed, candidates: Vec::new() };
        search.candidates = search.linear(offers);
        search
    }

    /// Fits the terms and asks for others among the offers.
    pub fn round(&self, terms: &[Term], sizes: &[f64]) -> Round {
        let now = self.explained(terms, sizes);
        let divided = |correlation: &[f64]| {
            let longest = correlation.iter().copied().fold(0.0, f64::max);
            self.dict.blocks(longest)
        };
        let ask = |blocks: &Blocks| {
            let sums = self.dict.sums(blocks);
            self.lacking(&now, (blocks, &sums), self.offers)
        };
        let blocks = divided(&now.correlation);
        let asked = ask(&blocks);
        let finest = divided(&[]).all.len();
        let round = Round { now: now.clone(), blocks, asked };
        if round.blocks.all.len() == finest {
            return round;
        }
        // What is left remembers long while something slow is missing, and few blocks tell nothing. Were a
        // candidate unrelated, what is left would be left with it too: so long are the blocks. It is asked before
        // what has less evidence, and would be taken for it bit by bit.
        let best = round.best(self.dict.case).map_or(0.0, |best| best.answer.gain);
        let most = round.asked.most(self.dict.case, best);
        let looks = 1.0 + most.len() as f64;
        for most in most {
            let with: Vec<Term> = now.fit.terms.iter().chain([&most.term]).cloned().collect();
            let correlation = self.fitted(&with, &now).fit.correlation(self.dict);
            let blocks = divided(&correlation);
            if blocks.all.len() <= round.blocks.all.len() {
                continue;
            }
            let mut asked = ask(&blocks);
            for candidate in &mut asked.candidates {
                // Each look is another question that chance may answer, as was the first (Bonferroni).
                let is_it = candidate.term.offer == most.term.offer;
                let p_value = &mut candidate.answer.p_value;
                *p_value = if is_it { (looks * *p_value).min(1.0) } else { 1.0 };
            }
            let again = Round { now: now.clone(), blocks, asked };
            if again.best(self.dict.case).is_some() {
                return again;
            }
        }
        round
    }

    /// Asks a model for those of the offers that it lacks.
    fn lacking(&self, now: &Explained, divided: (&Blocks, &Sums), offers: &[usize]) -> Asked {
        let terms: Vec<&Term> = now.fit.terms.iter().collect();
        let offers = offers.iter().copied().filter(|offer| self.lacks(&terms, *offer));
        self.asked(now, divided, &offers.collect::<Vec<_>>())
    }

    /// Looks for effects beside some terms, one after the other. `each` is told every round; the last, in which none
    /// was added, is returned.
    pub fn run(&self, terms: &[Term], each: &mut dyn FnMut(&Round)) -> Round {
        let mut sizes = vec![1.0; self.dict.case.signals.joints()];
        if terms.is_empty() {
            sizes = self.dict.sizes(&[self.dict.left(self.links, &[])], &[1.0]);
        }
        let mut terms = terms.to_vec();
        let mut rounds = 0;
        loop {
            let round = self.round(&terms, &sizes);
            each(&round);
            let more = self.next(&round);
            let Some(more) = more.filter(|_| rounds < MOST) else { return round };
            rounds += 1;
            terms = self.with_along(more);
            sizes = round.now.sizes;
        }
    }
}

impl Round {
    /// The candidate that has most evidence, of those that are found.
    pub fn best(&self, case: &Case<'_>) -> Option<&Candidate> {
        let candidates = self.asked.candidates.iter();
        let found = candidates.filter(|c| c.answer.is_found(SIGNIFICANT));
        let found = found.filter(|c| case.is_feasible(&c.term));
        found.max_by(|a, b| a.answer.gain.total_cmp(&b.answer.gain))
    }
}

impl Asked {
    /// The candidates that chance may explain and that have most evidence, more than so much; that which has most
    /// first.
    fn most(&self, case: &Case<'_>, least: f64) -> Vec<&Candidate> {
        let may = |c: &&Candidate| {
            c.answer.p_value > SIGNIFICANT && c.answer.gain > least && case.is_feasible(&c.term)
        };
        let mut most: Vec<&Candidate> = self.candidates.iter().filter(may).collect();
        most.sort_by(|a, b| b.answer.gain.total_cmp(&a.answer.gain));
        most.truncate(AGAIN);
        most
    }
}

/// Independent numbers that the rows of the joints hold.
pub fn effective(used: &[f64], correlation: &[f64], signals: &Signals) -> f64 {
    let all = used.iter().zip(correlation).filter(|(rows, _)| **rows > 0.0);
    all.map(|(rows, time)| rows * signals.step() / (2.0 * time)).sum()
}

#[cfg(test)]
mod tests;
