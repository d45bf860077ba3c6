//! How much the data speak for a candidate: its cost in parameters weighed against what it
//! explains, and the chance that noise alone explains as much.

use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use super::score::Score;

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
    /// The part of them that is independent, by which their squares are weighted: 1 of white noise.
    pub(crate) independent: f64,
}

impl Scale {
    /// Variance of what remains of `squares` after so many parameters.
    pub(crate) fn variance(&self, squares: f64, parameters: usize) -> f64 {
        let own = squares / self.freedom(parameters);
        (if self.known { own.max(1.0) } else { own }).max(f64::MIN_POSITIVE)
    }

    /// What a term costs whose numbers have a [price](super::price) and which had so many
    /// multiplicity: its places and forms, each as likely as the others beforehand.
    pub(crate) fn cost(price: f64, multiplicity: usize) -> f64 {
        price + 2.0 * (multiplicity.max(1) as f64).ln()
    }

    pub(crate) fn freedom(&self, parameters: usize) -> f64 {
        self.numbers.saturating_sub(parameters).max(1) as f64 * self.independent
    }

    /// Independent numbers.
    pub(crate) fn count(&self) -> usize {
        (self.numbers as f64 * self.independent) as usize
    }

    /// The chance that noise makes a fall as large with so many parameters, `tried` candidates
    /// having been tried (Bonferroni).
    pub(crate) fn p_value(&self, score: &Score, left: f64, fitted: usize, tried: usize) -> f64 {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_noise_gives_the_chi_squared_chance() {
        let scale = Scale { known: true, numbers: 100, independent: 1.0 };
        let values = nalgebra::DVector::zeros(1);
        let score = Score { drop: 3.841_458_8, values, rank: 1, own: 1.0 };
        let p_value = scale.p_value(&score, 90.0, 0, 1);
        assert!((p_value - 0.05).abs() < 1e-6, "{p_value}");
        assert_eq!(scale.p_value(&score, 90.0, 0, 100), 1.0);
    }
}
