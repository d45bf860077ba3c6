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

#[cfg(test)]
mod tests {
    use std::sync::{Arc, LazyLock};

    use nalgebra::DMatrix;

    use super::*;
    use crate::basis::Basis;
    use crate::constants::SIGNIFICANT;
    use crate::products::Products;
    use crate::rng::{Rng, Stream};
    use crate::screen::Usual;

    const BLOCKS: usize = 40;
    const ROWS: usize = 5;

    impl Columns for Usual {
        fn usual(&self) -> &Usual {
            self
        }
    }

    /// Columns of their own, of which anything is usual.
    static COLUMNS: LazyLock<Vec<Usual>> = LazyLock::new(|| {
        vec![Usual { least: vec![f64::NEG_INFINITY], held: vec![0.0], multiplicity: 1 }; 12]
    });

    /// Normal noise whose size differs from block to block, with so much of the first column, beside a mean.
    fn asked(seed: u64, first: f64) -> Asked<'static, Usual> {
        let mut rng = Rng::new(seed, Stream::Noise);
        let count = COLUMNS.len();
        let mut total = Products::zeros(1, &[1; 12]);
        let prior = total.clone();
        let blocks: Vec<Products> = (0..BLOCKS)
            .map(|block| {
                let x = DMatrix::from_fn(ROWS, count, |_, _| rng.normal());
                let size = 1.0 + (block % 3) as f64;
                let r =
                    DMatrix::from_fn(ROWS, 1, |row, _| first * x[(row, 0)] + size * rng.normal());
                let z = DMatrix::from_element(ROWS, 1, 1.0);
                Products {
                    zz: z.tr_mul(&z),
                    zr: z.tr_mul(&r).column(0).into_owned(),
                    rr: r.norm_squared(),
                    zx: z.tr_mul(&x),
                    xr: x.tr_mul(&r).column(0).into_owned(),
                    xx: Arc::new(
                        x.column_iter()
                            .map(|c| DMatrix::from_element(1, 1, c.norm_squared()))
                            .collect(),
                    ),
                }
            })
            .collect();
        blocks.iter().for_each(|block| total.add(block));
        let basis = Basis::new(&total.zz);
        let folds: Vec<usize> = (0..BLOCKS).map(|block| block % 10).collect();
        let screen = Screen::new(&COLUMNS[..], basis, total, prior);
        let screen = screen.by_block(blocks, Vec::new(), &folds, 10);
        let scale = Scale { known: false, numbers: BLOCKS * ROWS, independent: 1.0 };
        Asked::new(screen, scale, seed)
    }

    /// The sign flips keep what they promise though the blocks are not alike, and evidence and held-out squares make
    /// false alarms rarer.
    #[test]
    fn chance_is_found_no_more_often_than_promised_and_a_cause_always() {
        let draws = 400;
        let below = |seed: u64| {
            let asked = asked(seed, 0.0);
            let least =
                asked.ranked.iter().map(|one| asked.p_value(&one.score)).fold(1.0, f64::min);
            let found = asked.ranked.iter().any(|one| asked.is_found(one, SIGNIFICANT));
            [least <= SIGNIFICANT, found].map(usize::from)
        };
        let counts = (0..draws).map(below).fold([0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
        // 20 are promised; 31 or more are the chance of one in a hundred.
        assert!((9..=31).contains(&counts[0]) && counts[1] <= counts[0], "{counts:?}");
        for seed in 0..20 {
            let asked = asked(seed, 1.0);
            let first = &asked.ranked[0];
            assert_eq!(first.candidate, 0);
            assert!(asked.is_found(first, SIGNIFICANT), "{:?}", asked.answer(first));
        }
    }

    #[test]
    fn what_none_can_be_goes_first_then_what_is_idle() {
        let doubt = |is_impossible, is_idle, p_value| Doubt { is_impossible, is_idle, p_value };
        let all = [doubt(false, false, 0.9), doubt(false, true, 0.01), doubt(true, false, 0.01)];
        let worst_of = |of: &[usize]| worst(of.iter().map(|k| (*k, all[*k])));
        assert_eq!(
            [worst_of(&[0, 1, 2]), worst_of(&[0, 1]), worst_of(&[0])],
            [Some(2), Some(1), Some(0)]
        );
        assert_eq!(worst_of(&[]), None);
        assert!(
            all[1].is_doubted(SIGNIFICANT)
                && all[0].is_doubted(SIGNIFICANT)
                && !all[2].is_doubted(SIGNIFICANT)
        );
    }
}
