//! How much the data speak for a candidate: its cost in parameters weighed against what it
//! explains, and the chance that noise alone explains as much.

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use super::basis::principal;
use super::score::Score;

/// Steps to a scale: each is nearer by the part of the numbers that are hardly decided.
const MOST_SCALED: usize = 50;

/// A fall of squares beyond this, in units of the variance, is no chance with any number of
/// parameters that an effect has; the distributions' tails are not asked there.
const CERTAIN: f64 = 2000.0;

/// No chance is told below this.
const LEAST_CHANCE: f64 = 1e-300;

/// What remains against what the noise is.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    /// Whether the gaps were weighted by a noise that is known apart from them: the expected
    /// remainder is then 1 per number.
    pub known: bool,
    /// Numbers that are measured.
    pub numbers: usize,
    /// The part of them that is independent, by which their squares are weighted: 1 of white noise.
    pub independent: f64,
}

impl Scale {
    /// Variance of what remains of `squares` after so many parameters.
    pub fn variance(&self, squares: f64, parameters: usize) -> f64 {
        let own = squares / self.freedom(parameters);
        (if self.known { own.max(1.0) } else { own }).max(f64::MIN_POSITIVE)
    }

    /// What a term costs whose numbers have a [price](super::price) and which had so many
    /// multiplicity: its places and forms, each as likely as the others beforehand.
    pub fn cost(price: f64, multiplicity: usize) -> f64 {
        price + 2.0 * (multiplicity.max(1) as f64).ln()
    }

    /// Independent numbers beyond so many parameters, at least one.
    pub fn freedom(&self, parameters: usize) -> f64 {
        self.numbers.saturating_sub(parameters).max(1) as f64 * self.independent
    }

    /// Independent numbers.
    pub(crate) fn count(&self) -> usize {
        (self.numbers as f64 * self.independent) as usize
    }

    /// The chance that noise makes a fall as large with so many parameters, `tried` candidates
    /// having been tried (Bonferroni).
    pub fn p_value(&self, score: &Score, left: f64, fitted: usize, tried: usize) -> f64 {
        if score.rank == 0 || score.drop <= 0.0 {
            return 1.0;
        }
        let (rank, freedom) = (score.rank as f64, self.freedom(fitted + score.rank));
        let variance = self.variance((left - score.drop).max(0.0), fitted + score.rank);
        let p_value = if score.drop / variance > CERTAIN {
            Some(0.0)
        } else if self.known && variance == 1.0 {
            ChiSquared::new(rank).ok().map(|d| d.sf(score.drop))
        } else {
            let ratio = score.drop / rank / variance;
            FisherSnedecor::new(rank, freedom).ok().map(|d| d.sf(ratio))
        };
        let p_value = p_value.unwrap_or(1.0);
        if p_value.is_nan() { 1.0 } else { (p_value * tried as f64).clamp(LEAST_CHANCE, 1.0) }
    }
}

/// The most likely common factor of the standard deviations of some numbers, of which they have the posterior
/// `precision` and `values` in units of what they are now, `is_now` times what is usual: as many powers of e are as
/// likely, and beyond the usual the density falls as Cauchy's. MacKay's fixed point (1992): the squares are as large as
/// the data decide numbers.
pub fn likely_scale(precision: DMatrix<f64>, values: &DVector<f64>, is_now: f64) -> f64 {
    let right = &precision * values;
    let (wide, turn) = principal(precision);
    let (data, right) = (wide.map(|wide| (wide - 1.0).max(0.0)), turn.tr_mul(&right));
    let usual = is_now * is_now;
    let mut square = 1.0;
    for _ in 0..MOST_SCALED {
        let wide = data.map(|data| 1.0 + square * data);
        let decided: f64 = wide.iter().map(|wide| 1.0 - 1.0 / wide).sum();
        let beyond = 2.0 * (1.0 - 1.0 / (1.0 + square * usual));
        square *= square * right.component_div(&wide).norm_squared() / (decided + beyond);
    }
    is_now * square.sqrt()
}
