//! Candidates beside a model, in the order of the evidence that they add.

use nalgebra::{DMatrix, DVector};

use super::basis::principal;
use super::constants::{NUMBERS_EACH, OWN};
use super::evidence::Scale;
use super::limits::ROUNDS;
use super::score::Score;
use super::screen::{Columns, Screen};

/// A candidate beside a model; more `gain` is better.
pub struct Ranked {
    /// Its index.
    pub candidate: usize,
    /// What it explains beside the model.
    pub score: Score,
    /// What the parameters cost.
    pub cost: f64,
    /// By how much more the squares fall, in units of the noise: twice the logarithm of the odds.
    pub gain: f64,
}

impl<C: Columns> Screen<'_, C> {
    /// The candidates that the rows decide, best first, judged at the noise that the best of them leaves.
    pub fn ranked(&self, scale: Scale) -> Vec<Ranked> {
        let (left, fitted) = (self.left(), self.basis.rank());
        let room = (scale.numbers / NUMBERS_EACH).saturating_sub(fitted);
        let tolerated =
            |c: usize| self.tolerated(c, |left, own| scale.variance(left, fitted + own));
        let scored = (0..self.candidates.len()).map(|c| match self.candidates[c].is_tolerated() {
            true => {
                let (score, cost) = tolerated(c);
                (c, score, Some(cost))
            }
            false => (c, self.score(c), None),
        });
        let can = |score: &Score| score.rank > 0 && score.own > OWN && score.rank <= room;
        let kept: Vec<_> = scored.filter(|(_, s, _)| can(s) && s.drop > 0.0).collect();
        let best = kept.iter().map(|(_, s, _)| s.drop).fold(0.0, f64::max);
        let variance = scale.variance((left - best).max(0.0), fitted);
        let mut ranked: Vec<Ranked> = kept
            .into_iter()
            .map(|(candidate, score, cost)| {
                let it = &self.candidates[candidate];
                let own = || {
                    let own = self.own(candidate);
                    own.price(&it.usual().held, &score.values, scale.count(), variance)
                };
                let cost = cost.unwrap_or_else(|| Scale::cost(own(), it.usual().multiplicity));
                let gain = score.drop / variance - cost;
                Ranked { candidate, score, cost, gain }
            })
            .collect();
        ranked.sort_by(|a, b| b.gain.total_cmp(&a.gain));
        ranked
    }

    /// A candidate of many numbers, each held to its tolerance, fitted to all rows at the variance
    /// of what it leaves, which `variance` makes of squares and a number of parameters; and its cost:
    /// how far its numbers are from 0, and by how much the data narrow them (the evidence of a linear
    /// model with a normal prior, MacKay 1992).
    fn tolerated(&self, candidate: usize, variance: impl Fn(f64, usize) -> f64) -> (Score, f64) {
        let own = self.own(candidate);
        let held = DVector::from_column_slice(&self.candidates[candidate].usual().held);
        let scaled = |m: DMatrix<f64>| m.map_with_location(|r, c, x| x / (held[r] * held[c]));
        let size = held.len();
        let data = scaled(&own.xx - own.zx.tr_mul(&own.zx)) - DMatrix::identity(size, size);
        let (seen, turn) = principal(data);
        let right = turn.tr_mul(&(&own.xr - own.zx.tr_mul(&self.total.zr)).component_div(&held));
        let mut unit = variance(self.left(), 0);
        let (mut drop, mut decided) = (0.0, 0.0);
        let mut values = DVector::zeros(size);
        for _ in 0..ROUNDS {
            values = right.zip_map(&seen, |u, seen| u / (seen + unit));
            drop = 2.0 * values.dot(&right) - values.dot(&values.component_mul(&seen));
            decided = seen.map(|seen| seen / (seen + unit)).sum();
            unit = variance((self.left() - drop).max(0.0), decided.round() as usize);
        }
        let narrowed: f64 = seen.map(|seen| (seen / unit).ln_1p()).sum();
        let cost = values.norm_squared() + narrowed;
        let values = (turn * values).component_div(&held);
        (Score { drop, values, rank: decided.round() as usize, own: 1.0 }, cost)
    }
}
