//! What came later may make an effect superfluous, or another better: after additions every effect
//! is held against all that could stand in its place.

use nalgebra::DVector;

use super::forward::{Explained, Ranked, Search};
use crate::diagnose::fit::{Fit, Fitted, Model};
use crate::diagnose::normal_equations::{Candidate, Kept};
use crate::diagnose::options::DiagnoseError;
use crate::infer::Basis;

/// Rounds of taking back and exchanging after each addition.
const MOST_ROUNDS: usize = 12;

/// One effect is exchanged for another only for this much more evidence: a factor of about five.
pub(super) const EXCHANGE: f64 = 3.0;

/// An effect that leads all others by this much evidence is not compared with them again.
const SURE: f64 = 60.0;

impl Search<'_, '_> {
    /// Takes back what is superfluous and exchanges what another explains better; at the `end` also two
    /// for one.
    pub(super) fn pruned(&self, mut now: Explained, end: bool) -> Result<Explained, DiagnoseError> {
        for _ in 0..MOST_ROUNDS {
            if now.fit.model.found.is_empty() || self.stopped() {
                break;
            }
            let Some(next) = self.changed(&mut now, end)? else { break };
            now = self.converged(next, now.weights)?;
        }
        Ok(now)
    }

    fn changed(&self, now: &mut Explained, end: bool) -> Result<Option<Fit>, DiagnoseError> {
        let fitted = now.fit.model.parameters(self.problem);
        let variance = self.scale(now).variance(self.left(now), fitted);
        let costs = self.costs_of(now, variance);
        // One alone was just added.
        if now.fit.model.found.len() > 1
            && let Some(index) = self.superfluous(now, &costs, variance)
            && let Some(fit) = self.with(now, &[index], Vec::new(), f64::INFINITY)?
        {
            return Ok(Some(fit));
        }
        let is_fine = |found: &Fitted| found.effect.forms_are().is_fine(found.spot.form);
        let all = Model::along(self.problem)..now.fit.model.found.len();
        for index in all.clone() {
            if now.fit.model.found[index].margin > SURE {
                continue;
            }
            let (margin, fit) = self.exchanged(now, &[index], &costs, variance)?;
            if fit.is_some() {
                return Ok(fit);
            }
            if let Some(margin) = margin {
                now.fit.model.found[index].margin = margin;
            }
        }
        let open: Vec<usize> = all.filter(|k| !is_fine(&now.fit.model.found[*k])).collect();
        for (number, first) in open.iter().enumerate().filter(|_| end) {
            for second in &open[number + 1..] {
                let (_, fit) = self.exchanged(now, &[*first, *second], &costs, variance)?;
                if fit.is_some() {
                    return Ok(fit);
                }
            }
        }
        Ok(None)
    }

    /// The model with the best of all others in the place of some effects (ascending), if it has more
    /// evidence than they at these `costs` of all effects; if not, by how much less it has, if there is one.
    fn exchanged(
        &self,
        now: &Explained,
        without: &[usize],
        costs: &[f64],
        variance: f64,
    ) -> Result<(Option<f64>, Option<Fit>), DiagnoseError> {
        if self.stopped() {
            return Ok((None, None));
        }
        let found = &now.fit.model.found;
        let kept = Kept { without, whole: true, ..Kept::default() };
        let screen = self.screen(now, kept);
        let own = self.left(now) / variance + without.iter().map(|k| costs[*k]).sum::<f64>();
        // One effect is no other than itself, but one order of a periodic error is not another; of two
        // that one might do for, it may be one of them.
        let is_it = |candidate: &Candidate| {
            let one = candidate.effect();
            let found = &found[without[0]];
            without.len() == 1
                && one.is_some_and(|(effect, spot)| {
                    let same = !candidate.forms_are_orders() || spot.form == found.spot.form;
                    effect == found.effect && spot.place == found.spot.place && same
                })
        };
        let resolved = self.resolved();
        let others =
            || found.iter().enumerate().filter(|(k, _)| !without.contains(k)).map(|(_, f)| f);
        let can = |r: &&Ranked| {
            let candidate = &self.candidates[r.candidate];
            !is_it(candidate) && candidate.is_apart(&resolved, others())
        };
        let ranked = self.ranked(&screen, now);
        let Some(best) = ranked.iter().find(can) else { return Ok((None, None)) };
        let its = best.cost;
        let margin = (screen.left() - best.score.drop) / variance + its - own;
        if margin + EXCHANGE >= 0.0 {
            return Ok((Some(margin), None));
        }
        let refined = self.refined(now, without, best, &screen).into_iter().collect();
        let Some(fit) = self.with(now, without, refined, (own - its) * variance)? else {
            return Ok((None, None));
        };
        let lingers = self.lingers(now, &fit, best)?;
        Ok((None, (!lingers).then_some(fit)))
    }

    /// The effect that costs most beyond what it explains beside all the others, if one does.
    fn superfluous(&self, now: &Explained, costs: &[f64], variance: f64) -> Option<usize> {
        let basis = Basis::new(&self.normal(now));
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
            let excess = costs[index] - rise / variance;
            if excess >= 0.0 && worst.is_none_or(|(most, _)| excess > most) {
                worst = Some((excess, index));
            }
        }
        worst.map(|(_, index)| index)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector6;

    use super::*;
    use crate::diagnose::Options;
    use crate::diagnose::data::{Folds, Problem};
    use crate::diagnose::normal_equations::{Candidate, scale_elastic};
    use crate::diagnose::tests::normal;
    use crate::effects::{CATALOGUE, Place, Spot};
    use crate::fixture::{rigid, row, table};
    use crate::measurement::{Kind, Row};
    use crate::rng::{Rng, Stream};
    use crate::simulate::simulate;

    /// All loads are a tenth larger than the file says. Of an arm that gives at two joints a compliance
    /// more at each does nearly the same: no one of the two is superfluous, and none can be exchanged
    /// alone.
    #[test]
    fn two_findings_that_one_explains_are_exchanged_for_it() {
        let mut arm = rigid();
        (arm.joints[0].compliance, arm.joints[1].compliance) = (2e-5, 3e-5);
        arm.joints.iter_mut().for_each(|joint| joint.mass = 0.0);
        let mut rng = Rng::new(8, Stream::Signs);
        let kind = Kind::Pose { orientation: true };
        let rows = (0..40).map(|group| {
            let mut any = |scale: f64| scale * normal(&mut rng);
            let q = [any(1.0), any(0.7), any(0.7)];
            let wrench = Vector6::from_fn(|k, _| any(if k < 3 { 60.0 } else { 5.0 }));
            let real = simulate(&arm, &row(&q, wrench * 1.1), kind).unwrap().reading().vector();
            let measured = real.map(|x| x + any(1e-6));
            Row { group, measured, ..row(&q, wrench) }
        });
        let data = table(rows.collect(), kind);
        let options = Options::default();
        let problem = Problem::new(&arm, &data, &options).unwrap();
        let folds = Folds::deal(&data, &options).unwrap();
        let mut candidates = Candidate::all(&problem, &CATALOGUE);
        scale_elastic(&mut candidates, &problem, &Model::nominal(&problem)).unwrap();
        let search = Search {
            problem: &problem,
            folds: &folds,
            candidates: &candidates,
            options: &options,
            progress: &|_| {},
        };
        let mut model = Model::nominal(&problem);
        for number in [1, 2] {
            let spot = Spot { place: Place::Joint(number), form: 0 };
            let own = candidates.iter().find(|c| {
                c.effect().is_some_and(|(e, s)| e.identifier() == "joint_compliance" && s == spot)
            });
            model.found.extend(own.unwrap().fitted(spot, vec![1e-6]));
        }
        let names = |now: &Explained| {
            let each = now.fit.model.found.iter().map(|f| f.effect.identifier());
            each.collect::<Vec<_>>()
        };
        let begun = search.begin(model).unwrap();
        let alone = search.pruned(begun.clone(), false).unwrap();
        assert_eq!(names(&alone), ["joint_compliance"; 2]);
        assert_eq!(names(&search.pruned(begun, true).unwrap()), ["wrench_scale"]);
    }
}
