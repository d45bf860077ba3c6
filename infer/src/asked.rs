//! What could be added to a model, and whether it is: the questions that every candidate is asked, of whatever
//! observations.
//!
//! A candidate is found if it has evidence, if it leaves smaller squares of blocks that no fit has seen, and if its p value
//! is small.

use std::sync::OnceLock;

use super::evidence::Scale;
use super::rank::Ranked;
use super::score::{HeldOut, Score, Trained};
use super::screen::{Columns, Screen};
use super::signs::SignFlips;

/// Candidates beside a model, block by block.
pub struct Asked<'c, C> {
    /// The candidates.
    pub screen: Screen<'c, C>,
    /// Those that the rows decide, best first.
    pub ranked: Vec<Ranked>,
    /// Squares of the held-out blocks without any of them.
    pub before: HeldOut,
    trained: Vec<Trained>,
    scale: Scale,
    seed: u64,
    flips: OnceLock<SignFlips>,
}

impl<'c, C: Columns> Asked<'c, C> {
    /// Of a screen by block, each candidate weighed at the noise of `scale`.
    pub fn new(screen: Screen<'c, C>, scale: Scale, seed: u64) -> Self {
        let (trained, ranked) = (screen.trained(), screen.ranked(scale));
        let before = screen.held_out(&trained, None);
        Self { screen, ranked, before, trained, scale, seed, flips: OnceLock::new() }
    }

    /// Weighted squares that a candidate, or none, leaves of each held-out block.
    pub fn held_out_by_block(&self, candidate: Option<usize>) -> Vec<f64> {
        self.screen.held_out_by_block(&self.trained, candidate)
    }

    /// What a candidate leaves of the held-out blocks.
    pub fn held_out(&self, candidate: usize) -> HeldOut {
        self.screen.held_out(&self.trained, Some(candidate))
    }

    /// The p value, corrected for all candidates: the larger of the F test's (Bonferroni) and the sign-flip test's. The F
    /// test accounts for the number of fitted parameters, the sign-flip test for correlation within a block and among
    /// candidates.
    pub fn p_value(&self, of: &Score) -> f64 {
        let (left, fitted) = (self.screen.left(), self.screen.basis.rank());
        let flips = self.flips.get_or_init(|| {
            let tried: Vec<usize> = self.ranked.iter().map(|one| one.candidate).collect();
            SignFlips::new(&self.screen, &tried, self.scale.variance(left, fitted), self.seed)
        });
        flips.p_value(of).max(self.scale.p_value(of, left, fitted, self.ranked.len()))
    }

    /// What a candidate answers.
    pub fn answer(&self, one: &Ranked) -> Answer {
        let left = self.held_out(one.candidate).white;
        let shrinks = left < self.before.white;
        Answer { gain: one.gain, left, shrinks, p_value: self.p_value(&one.score) }
    }

    /// The answer of a candidate that the rows do not decide.
    pub fn undecided(&self) -> Answer {
        let (gain, left) = (f64::NEG_INFINITY, self.before.white);
        Answer { gain, left, shrinks: false, p_value: 1.0 }
    }

    /// Whether a candidate is found at this level of significance.
    pub fn is_found(&self, one: &Ranked, level: f64) -> bool {
        one.gain > 0.0 && self.answer(one).is_found(level)
    }
}

/// What a candidate says to the questions.
#[derive(Clone, Copy, Debug)]
pub struct Answer {
    /// Twice the logarithm of its odds.
    pub gain: f64,
    /// Squares that it leaves of the held-out blocks.
    pub left: f64,
    /// Whether these are fewer than without it.
    pub shrinks: bool,
    /// The p value, corrected for all candidates.
    pub p_value: f64,
}

impl Answer {
    /// Whether it is found at this level of significance.
    pub fn is_found(&self, level: f64) -> bool {
        self.gain > 0.0 && self.shrinks && self.p_value <= level
    }
}

/// What speaks against a finding beside all the others.
#[derive(Clone, Copy, Debug)]
pub struct Doubt {
    /// Its values are impossible, as of friction that drives.
    pub is_impossible: bool,
    /// Without it no more of the held-out blocks is left.
    pub is_idle: bool,
    /// The p value, corrected for all candidates.
    pub p_value: f64,
}

impl Doubt {
    /// Whether the finding is idle, or not significant at this level.
    pub fn is_doubted(&self, level: f64) -> bool {
        self.is_idle || self.p_value > level
    }
}

/// The finding that is to be removed first, of those that are doubted: one with impossible values, then an idle one, then
/// the one with the largest p value.
pub fn worst(doubts: impl Iterator<Item = (usize, Doubt)>) -> Option<usize> {
    let order = |(_, a): &(usize, Doubt), (_, b): &(usize, Doubt)| {
        let plain = |doubt: &Doubt| (doubt.is_impossible, doubt.is_idle);
        plain(a).cmp(&plain(b)).then(a.p_value.total_cmp(&b.p_value))
    };
    doubts.max_by(order).map(|(finding, _)| finding)
}
