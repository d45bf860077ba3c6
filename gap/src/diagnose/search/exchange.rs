//! What came later may make an effect superfluous, or another better: after additions every effect
//! is held against all that could stand in its place.

use nalgebra::DVector;

use super::forward::{Explained, Ranked, Search};
use crate::diagnose::fit::{Basis, Fit, Model, squares, strain};
use crate::diagnose::options::DiagnoseError;
use crate::diagnose::sums::Kept;

/// Rounds of taking back and exchanging after each addition.
const MOST_ROUNDS: usize = 12;

/// One effect is exchanged for another only for this much more evidence: a factor of about five.
const EXCHANGE: f64 = 3.0;

/// An effect that leads all others by this much evidence is not compared with them again.
const SURE: f64 = 60.0;

impl Search<'_, '_> {
    /// Takes back what is superfluous and exchanges what another explains better.
    pub(super) fn pruned(&self, mut now: Explained) -> Result<Explained, DiagnoseError> {
        for _ in 0..MOST_ROUNDS {
            if now.fit.model.found.len() < 2 || self.stopped() {
                break;
            }
            let Some(next) = self.changed(&mut now)? else { break };
            now = self.settled(next, now.weights)?;
        }
        Ok(now)
    }

    fn changed(&self, now: &mut Explained) -> Result<Option<Fit>, DiagnoseError> {
        let scale = self.scale(now);
        let left = self.left(now);
        let fitted = now.fit.model.parameters(self.problem);
        let variance = scale.variance(left, fitted);
        if let Some(index) = self.superfluous(now, variance)
            && let Some(fit) = self.with(now, &[index], Vec::new(), -f64::INFINITY)?
        {
            return Ok(Some(fit));
        }
        for index in Model::along(self.problem)..now.fit.model.found.len() {
            if self.stopped() {
                break;
            }
            let found = &now.fit.model.found[index];
            let fine = found.effect.forms_are().is_fine(found.spot.form);
            if fine || found.lead > SURE {
                continue;
            }
            let without = [index];
            let kept = Kept { without: &without, whole: true, ..Kept::default() };
            let screen = self.screen(now, kept);
            let own = left / variance + self.cost_of(now, &scale, index);
            let ranked = self.ranked(&screen, now);
            let is_it = |r: &&Ranked| {
                self.candidates[r.candidate].effect().is_some_and(|(effect, spot)| {
                    effect.identifier() == found.effect.identifier()
                        && spot.place == found.spot.place
                })
            };
            let Some(best) = ranked.iter().find(|r| !is_it(r)) else { continue };
            let its = best.cost;
            let lead = (screen.left() - best.score.drop) / variance + its - own;
            if lead + EXCHANGE >= 0.0 {
                now.fit.model.found[index].lead = lead;
                continue;
            }
            let refined = self.refined(now, &without, best, &screen);
            let refined = refined.into_iter().collect();
            if let Some(fit) = self.with(now, &without, refined, -f64::INFINITY)?
                && (squares(self.problem, &fit.predicted.gaps, &now.weights)
                    + strain(self.problem, &fit.model))
                    / variance
                    + its
                    < own
            {
                return Ok(Some(fit));
            }
        }
        Ok(None)
    }

    /// The effect that costs most beyond what it explains beside all the others, if one does.
    fn superfluous(&self, now: &Explained, variance: f64) -> Option<usize> {
        let basis = Basis::new(&self.normal(now));
        let scale = self.scale(now);
        let mut at = Model::nuisances(self.problem);
        let mut worst: Option<(f64, usize)> = None;
        for (index, found) in now.fit.model.found.iter().enumerate() {
            let size = found.values.len();
            let own = basis.t.rows(at, size);
            at += size;
            if index < Model::along(self.problem) {
                continue;
            }
            // Without it the squares rise by its values in the metric of their covariance.
            let values = DVector::from_column_slice(&found.values);
            let rise = Basis::new(&(own * own.transpose())).t.tr_mul(&values).norm_squared();
            let excess = self.cost_of(now, &scale, index) - rise / variance;
            if excess >= 0.0 && worst.is_none_or(|(most, _)| excess > most) {
                worst = Some((excess, index));
            }
        }
        worst.map(|(_, index)| index)
    }
}
