//! What each joint of a pair has of its own.
//!
//! A motor that turns two joints is seen in what both share. What one of them has by itself may be too small to be
//! told from zero, and its part is taken by the other then, with an interval that knows nothing of it: the
//! friction of a wrist's motor comes out too large by half of what the last joint has.

use super::Search;
use super::fit::Term;
use crate::log::scene::Loads;

use super::case::Simple;

/// Whether a term stands beside another of these on any such arm.
pub fn is_along(term: &Term, terms: &[Term]) -> bool {
    let Some(joint) = term.spot.joint() else { return false };
    let has = |other: &Term| {
        other.spot.pair().is_some_and(|pair| pair.contains(&joint))
            && other.effect.along().contains(&term.effect.identifier())
    };
    terms.iter().any(has)
}

impl Search<'_, '_> {
    /// The terms, and what stands beside them; what the robot file has already is there.
    pub(super) fn with_along(&self, mut terms: Vec<Term>) -> Vec<Term> {
        let (loads, simple, dict) = (Loads::default(), Simple::default(), self.dict);
        let scene = dict.case.scene(&simple, dict.case.signals, &loads);
        for offer in self.offers {
            let term = dict.term(*offer, 0);
            let stands =
                terms.iter().any(|t| t.offer == *offer) || term.effect.in_file(&scene, term.spot);
            if !stands && is_along(&term, &terms) {
                terms.push(term);
            }
        }
        terms
    }
}
