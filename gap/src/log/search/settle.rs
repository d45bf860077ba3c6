//! What has been dropped leaves something behind.
//!
//! Each of several findings that do nearly the same may be no more than accident beside the others, and be what no such
//! thing is. Dropped one after the other the last may go too, that was plain before there were others: then the best is
//! found again beside what has stayed, and judged with it.

use super::fit::Fitted;
use super::judge::{Verdict, judged};
use super::stock::Stock;
use super::{Round, along, exchange};

/// Judges what a search has found, and finds again what its judgement leaves without a name, as long as less is left
/// with it. `each` is told of every round.
pub fn settled(
    stock: &Stock<'_>,
    last: &Round,
    offers: &[usize],
    seed: u64,
    each: &mut dyn FnMut(&Round),
) -> Verdict {
    let links = &last.fit.links;
    let mut verdict = judged(stock, last, offers, seed);
    if verdict.findings.len() >= last.fit.terms.len() {
        return verdict;
    }
    loop {
        let round = Round::of(stock, &verdict.fit.terms, links, &verdict.sizes, offers, seed);
        each(&round);
        let Some(best) = round.best() else { return verdict };
        let terms = exchange::added(stock, &round, &best.term, offers, seed);
        let terms = along::with_along(stock, terms, offers);
        let fit = Fitted::of(stock, &terms, links, &round.sizes);
        let sizes = fit.sizes(stock);
        let again = judged(stock, &Round { fit, sizes, ..round }, offers, seed);
        if left(&again) >= left(&verdict) {
            return verdict;
        }
        verdict = again;
    }
}

/// What a verdict leaves of all joints: the logarithm of their sizes' product.
fn left(verdict: &Verdict) -> f64 {
    verdict.sizes.iter().map(|size| size.ln()).sum()
}
