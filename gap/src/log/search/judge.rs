//! What the findings are worth: whether each is more than accident beside the others, and what else would do.

use super::Search;
use super::along::is_along;
use super::blocks::Blocks;
use super::candidates::{Asked, Candidate};
use super::dictionary::Dictionary;
use super::explained::Explained;
use super::fit::{Fitted, Links, Term};
use super::normal_equations::Sums;
use crate::effects::Place;
use crate::infer::constants::{BEYOND_NOISE, DISTINGUISHABLE, SIGNIFICANT};
use crate::infer::{Answer, Doubt, students_t, worst};
use crate::log::effects::{LINKS, SCALE, Spot};
use crate::parallel;

/// The blocks, and the products of each.
pub(super) type Divided<'d> = (&'d Blocks, &'d Sums);

/// One finding beside all others.
pub struct Judged {
    /// With its values.
    pub term: Term,
    /// What speaks against it.
    pub doubt: Doubt,
    /// Squares that it leaves of the blocks, held out.
    left: f64,
    /// What would do instead, with what it leaves for each that the finding leaves; the best first.
    pub rivals: Vec<(Term, f64)>,
}

/// What a log says at the end.
pub struct Verdict {
    /// In the order in which they were added.
    pub findings: Vec<Judged>,
    /// The model, and the noise that it leaves.
    pub now: Explained,
    /// How the time is divided.
    pub blocks: Blocks,
}

impl Search<'_, '_> {
    /// Judges each term beside the others, and drops those that are not told from accident, without which no more of
    /// the held-out blocks is left, or which have become what no such thing is, one after the other. What stands beside
    /// another on any such arm is tried once more without them.
    pub(super) fn judged(&self, mut now: Explained) -> Verdict {
        let mut tried = false;
        loop {
            // Were a finding unrelated, what is left would be left without it too: so long are the blocks.
            let longest = now.correlation.iter().copied().fold(0.0, f64::max);
            let blocks = self.dict.blocks(longest);
            let sums = self.dict.sums(&blocks);
            let divided = (&blocks, &sums);
            let judged = |k: usize| self.judge(&now, k, divided);
            let all: Vec<Judged> = parallel::map(now.fit.terms.len(), &judged);
            let doubted = |(_, judged): &(usize, &Judged)| {
                let Judged { term, doubt, .. } = judged;
                let is_along = is_along(term, &now.fit.terms);
                doubt.is_impossible || (doubt.is_doubted(SIGNIFICANT) && !is_along)
            };
            let doubted = all.iter().enumerate().filter(doubted);
            let terms = match worst(doubted.map(|(k, judged)| (k, judged.doubt))) {
                None => {
                    let terms = self.with_along(now.fit.terms.clone());
                    if tried || terms.len() == now.fit.terms.len() {
                        return Verdict { findings: all, now, blocks };
                    }
                    tried = true;
                    terms
                }
                Some(worst) => {
                    let mut terms = now.fit.terms.clone();
                    let gone = terms.remove(worst);
                    // What stood beside it alone goes with it; beside the robot file's it may be found again.
                    terms.retain(|t| {
                        t.spot != gone.spot || t.effect.beside() != Some(gone.effect.identifier())
                    });
                    terms
                }
            };
            now = self.told(&terms, &now.sizes);
        }
    }

    /// A term beside all others.
    fn judge(&self, now: &Explained, term: usize, divided: Divided<'_>) -> Judged {
        let dict = self.dict;
        let mut others = now.fit.terms.clone();
        let term = others.remove(term);
        let near = |offer: &&usize| dict.offers[**offer].spot.meets(term.spot);
        let near: Vec<usize> = self.offers.iter().filter(near).copied().collect();
        let lacks = self.fitted(&others, now);
        let mut judged = self.lacking(&lacks, divided, &near).judge(dict, term);
        for (rival, left) in self.instead(now, &judged.term, divided) {
            let is_it = |(t, _): &(Term, f64)| t.offer == rival.offer;
            if !judged.rivals.iter().any(is_it) {
                judged.rivals.push((rival, (left / judged.left).sqrt()));
            }
        }
        let is_of_body = judged.term.effect.carried(dict.case.arm, judged.term.spot).is_some();
        if *self.links != Links::Free && !is_of_body {
            let fit = Fitted::of(dict, &others, &Links::Free, &now.sizes);
            let free = Explained { fit, ..now.clone() };
            judged.rivals.extend(self.links_instead(now, &free, divided));
        }
        judged
    }

    /// Other numbers of all links, with what they leave for each that is left now, if chance may have made that more.
    /// They have no evidence: nothing is known of them beforehand.
    fn links_instead(
        &self,
        now: &Explained,
        free: &Explained,
        divided: Divided<'_>,
    ) -> Option<(Term, f64)> {
        let [own, other] =
            [now, free].map(|fit| self.asked_by_block(fit, divided, &[]).held_out_by_block(None));
        let links = Term {
            offer: usize::MAX,
            entry: 0,
            effect: LINKS,
            spot: Spot::at(Place::Arm),
            values: Vec::new(),
            margin: 0.0,
        };
        let ratio = other.iter().sum::<f64>() / own.iter().sum::<f64>();
        (!is_worse(&other, &own)).then_some((links, ratio.sqrt()))
    }
}

/// Whether what one leaves of the blocks is told from what another leaves: the larger, by more than the
/// blocks scatter, one-sided.
fn is_worse(other: &[f64], best: &[f64]) -> bool {
    let differences: Vec<f64> = other.iter().zip(best).map(|(o, b)| o - b).collect();
    let n = differences.len() as f64;
    let mean = differences.iter().sum::<f64>() / n;
    let variance = differences.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / (n - 1.0) / n;
    mean > students_t(n - 1.0, 1.0 - BEYOND_NOISE) * variance.sqrt()
}

/// Whether a body's numbers hold what a scale of all loads does: that body, so many times. It leaves as little, and on what
/// is held out it is worse by the numbers that it has more alone.
fn has_it_in(dict: &Dictionary<'_>, body: &Candidate, scale: &Candidate) -> bool {
    let is_scale = scale.term.effect.identifier() == SCALE.identifier();
    let is_body = body.term.effect.carried(dict.case.arm, body.term.spot).is_some();
    let is_all = scale.term.spot.place == Place::Arm;
    is_scale && is_all && is_body && body.drop >= ALL * scale.drop
}

/// What is taken by more columns is as much but for the rounding of products of thousands of rows.
const ALL: f64 = 1.0 - 1e-6;

impl Asked {
    /// The finding that the model lacks.
    fn judge(self, dict: &Dictionary<'_>, term: Term) -> Judged {
        let is_impossible = !dict.case.is_feasible(&term);
        let Some(own) = self.candidates.iter().find(|c| c.term.offer == term.offer) else {
            // It adds to what has gone: nothing speaks for it.
            let doubt = Doubt { is_impossible, is_idle: true, p_value: 1.0 };
            return Judged { term, doubt, left: self.left, rivals: Vec::new() };
        };
        let Answer { gain, left, shrinks, p_value } = own.answer;
        let mut rivals: Vec<&Candidate> = (self.candidates.iter())
            .filter(|rival| {
                rival.term.offer != term.offer
                    && dict.case.is_feasible(&rival.term)
                    && (gain - rival.answer.gain <= DISTINGUISHABLE || has_it_in(dict, rival, own))
            })
            .collect();
        rivals.sort_by(|a, b| a.answer.left.total_cmp(&b.answer.left));
        let ratio = |rival: &Candidate| (rival.answer.left / left).sqrt();
        let rivals = rivals.into_iter().map(|rival| (rival.term.clone(), ratio(rival))).collect();
        Judged { term, doubt: Doubt { is_impossible, is_idle: !shrinks, p_value }, left, rivals }
    }
}
