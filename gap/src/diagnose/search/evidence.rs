//! How much the data speak for a candidate: its cost in parameters weighed against what it
//! explains, and the chance that noise alone explains as much.

use std::collections::BTreeSet;

use nalgebra::DMatrix;
use rayon::prelude::*;
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use crate::diagnose::sums::{Score, Screen};
use crate::rng::{Rng, Stream};

/// Random sign patterns; all of them are taken if there are no more.
const FLIPS: usize = 999;

/// Candidates whose sums over the blocks are taken together.
const TOGETHER: usize = 64;

/// A fall of squares beyond this, in units of the variance, is no chance with any number of
/// parameters that an effect has; the distributions' tails are not asked there.
const CERTAIN: f64 = 2000.0;

/// No chance is told below this.
const LEAST_CHANCE: f64 = 1e-300;

/// What remains against what the noise is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    /// Whether the gaps were weighted by a noise that is known apart from them: the expected
    /// remainder is then 1 per number.
    pub(crate) known: bool,
    /// Numbers that are measured.
    pub(crate) numbers: usize,
}

impl Scale {
    /// Variance of what remains of `squares` after so many parameters.
    pub(crate) fn variance(&self, squares: f64, parameters: usize) -> f64 {
        let own = squares / self.freedom(parameters);
        (if self.known { own.max(1.0) } else { own }).max(f64::MIN_POSITIVE)
    }

    pub(crate) fn freedom(&self, parameters: usize) -> f64 {
        self.numbers.saturating_sub(parameters).max(1) as f64
    }

    /// Cost of parameters: the logarithm of the numbers for each (Schwarz), the chances that other
    /// forms and places of the effect had (each as likely as the others beforehand), and how far the values are beyond what is usual (a Cauchy prior).
    pub(crate) fn cost<'v>(
        &self,
        rank: usize,
        chances: usize,
        values: impl IntoIterator<Item = (&'v f64, &'v f64)>,
    ) -> f64 {
        let each = (self.numbers.max(2) as f64).ln();
        let unusual = values.into_iter().map(|(value, usual)| (value / usual).powi(2).ln_1p());
        rank as f64 * each + 2.0 * (chances.max(1) as f64).ln() + 2.0 * unusual.sum::<f64>()
    }

    /// The chance that noise makes a fall as large with so many parameters, `tried` candidates
    /// having been tried (Bonferroni).
    pub(crate) fn chance(&self, score: &Score, left: f64, fitted: usize, tried: usize) -> f64 {
        if score.rank == 0 || score.drop <= 0.0 {
            return 1.0;
        }
        let (rank, freedom) = (score.rank as f64, self.freedom(fitted + score.rank));
        let variance = self.variance((left - score.drop).max(0.0), fitted + score.rank);
        let chance = if score.drop / variance > CERTAIN {
            Some(0.0)
        } else if self.known && variance == 1.0 {
            ChiSquared::new(rank).ok().map(|d| d.sf(score.drop))
        } else {
            let ratio = score.drop / rank / variance;
            FisherSnedecor::new(rank, freedom).ok().map(|d| d.sf(ratio))
        };
        let chance = chance.unwrap_or(1.0);
        if chance.is_nan() { 1.0 } else { (chance * tried as f64).clamp(LEAST_CHANCE, 1.0) }
    }
}

/// A fall of squares with `rank` parameters as a number that is comparable between ranks: the
/// normal deviate of the same chance (Wilson & Hilferty).
fn deviate(fall: f64, rank: usize) -> f64 {
    let p = rank as f64;
    let spread = 2.0 / (9.0 * p);
    ((fall / p).max(0.0).cbrt() - (1.0 - spread)) / spread.sqrt()
}

/// What the best of all that were tried explains of the gap when its signs are flipped at random,
/// pose by pose: gathered once, asked for every score.
pub(crate) struct Flips {
    /// The highest deviate of each sign pattern.
    highest: Vec<f64>,
    variance: f64,
    /// Whether all sign patterns were taken.
    exhaustive: bool,
}

impl Flips {
    pub(crate) fn new(screen: &Screen<'_>, tried: &[usize], scale: &Scale, seed: u64) -> Self {
        let blocks = screen.blocks.len();
        let variance = scale.variance(screen.left(), screen.basis.rank());
        let signs = sign_patterns(blocks, seed);
        let left = screen.left_by_block();
        let shares: Vec<DMatrix<f64>> =
            tried.par_iter().map(|c| screen.shares(*c, &left)).collect();
        let ranks: BTreeSet<usize> = shares.iter().map(DMatrix::nrows).filter(|r| *r > 0).collect();
        let mut highest = vec![f64::NEG_INFINITY; signs.ncols()];
        for rank in ranks {
            // Of one rank the largest fall has the highest deviate.
            let same: Vec<_> = shares.iter().filter(|s| s.nrows() == rank).collect();
            let falls: Vec<Vec<f64>> =
                same.par_chunks(TOGETHER).map(|some| largest(some, rank, &signs)).collect();
            for (pattern, high) in highest.iter_mut().enumerate() {
                let fall = falls.iter().map(|f| f[pattern]).fold(0.0, f64::max);
                *high = high.max(deviate(fall / variance, rank));
            }
        }
        let exhaustive = signs.ncols() == patterns(blocks);
        Self { highest, variance, exhaustive }
    }

    /// The chance that a flipped gap lets the best explain as much as `best` does of the true one.
    pub(crate) fn chance(&self, best: &Score) -> f64 {
        let observed = deviate(best.drop / self.variance, best.rank.max(1));
        // Rounding may put a pattern that equals the observed one just below it.
        let reached =
            self.highest.iter().filter(|h| **h >= observed - 1e-9 * observed.abs()).count();
        let count = self.highest.len();
        // All patterns include the observed one; drawn patterns do not.
        if self.exhaustive {
            reached.max(1) as f64 / count as f64
        } else {
            (reached + 1) as f64 / (count + 1) as f64
        }
    }
}

/// The largest fall that one of some candidates of one rank makes under each sign pattern.
fn largest(shares: &[&DMatrix<f64>], rank: usize, signs: &DMatrix<f64>) -> Vec<f64> {
    let mut all = DMatrix::zeros(rank * shares.len(), signs.nrows());
    for (index, shares) in shares.iter().enumerate() {
        all.rows_mut(rank * index, rank).copy_from(shares);
    }
    let sums = all * signs;
    let fall = |sums: &[f64]| sums.iter().map(|s| s * s).sum::<f64>();
    let columns = sums.as_slice().chunks_exact(rank * shares.len());
    columns.map(|sums| sums.chunks_exact(rank).map(fall).fold(0.0, f64::max)).collect()
}

/// Sign patterns that differ by more than all signs at once, at most `usize::MAX`.
fn patterns(blocks: usize) -> usize {
    1_usize.checked_shl(blocks.saturating_sub(1) as u32).unwrap_or(usize::MAX)
}

/// blocks × patterns of ±1.
fn sign_patterns(blocks: usize, seed: u64) -> DMatrix<f64> {
    let all = patterns(blocks);
    let sign = |negative: bool| if negative { -1.0 } else { 1.0 };
    if all <= 4 * FLIPS {
        return DMatrix::from_fn(blocks, all, |b, pattern| {
            sign(b < usize::BITS as usize && pattern >> b & 1 == 1)
        });
    }
    let mut generator = Rng::new(seed, Stream::Signs);
    DMatrix::from_fn(blocks, FLIPS, |_, _| generator.flip())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviates_are_comparable_between_ranks() {
        // 5 % points of the chi-squared distribution.
        for (rank, point) in [(1, 3.841), (2, 5.991), (6, 12.592)] {
            assert!((deviate(point, rank) - 1.645).abs() < 0.03, "{rank}");
        }
    }

    #[test]
    fn few_blocks_give_every_pattern_once() {
        let signs = sign_patterns(5, 0);
        assert_eq!(signs.ncols(), 16);
        let columns: std::collections::HashSet<Vec<i8>> =
            signs.column_iter().map(|c| c.iter().map(|s| *s as i8).collect()).collect();
        assert_eq!(columns.len(), 16);
        assert_eq!(sign_patterns(40, 1).ncols(), FLIPS);
    }

    #[test]
    fn known_noise_gives_the_chi_squared_chance() {
        let scale = Scale { known: true, numbers: 100 };
        let values = nalgebra::DVector::zeros(1);
        let score = Score { drop: 3.841_458_8, values, rank: 1, own: 1.0 };
        let chance = scale.chance(&score, 90.0, 0, 1);
        assert!((chance - 0.05).abs() < 1e-6, "{chance}");
        assert_eq!(scale.chance(&score, 90.0, 0, 100), 1.0);
    }
}
