//! Sign-flip tests. Without a cause the residual of each block is as likely with the opposite sign: the
//! largest statistic of all candidates under flipped signs is what each is compared with (Westfall &
//! Young 1993; signs by blocks: Cameron, Gelbach & Miller 2008).

use std::collections::BTreeSet;

use nalgebra::DMatrix;

use super::limits::{CHUNK, ROUNDING};
use super::score::Score;
use super::screen::{Columns, Screen};
use crate::parallel;
use crate::rng::{Rng, Stream};

/// Random sign patterns: the least p value is one in so many.
pub(crate) const FLIPS: usize = 999;

/// Sign patterns of blocks.
pub struct Signs {
    /// Blocks × patterns of ±1.
    pub patterns: DMatrix<f64>,
    /// Whether all sign patterns were taken, the observed one among them.
    exhaustive: bool,
}

impl Signs {
    /// Random ones; all of them where these are not many more.
    pub fn new(blocks: usize, seed: u64) -> Self {
        // Those that differ by more than all signs at once.
        let all = 1_usize.checked_shl(blocks.saturating_sub(1) as u32).unwrap_or(usize::MAX);
        if all <= 4 * FLIPS {
            let sign = |block: usize, pattern: usize| {
                block < usize::BITS as usize && pattern >> block & 1 == 1
            };
            let of = |block, pattern| if sign(block, pattern) { -1.0 } else { 1.0 };
            return Self { patterns: DMatrix::from_fn(blocks, all, of), exhaustive: true };
        }
        let mut generator = Rng::new(seed, Stream::Signs);
        let patterns = DMatrix::from_fn(blocks, FLIPS, |_, _| generator.flip());
        Self { patterns, exhaustive: false }
    }

    /// The largest squared norm of the sums over the blocks that one of some candidates has under each
    /// pattern; of each candidate a column for each block.
    pub fn largest(&self, shares: &[&DMatrix<f64>]) -> Vec<f64> {
        let of_some = |some: &&[&DMatrix<f64>]| -> Vec<f64> {
            let rows: Vec<usize> = some.iter().map(|shares| shares.nrows()).collect();
            let mut all = DMatrix::zeros(rows.iter().sum(), self.patterns.nrows());
            let mut from = 0;
            for shares in *some {
                all.rows_mut(from, shares.nrows()).copy_from(shares);
                from += shares.nrows();
            }
            let sums = all * &self.patterns;
            let largest = |sums: &[f64]| {
                let mut sums = sums.iter();
                let each =
                    rows.iter().map(|rows| sums.by_ref().take(*rows).map(|s| s * s).sum::<f64>());
                each.fold(0.0, f64::max)
            };
            sums.as_slice().chunks_exact(sums.nrows().max(1)).map(largest).collect()
        };
        let some: Vec<&[&DMatrix<f64>]> = shares.chunks(CHUNK).collect();
        let all = parallel::each(&some, &of_some);
        let of_pattern = |k: usize| all.iter().map(move |f| f.get(k).copied().unwrap_or(0.0));
        (0..self.patterns.ncols()).map(|k| of_pattern(k).fold(0.0, f64::max)).collect()
    }

    /// The part of the patterns whose highest statistic reaches the observed one.
    pub fn p_value(&self, highest: &[f64], observed: f64) -> f64 {
        let reached = |high: &&f64| **high >= observed - ROUNDING * observed.abs();
        let (reached, count) = (highest.iter().filter(reached).count(), highest.len());
        // All patterns include the observed one; drawn patterns do not.
        match self.exhaustive {
            true => reached.max(1) as f64 / count as f64,
            false => (reached + 1) as f64 / (count + 1) as f64,
        }
    }
}

/// A candidate's columns for each block, told so that their squares add up to one.
pub fn unit(shares: &DMatrix<f64>) -> DMatrix<f64> {
    let size = shares.norm();
    if size > 0.0 { shares / size } else { shares.clone() }
}

/// A sum of so many squares of normal numbers as a number that is comparable between counts: the normal
/// deviate of the same chance (Wilson & Hilferty 1931).
pub fn deviate(squares: f64, count: f64) -> f64 {
    let spread = 2.0 / (9.0 * count);
    ((squares / count).max(0.0).cbrt() - (1.0 - spread)) / spread.sqrt()
}

/// What the best of all that were tried explains of the gap under flipped signs: gathered once, asked for
/// every score.
pub struct SignFlips {
    signs: Signs,
    /// The highest deviate of each sign pattern.
    highest: Vec<f64>,
    variance: f64,
}

impl SignFlips {
    /// `variance` is that of what is left without any candidate.
    pub fn new<C: Columns>(
        screen: &Screen<'_, C>,
        tried: &[usize],
        variance: f64,
        seed: u64,
    ) -> Self {
        let signs = Signs::new(screen.blocks.len(), seed);
        let left = screen.left_by_block();
        let shares: Vec<DMatrix<f64>> = parallel::each(tried, &|c| screen.shares(*c, &left));
        let ranks: BTreeSet<usize> = shares.iter().map(DMatrix::nrows).filter(|r| *r > 0).collect();
        let mut highest = vec![f64::NEG_INFINITY; signs.patterns.ncols()];
        for rank in ranks {
            // Of one rank the largest fall has the highest deviate.
            let same: Vec<_> = shares.iter().filter(|s| s.nrows() == rank).collect();
            for (high, fall) in highest.iter_mut().zip(signs.largest(&same)) {
                *high = high.max(deviate(fall / variance, rank as f64));
            }
        }
        Self { signs, highest, variance }
    }

    /// The chance that a flipped gap lets the best explain as much as `best` does of the true one.
    pub fn p_value(&self, best: &Score) -> f64 {
        let observed = deviate(best.drop / self.variance, best.rank.max(1) as f64);
        self.signs.p_value(&self.highest, observed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviates_are_comparable_between_ranks() {
        // 5 % points of the chi-squared distribution.
        for (rank, point) in [(1.0, 3.841), (2.0, 5.991), (6.0, 12.592)] {
            assert!((deviate(point, rank) - 1.645).abs() < 0.03, "{rank}");
        }
    }

    #[test]
    fn few_blocks_give_every_pattern_once() {
        let signs = Signs::new(5, 0);
        assert_eq!(signs.patterns.ncols(), 16);
        let columns: std::collections::HashSet<Vec<i8>> =
            signs.patterns.column_iter().map(|c| c.iter().map(|s| *s as i8).collect()).collect();
        assert_eq!(columns.len(), 16);
        assert_eq!(Signs::new(40, 1).patterns.ncols(), FLIPS);
    }

    #[test]
    fn the_largest_of_some_is_that_of_the_best_of_them() {
        let signs = Signs::new(3, 0);
        let (one, two) = (DMatrix::from_row_slice(1, 3, &[1.0, 2.0, 3.0]), DMatrix::identity(3, 3));
        // Signs of all blocks alike first: 6² against three squares of 1.
        assert_eq!(signs.largest(&[&two, &one])[0], 36.0);
        let of_two = signs.largest(&[&two]);
        assert_eq!(of_two, [3.0; 4]);
        assert_eq!(signs.p_value(&of_two, 3.0), 1.0);
        assert_eq!(signs.p_value(&of_two, 3.1), 0.25);
    }
}
