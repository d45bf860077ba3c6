//! What has been dropped leaves something behind.
//!
//! Each of several findings that do nearly the same may be no more than accident beside the others, and be what no such
//! thing is. Dropped one after the other the last may go too, that was plain before there were others: then the best is
//! found again beside what has stayed, and judged with it.

use super::judge::Verdict;
use super::{Round, Search};

impl Search<'_, '_> {
    /// Judges what a search has found, and finds again what its judgement leaves without a name, as long as less is
    /// left with it. `each` is told of every round.
    pub fn converged(&self, last: &Round, each: &mut dyn FnMut(&Round)) -> Verdict {
        let mut verdict = self.judged(last.now.clone());
        if verdict.findings.len() >= last.now.fit.terms.len() {
            return verdict;
        }
        loop {
            let round = self.round(&verdict.now.fit.terms, &verdict.now.sizes);
            each(&round);
            let Some(more) = self.next(&round) else { return verdict };
            let again = self.judged(self.told(&self.with_along(more), &round.now.sizes));
            if left(&again) >= left(&verdict) {
                return verdict;
            }
            verdict = again;
        }
    }
}

/// What a verdict leaves of all joints: the logarithm of their sizes' product.
fn left(verdict: &Verdict) -> f64 {
    verdict.now.sizes.iter().map(|size| size.ln()).sum()
}
