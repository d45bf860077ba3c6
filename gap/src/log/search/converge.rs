//! What has been dropped leaves something behind.
//!
//! Each of several findings that do nearly the same may be no more than accident beside the others, and be what no such
//! thing is. Dropped one after the other the last may go too, that was plain before there were others: then the best is
//! found again beside what has stayed, and judged with it.

use super::dictionary::Dictionary;
use super::fit::Fitted;
use super::judge::{Verdict, judged};
use super::{Round, along, friction};

/// Judges what a search has found, and finds again what its judgement leaves without a name, as long as less is left
/// with it. `each` is told of every round.
pub fn converged(
    dict: &Dictionary<'_>,
    last: &Round,
    offers: &[usize],
    seed: u64,
    each: &mut dyn FnMut(&Round),
) -> Verdict {
    let links = &last.fit.links;
    let mut verdict = judged(dict, last, offers, seed);
    if verdict.findings.len() >= last.fit.terms.len() {
        return verdict;
    }
    loop {
        let round = Round::of(dict, &verdict.fit.terms, links, &verdict.sizes, offers, seed);
        each(&round);
        let Some(more) = friction::next(dict, &round, offers, seed) else { return verdict };
        let terms = along::with_along(dict, more, offers);
        let fit = Fitted::of(dict, &terms, links, &round.sizes);
        let sizes = fit.sizes(dict);
        let again = judged(dict, &Round { fit, sizes, ..round }, offers, seed);
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
