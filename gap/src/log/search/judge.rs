//! What the findings are worth: whether each is more than accident beside the others, and what else would do.

use super::along::is_along;
use super::blocks::Blocks;
use super::candidates::{Asked, Candidate};
use super::dictionary::Dictionary;
use super::explained::Explained;
use super::fit::{Fitted, Links, Term};
use super::normal_equations::Sums;
use super::{Search, is_worse};
use crate::effects::Place;
use crate::infer::constants::{DISTINGUISHABLE, SIGNIFICANT};
use crate::log::effects::{LINKS, SCALE, Spot};
use crate::parallel;

/// What does as well as a finding may miss by a hair to be more than accident by itself: of a rival is asked only that
/// the best of unrelated things does not usually do as much.
const RIVAL: f64 = 0.5;

/// Rivals of one finding that are told.
const RIVALS: usize = 5;

/// The blocks, and the products of each.
pub(super) type Divided<'d> = (&'d Blocks, &'d Sums);

/// One finding beside all others.
pub struct Judged {
    /// With its values.
    pub term: Term,
    /// The chance that something unrelated does as well.
    pub p_value: f64,
    /// What it leaves of each block, held out.
    squares: Vec<f64>,
    /// Whether that is less than what the others leave without it.
    shrinks: bool,
    /// What would do instead, with what it leaves for each that the finding leaves; the best first.
    pub rivals: Vec<(Term, f64)>,
}

impl Judged {
    /// Notes that other numbers of all links would do instead, if what these leave is not told from what
    /// the finding leaves.
    fn beside_links(&mut self, squares: &[f64]) {
        if !is_worse(squares, &self.squares) {
            let ratio = squares.iter().sum::<f64>() / self.squares.iter().sum::<f64>();
            let links = Term {
                offer: usize::MAX,
                entry: 0,
                effect: LINKS,
                spot: Spot::at(Place::Arm),
                values: Vec::new(),
                margin: 0.0,
            };
            self.rivals.push((links, ratio.sqrt()));
        }
    }
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
            let wrong = |j: &Judged| !self.dict.case.is_feasible(&j.term);
            let is_idle = |j: &Judged| j.p_value > SIGNIFICANT || !j.shrinks;
            let doubted =
                |j: &Judged| wrong(j) || (is_idle(j) && !is_along(&j.term, &now.fit.terms));
            let worst = (0..all.len()).filter(|k| doubted(&all[*k])).max_by(|a, b| {
                let doubt = |k: &usize| (wrong(&all[*k]), !all[*k].shrinks, all[*k].p_value);
                let (a, b) = (doubt(a), doubt(b));
                (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2))
            });
            let terms = match worst {
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
        let own = judged.squares.iter().sum::<f64>();
        for (rival, left) in self.instead(now, &judged.term, divided, &judged.squares) {
            let is_it = |(t, _): &(Term, f64)| t.offer == rival.offer;
            if !judged.rivals.iter().any(is_it) {
                judged.rivals.push((rival, (left.iter().sum::<f64>() / own).sqrt()));
            }
        }
        if *self.links != Links::Free
            && judged.term.effect.carried(dict.case.arm, judged.term.spot).is_none()
        {
            let fit = Fitted::of(dict, &others, &Links::Free, &now.sizes);
            let free = Explained { fit, ..now.clone() };
            judged.beside_links(&self.asked(&free, divided, &[]).squares);
        }
        judged
    }
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
        let Some(own) = self.candidates.iter().position(|c| c.term.offer == term.offer) else {
            // It adds to what has gone: nothing speaks for it.
            let (squares, rivals) = (self.squares, Vec::new());
            return Judged { term, p_value: 1.0, squares, shrinks: false, rivals };
        };
        let left = |k: usize| self.candidates[k].squares.iter().sum::<f64>();
        let Candidate { squares: best, gain, .. } = &self.candidates[own];
        let mut rivals: Vec<usize> = (0..self.candidates.len())
            .filter(|k| {
                let rival = &self.candidates[*k];
                *k != own
                    && self.p_values[*k] <= RIVAL
                    && dict.case.is_feasible(&rival.term)
                    && (gain - rival.gain <= DISTINGUISHABLE
                        || !is_worse(&rival.squares, best)
                        || has_it_in(dict, rival, &self.candidates[own]))
            })
            .collect();
        rivals.sort_by(|a, b| left(*a).total_cmp(&left(*b)));
        rivals.truncate(RIVALS);
        let ratio = |k: usize| (left(k) / left(own)).sqrt();
        let rivals = rivals.into_iter().map(|k| (self.candidates[k].term.clone(), ratio(k)));
        // What took less than many others was not held out.
        let shrinks = left(own) < self.squares.iter().sum() || *best == self.squares;
        let squares = best.clone();
        Judged { p_value: self.p_values[own], squares, shrinks, rivals: rivals.collect(), term }
    }
}
