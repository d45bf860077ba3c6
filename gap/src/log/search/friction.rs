//! Coulomb and viscous friction that the robot file has otherwise, both at once.
//!
//! Where the file has friction that the arm has not, each of its two numbers by itself would take away more than there
//! is, or one number that is in proportion to both (a torque's scale) or bends between them (a curve) does as well. Both are
//! therefore tried together, and in place of anything else that is named at such a joint.

use super::candidates::Candidate;
use super::explained::Explained;
use super::fit::Term;
use super::judge::Divided;
use super::{Round, Search};
use crate::infer::against;
use crate::infer::constants::{DISTINGUISHABLE, SIGNIFICANT};
use crate::log::effects::{COULOMB, LogEffect, SCALE, Spot, VISCOUS};

/// Friction's two numbers.
const BOTH: [&dyn LogEffect; 2] = [COULOMB, VISCOUS];

fn is_either(effect: &dyn LogEffect) -> bool {
    BOTH.iter().any(|one| one.identifier() == effect.identifier())
}

impl Search<'_, '_> {
    /// A round's terms and what they lack most; `None` if chance explains all that is left.
    pub(super) fn next(&self, round: &Round) -> Option<Vec<Term>> {
        let now = &round.now;
        let with_best = round.best(self.dict.case).map(|best| {
            let terms: Vec<Term> = now.fit.terms.iter().chain([&best.term]).cloned().collect();
            self.fitted(&terms, now)
        });
        let before = with_best.as_ref().unwrap_or(now);
        let mut joints: Vec<usize> = self.too_much(round).collect();
        joints.dedup();
        let both =
            joints.into_iter().filter_map(|joint| self.with_both(&now.fit.terms, joint, now));
        let worth = |both: &Explained| against(self, both, now);
        let both = both.filter(|both| self.is_better(both, before));
        let both = both.min_by(|a, b| worth(a).total_cmp(&worth(b)));
        let more = both.or(with_best)?;
        let pruned = self.pruned(self.explained(&more.fit.terms, &now.sizes));
        Some(self.with_friction(pruned).fit.terms)
    }

    /// Whether a model has more evidence than another, by the noise of either.
    fn is_better(&self, one: &Explained, other: &Explained) -> bool {
        [one, other].iter().all(|by| against(self, one, by) < against(self, other, by))
    }

    /// A model with both in place of what has less evidence than they at their joint.
    fn with_friction(&self, mut now: Explained) -> Explained {
        let instead = |now: &Explained, term: usize| {
            let joint = now.fit.terms[term].spot.joint()?;
            let mut others = now.fit.terms.clone();
            let is_other = !is_either(others.remove(term).effect);
            let both = is_other.then(|| self.with_both(&others, joint, now)).flatten()?;
            self.is_better(&both, now).then(|| self.explained(&both.fit.terms, &now.sizes))
        };
        while let Some(next) = (0..now.fit.terms.len()).find_map(|term| instead(&now, term)) {
            now = next;
        }
        now
    }

    /// Joints at which one of both would take away more friction than there is.
    fn too_much<'r>(&'r self, round: &'r Round) -> impl Iterator<Item = usize> + 'r {
        let is_more = |c: &&Candidate| {
            let is_less = !self.dict.case.is_feasible(&c.term);
            c.answer.p_value <= SIGNIFICANT && is_either(c.term.effect) && is_less
        };
        round.asked.candidates.iter().filter(is_more).filter_map(|c| c.term.spot.joint())
    }

    /// Both as they are offered for a joint at which the robot file has one of them, and the terms none.
    fn both_at(&self, terms: &[Term], joint: usize) -> Option<[usize; 2]> {
        let spot = Spot::of_joint(joint);
        let case = self.dict.case;
        let stands = |t: &Term| t.spot == spot && is_either(t.effect);
        let in_file = |e: &&dyn LogEffect| e.file_value(case.arm, case.kind.1, spot) > 0.0;
        if terms.iter().any(stands) || !BOTH.iter().any(in_file) {
            return None;
        }
        let [coulomb, viscous] = BOTH.map(|effect| self.offered(effect, spot));
        Some([coulomb?, viscous?])
    }

    fn offered(&self, effect: &dyn LogEffect, spot: Spot) -> Option<usize> {
        let is_it = |offer: &super::dictionary::Offer| {
            offer.effect.identifier() == effect.identifier() && offer.spot == spot
        };
        self.dict.offers.iter().position(is_it)
    }

    /// Some terms and both of a joint, in the sizes of another model; `None` where both are not offered, or come out
    /// as no friction.
    fn with_both(&self, terms: &[Term], joint: usize, like: &Explained) -> Option<Explained> {
        let both = self.both_at(terms, joint)?.map(|offer| self.dict.term(offer, 0));
        let terms: Vec<Term> = terms.iter().cloned().chain(both).collect();
        let with = self.fitted(&terms, like);
        let own = &with.fit.terms[terms.len() - BOTH.len()..];
        own.iter().all(|term| self.dict.case.is_feasible(term)).then_some(with)
    }

    /// What is not told from a term by its evidence: both for a scale of the joint's torque, that scale for both; each
    /// with the squares that it leaves of the blocks, held out.
    pub(super) fn instead(
        &self,
        now: &Explained,
        term: &Term,
        divided: Divided<'_>,
    ) -> Vec<(Term, f64)> {
        let Some(joint) = term.spot.joint() else { return Vec::new() };
        let is_here = |t: &Term| t.spot == term.spot;
        let own = now.fit.terms.iter().filter(|t| is_here(t) && is_either(t.effect)).count();
        let mut others = now.fit.terms.clone();
        let with = if term.effect.identifier() == SCALE.identifier() {
            others.retain(|t| !(is_here(t) && t.effect.identifier() == SCALE.identifier()));
            self.with_both(&others, joint, now)
        } else if is_either(term.effect) && own == BOTH.len() {
            others.retain(|t| !(is_here(t) && is_either(t.effect)));
            let scale = self.both_at(&others, joint).and_then(|_| self.offered(SCALE, term.spot));
            scale.map(|offer| {
                let terms = [&others[..], &[self.dict.term(offer, 0)]].concat();
                self.fitted(&terms, now)
            })
        } else {
            None
        };
        let Some(with) = with else { return Vec::new() };
        let worse = against(self, &with, now) - against(self, now, now);
        let added = &with.fit.terms[others.len()..];
        let is_feasible = added.iter().all(|term| self.dict.case.is_feasible(term));
        if !is_feasible || worse > DISTINGUISHABLE {
            return Vec::new();
        }
        let left = self.asked(&with, divided, &[]).left;
        added.iter().map(|term| (term.clone(), left)).collect()
    }
}
