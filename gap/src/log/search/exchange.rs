//! Several findings at a joint, exchanged for one.
//!
//! Effects are added by what they take for each of their numbers. What has two (friction that falls as it
//! begins), or is in proportion to all others (a scale), may be taken bit by bit by others before its turn comes.

use super::candidates::Asked;
use super::dictionary::Dictionary;
use super::fit::{Fitted, Term};
use super::friction::is_unusual;
use super::{Round, is_worse};
use crate::infer::constants::SIGNIFICANT;

/// A round's terms and another; or one in place of all at its joint, if it leaves no more of what is held out.
pub fn added(
    dict: &Dictionary<'_>,
    round: &Round,
    term: &Term,
    offers: &[usize],
    seed: u64,
) -> Vec<Term> {
    let (links, sizes) = (&round.fit.links, &round.sizes);
    let mut terms = round.fit.terms.clone();
    terms.push(term.clone());
    let others: Vec<Term> = terms.iter().filter(|t| t.spot != term.spot).cloned().collect();
    if terms.len() - others.len() < 2 {
        return terms;
    }
    let sums = dict.sums(&round.blocks);
    let divided = (&round.blocks, &sums);
    let whole = Fitted::of(dict, &terms, links, sizes);
    let whole = Asked::of(dict, &whole, sizes, divided, &[], seed).squares;
    let most: f64 = whole.iter().sum();
    let lacks = Fitted::of(dict, &others, links, sizes);
    let here = |offer: &&usize| dict.offers[**offer].spot == term.spot;
    let here: Vec<usize> = offers.iter().filter(here).copied().collect();
    let asked = Asked::lacking(dict, &lacks, sizes, divided, &here, seed);
    let told = asked.candidates.iter().zip(&asked.p_values).filter(|(_, p)| **p <= SIGNIFICANT);
    let left = told
        .filter(|(candidate, _)| dict.case.is_feasible(&candidate.term))
        // What nobody expects has to do better.
        .filter(|(c, _)| !is_unusual(&c.term) || is_worse(&whole, &c.squares))
        .map(|(candidate, _)| (candidate.squares.iter().sum::<f64>(), &candidate.term));
    match left.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(left, _)| *left <= most) {
        Some((_, one)) => {
            // It stands where the first of them stood.
            let at = terms.iter().position(|t| t.spot == term.spot).unwrap_or(others.len());
            let mut terms = others;
            terms.insert(at, one.clone());
            terms
        }
        None => terms,
    }
}
