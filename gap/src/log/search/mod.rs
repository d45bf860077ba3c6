//! Looking for effects in a log: forwards, by held-out blocks of time.
//!
//! Each round fits the model, divides the time by the correlation of what is left, and asks of every
//! effect at every place what it leaves of the blocks that its fit has not seen, and how likely chance
//! among as many is to do as well. The best that chance does not explain is added. At the end every
//! finding is asked again beside all others, and what else would do instead is told.

mod along;
pub mod blocks;
pub mod candidates;
pub mod case;
pub mod converge;
pub mod delay;
pub mod dictionary;
mod exchange;
pub mod fit;
mod friction;
pub mod judge;
pub mod nested;
pub mod normal_equations;
pub mod residual;
pub mod ripples;
pub mod segments;
pub mod springs;
pub mod unseen;

use blocks::Blocks;
use candidates::{Asked, Candidate};
use case::{Case, Simple, Wanted};
use dictionary::Dictionary;
use fit::{Fitted, Links, Term};
use normal_equations::Sums;

use super::effects::{CATALOGUE, Catalogue, LogEffect, Spot};
use super::scene::Loads;
use super::signal::Signals;
use crate::infer::constants::SIGNIFICANT;
use crate::infer::students_t;

/// So many candidates are asked again by blocks of their own.
const AGAIN: usize = 4;

/// No log shows more.
const MOST: usize = 80;

/// One round: a model, and what could be added to it.
pub struct Round {
    /// The model.
    pub fit: Fitted,
    /// Size of what it leaves of each joint.
    pub sizes: Vec<f64>,
    /// Correlation time of that, of each joint, s.
    pub correlation: Vec<f64>,
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

impl Round {
    /// Fits the terms and asks for others among the offers.
    pub fn of(
        dict: &Dictionary<'_>,
        terms: &[Term],
        links: &Links,
        sizes: &[f64],
        offers: &[usize],
        seed: u64,
    ) -> Round {
        let fit = Fitted::of(dict, terms, links, sizes);
        // Once more, each joint told in what is left of it.
        let fit = Fitted::of(dict, &fit.terms, links, &fit.sizes(dict));
        let sizes = fit.sizes(dict);
        let correlation = fit.correlation(dict);
        let divided = |correlation: &[f64]| {
            let longest = correlation.iter().copied().fold(0.0, f64::max);
            dict.blocks(longest)
        };
        let ask = |blocks: &Blocks| {
            let sums = dict.sums(blocks);
            Asked::lacking(dict, &fit, &sizes, (blocks, &sums), offers, seed)
        };
        let blocks = divided(&correlation);
        let asked = ask(&blocks);
        let finest = divided(&[]).all.len();
        let round = Round { fit: fit.clone(), sizes: sizes.clone(), correlation, blocks, asked };
        if round.blocks.all.len() == finest {
            return round;
        }
        // What is left remembers long while something slow is missing, and few blocks tell nothing. Were a
        // candidate unrelated, what is left would be left with it too: so long are the blocks. It is asked before
        // what takes less, and would be taken for it bit by bit.
        let best = round.best(dict.case).map_or(0.0, Candidate::takes);
        let most = round.asked.most(dict.case, best);
        let looks = 1.0 + most.len() as f64;
        for most in most {
            let with: Vec<Term> = fit.terms.iter().chain([&most.term]).cloned().collect();
            let correlation = Fitted::of(dict, &with, links, &sizes).correlation(dict);
            let blocks = divided(&correlation);
            if blocks.all.len() <= round.blocks.all.len() {
                continue;
            }
            let mut asked = ask(&blocks);
            for (p_value, candidate) in asked.p_values.iter_mut().zip(&asked.candidates) {
                // Each look is another question that chance may answer, as was the first (Bonferroni).
                let is_it = candidate.term.offer == most.term.offer;
                *p_value = if is_it { (looks * *p_value).min(1.0) } else { 1.0 };
            }
            let (fit, sizes) = (fit.clone(), sizes.clone());
            let again = Round { correlation, blocks, asked, fit, sizes };
            if again.best(dict.case).is_some() {
                return again;
            }
        }
        round
    }

    /// The candidate that takes most of what is held out by each of its numbers, of those that chance
    /// does not explain.
    pub fn best(&self, case: &Case<'_>) -> Option<&Candidate> {
        let Asked { squares, candidates, p_values } = &self.asked;
        let whole: f64 = squares.iter().sum();
        let left = |c: &Candidate| c.squares.iter().sum::<f64>();
        let gain = |c: &Candidate| (whole - left(c)) / c.things();
        let told =
            candidates.iter().zip(p_values).filter(|(_, p)| **p <= SIGNIFICANT).map(|(c, _)| c);
        let told = told.filter(|c| left(c) < whole && case.is_feasible(&c.term));
        told.max_by(|a, b| gain(a).total_cmp(&gain(b)))
    }
}

impl Asked {
    /// The candidates that chance may explain and that take most by each of their numbers, more than so much; that
    /// which does first.
    fn most(&self, case: &Case<'_>, least: f64) -> Vec<&Candidate> {
        let open = self
            .candidates
            .iter()
            .zip(&self.p_values)
            .filter(|(_, p_value)| **p_value > SIGNIFICANT);
        let may = open.map(|(c, _)| c).filter(|c| case.is_feasible(&c.term));
        let mut most: Vec<&Candidate> = may.filter(|c| c.takes() > least).collect();
        most.sort_by(|a, b| b.takes().total_cmp(&a.takes()));
        most.truncate(AGAIN);
        most
    }

    /// Asks a model for those of the offers that it lacks.
    fn lacking(
        dict: &Dictionary<'_>,
        fit: &Fitted,
        sizes: &[f64],
        divided: (&Blocks, &Sums),
        offers: &[usize],
        seed: u64,
    ) -> Asked {
        let has = |name: &str, spot: Spot| {
            fit.terms.iter().any(|t| t.effect.identifier() == name && t.spot == spot)
        };
        let loads = Loads::default();
        let simple = Simple::default();
        let scene = dict.case.scene(&simple, dict.case.signals, &loads);
        let stands = |name: &str, spot: Spot| {
            let named = CATALOGUE.iter().find(|e| e.identifier() == name);
            has(name, spot) || named.is_some_and(|e| e.in_file(&scene, spot))
        };
        let lacks = |offer: &&usize| {
            let of = &dict.offers[**offer];
            !has(of.effect.identifier(), of.spot)
                && of.effect.beside().is_none_or(|other| stands(other, of.spot))
        };
        let asked: Vec<usize> = offers.iter().filter(lacks).copied().collect();
        Asked::of(dict, fit, sizes, divided, &asked, seed)
    }
}

/// Looks for effects among the offers beside some terms, one after the other. `each` is told every
/// round; the last, in which none was added, is returned.
pub fn search(
    dict: &Dictionary<'_>,
    terms: &[Term],
    links: &Links,
    offers: &[usize],
    seed: u64,
    each: &mut dyn FnMut(&Round),
) -> Round {
    let mut sizes = vec![1.0; dict.case.signals.joints()];
    if terms.is_empty() {
        sizes = dict.sizes(&[dict.left(links, &[])], &[1.0]);
    }
    let mut terms = terms.to_vec();
    let mut rounds = 0;
    loop {
        let round = Round::of(dict, &terms, links, &sizes, offers, seed);
        each(&round);
        let more = friction::next(dict, &round, offers, seed);
        let Some(more) = more.filter(|_| rounds < MOST) else { return round };
        rounds += 1;
        terms = along::with_along(dict, more, offers);
        sizes = round.sizes;
    }
}

/// How often chance leaves what does as well as a finding out of its set: the sets of 97 in 100 logs are to hold the
/// truth.
const LEFT_OUT: f64 = 0.01;

/// Whether what one leaves of the blocks is told from what another leaves: the larger, by more than the
/// blocks scatter, one-sided.
pub fn is_worse(other: &[f64], best: &[f64]) -> bool {
    let differences: Vec<f64> = other.iter().zip(best).map(|(o, b)| o - b).collect();
    let n = differences.len() as f64;
    let mean = differences.iter().sum::<f64>() / n;
    let variance = differences.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / (n - 1.0) / n;
    mean > students_t(n - 1.0, 1.0 - LEFT_OUT) * variance.sqrt()
}

/// Independent numbers that the rows of the joints hold.
pub fn effective(used: &[f64], correlation: &[f64], signals: &Signals) -> f64 {
    let all = used.iter().zip(correlation).filter(|(rows, _)| **rows > 0.0);
    all.map(|(rows, time)| rows * signals.step() / (2.0 * time)).sum()
}
