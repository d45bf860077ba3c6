//! Several findings at a joint, exchanged for one.
//!
//! Effects are added by what they take for each of their numbers. What has two (friction that falls as it
//! begins), or is in proportion to all others (a scale), may be taken bit by bit by others before its turn comes.

use super::candidates::Ground;
use super::fit::{Fitted, Term};
use super::stock::Stock;
use super::{Asked, CHANCE, Round};

/// A round's terms and another; or one in place of all at its joint, if it leaves no more of what is held out.
pub fn added(
    stock: &Stock<'_>,
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
    let sums = stock.sums(&round.blocks);
    let whole = Fitted::of(stock, &terms, links, sizes);
    let whole: f64 = Ground::of(stock, &whole, sizes, &round.blocks, &sums).squares.iter().sum();
    let lacks = Fitted::of(stock, &others, links, sizes);
    let here = |offer: &&usize| stock.offers[**offer].spot == term.spot;
    let here: Vec<usize> = offers.iter().filter(here).copied().collect();
    let asked = Asked::of(stock, &lacks, sizes, (&round.blocks, &sums), &here, seed);
    let told = asked.candidates.iter().zip(&asked.chances).filter(|(_, p)| **p <= CHANCE);
    let left = told
        .filter(|(candidate, _)| candidate.term.effect.may_be(&candidate.term.values))
        .map(|(candidate, _)| (candidate.squares.iter().sum::<f64>(), &candidate.term));
    match left.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(left, _)| *left <= whole) {
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
