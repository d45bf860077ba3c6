//! Which effects: added one by one, each judged beside all that is already there, and each taken
//! back or exchanged when what came later makes it superfluous or another better.

use crate::constants::PROMISE_KEPT;
use crate::diagnose::data::{Folds, Noise, Problem};
use crate::diagnose::fit::{
    Fit, Fitted, Model, Predicted, prior_penalty, refit, refit_below, squares,
};
use crate::diagnose::normal_equations::{Candidate, Gathered, Kept, Screen};
use crate::diagnose::options::{DiagnoseError, Options};
use crate::diagnose::progress::Stage;
use crate::effects::{Effect, Forms, Spot};
use crate::infer::constants::SIGNIFICANT;
use crate::infer::limits::{CONVERGED, ROUNDS};
use crate::infer::{Asked, Observations, Ranked, pruned};
use nalgebra::Vector6;
use std::sync::{Arc, OnceLock};

/// Most effects that are added.
const MOST_FOUND: usize = 40;

/// Effects that are compared with all others after each addition.
const SMALL: usize = 4;

/// Orders of periodic errors that are added with the best one: they hardly touch each other, and a
/// real gear has many.
const MOST_ORDERS: usize = 5;

/// Candidates that are tried in turn when the exact fit does not follow the linear one.
const MOST_TRIED: usize = 3;

/// Everything that a search works with.
#[derive(Clone, Copy)]
pub(crate) struct Search<'s, 'p> {
    pub(crate) problem: &'s Problem<'p>,
    pub(crate) folds: &'s Folds,
    pub(crate) candidates: &'s [Candidate],
    pub(crate) options: &'s Options,
    /// Is told what is being done.
    pub(crate) progress: &'s (dyn Fn(Stage) + Sync),
}

/// A fit and the noise by which it was weighted.
#[derive(Clone)]
pub(crate) struct Explained {
    pub(crate) fit: Fit,
    pub(crate) noise: Noise,
    pub(crate) weights: Vector6<f64>,
    /// Its parameters with all candidates, once they were asked for.
    pub(super) gathered: OnceLock<Arc<Gathered>>,
}

impl Explained {
    /// The same without the states of the rows, which are most of its memory.
    pub(crate) fn without_states(&self) -> Explained {
        let gaps = self.fit.predicted.gaps.clone();
        let predicted = Arc::new(Predicted { sims: Vec::new(), gaps });
        let fit = Fit { model: self.fit.model.clone(), predicted };
        Explained { fit, gathered: OnceLock::new(), ..*self }
    }

    /// The same with the states of the rows again.
    pub(crate) fn with_states(&self, problem: &Problem<'_>) -> Result<Explained, DiagnoseError> {
        let model = self.fit.model.clone();
        let fit = Fit { predicted: Arc::new(model.predict(problem, None)?), model };
        Ok(Explained { fit, gathered: OnceLock::new(), ..*self })
    }
}

impl Search<'_, '_> {
    /// A fit by the weights `before`, fitted again until its weights are those of what it leaves.
    pub(crate) fn converged(
        &self,
        fit: Fit,
        mut before: Vector6<f64>,
    ) -> Result<Explained, DiagnoseError> {
        let mut now = self.weigh(fit);
        for _ in 0..ROUNDS {
            let moved = |(now, before): (&f64, &f64)| (now - before).abs() > CONVERGED * before;
            if !now.weights.iter().zip(before.iter()).any(moved) {
                break;
            }
            before = now.weights;
            let Explained { fit, weights, .. } = now;
            now = self.weigh(refit(self.problem, fit.model, Some(&fit.predicted.sims), &weights)?);
        }
        Ok(now)
    }

    pub(crate) fn weigh(&self, fit: Fit) -> Explained {
        let parameters = fit.model.parameters(self.problem);
        let noise = Noise::of(self.problem, self.options, &fit.predicted.gaps, parameters);
        let weights = noise.weights(&self.problem.mask);
        Explained { fit, noise, weights, gathered: OnceLock::new() }
    }

    /// Fits the frames, and the effects that the model has.
    pub(crate) fn begin(&self, model: Model) -> Result<Explained, DiagnoseError> {
        let predicted = Arc::new(model.predict(self.problem, None)?);
        self.converged(Fit { predicted, model }, Vector6::zeros())
    }

    /// Adds effects as long as they are significant and shrink the gap on poses that no fit has
    /// seen, and nobody asks for an end.
    pub(crate) fn explain(&self, begun: Explained) -> Result<Explained, DiagnoseError> {
        let at_first = begun.fit.model.found.len();
        let (mut now, mut begun) = (begun.clone(), Some(begun));
        for _ in 0..MOST_FOUND {
            if self.stopped() {
                return Ok(now);
            }
            (self.progress)(Stage::Search(now.fit.model.found.len()));
            let Some(next) = self.added(&now)? else { break };
            now = self.converged(next, now.weights)?;
            // Few effects are compared with all others after each addition, many now and then.
            let count = now.fit.model.found.len();
            if count >= at_first + 2
                && let Some(begun) = begun.take()
            {
                now = self.or_paired(&begun, now)?;
            }
            if count <= SMALL || count.is_multiple_of(SMALL) {
                now = pruned(self, now, false)?;
            }
        }
        pruned(self, self.as_tolerated(now)?, true)
    }

    /// The candidates beside the model, best first.
    pub(crate) fn ranked(&self, screen: &Screen<'_>, now: &Explained) -> Vec<Ranked> {
        screen.ranked(self.scale(now))
    }

    /// All candidates in place of some effects of the model (ascending).
    pub(crate) fn asked(&self, now: &Explained, without: &[usize]) -> Asked<'_, Candidate> {
        let screen = self.screen(now, Kept { without, ..Kept::default() });
        Asked::new(screen, self.scale(now), self.options.seed)
    }

    /// The model with the best candidate added, if it is found.
    fn added(&self, now: &Explained) -> Result<Option<Fit>, DiagnoseError> {
        let asked = self.asked(now, &[]);
        let (resolved, found) = (self.resolved(), &now.fit.model.found);
        let candidate = |one: &Ranked| &self.candidates[one.candidate];
        let told = asked.ranked.iter().filter(|one| candidate(one).is_apart(&resolved, found));
        let is_found = |one: &&Ranked| asked.is_found(one, SIGNIFICANT);
        let mut lingering: Vec<&Candidate> = Vec::new();
        let mut tries = 0;
        for one in told.clone().filter(is_found) {
            // What errors that linger explain stands in the way of no other.
            if lingering.iter().any(|other| other.is_same(candidate(one))) {
                continue;
            }
            if tries == MOST_TRIED {
                break;
            }
            let mut added: Vec<Fitted> =
                self.refined(now, &[], one, &asked.screen).into_iter().collect();
            let is_periodic = |one: &&Ranked| candidate(one).forms_are_orders();
            if is_periodic(&one) {
                for other in told.clone().filter(is_periodic) {
                    if added.len() > MOST_ORDERS {
                        break;
                    }
                    if candidate(other).is_apart(&resolved, &added) && is_found(&other) {
                        added.extend(self.refined(now, &[], other, &asked.screen));
                    }
                }
            }
            let below = self.left(now) - PROMISE_KEPT * one.score.drop;
            let Some(fit) = self.with(now, &[], added, below)? else {
                tries += 1;
                continue;
            };
            if !self.lingers(now, &fit, one)? {
                return Ok(Some(fit));
            }
            lingering.push(candidate(one));
        }
        Ok(None)
    }

    /// Whether the last effect of a fit follows time and explains no more than errors that linger do.
    pub(super) fn lingers(
        &self,
        now: &Explained,
        fit: &Fit,
        one: &Ranked,
    ) -> Result<bool, DiagnoseError> {
        if !self.candidates[one.candidate].follows_time() {
            return Ok(false);
        }
        let asked = [fit.model.found.len() - 1];
        if self.chance_in_time(now, fit, &asked)? <= SIGNIFICANT {
            return Ok(false);
        }
        // While something else that follows time is missing, what is left lingers for it. To look once more
        // is another question that chance may answer.
        let Some(more) = self.with_more_in_time(now, fit)? else { return Ok(true) };
        Ok(2.0 * self.chance_in_time(now, &more, &asked)? > SIGNIFICANT)
    }

    /// How far orders of a periodic error must be from each other for the range of each joint to tell
    /// them apart (Rayleigh's limit).
    pub(super) fn resolved(&self) -> Vec<f64> {
        let of_joint = |joint: usize| {
            let angles = self.problem.data.rows.iter().map(|r| r.q[joint]);
            let wide = |[low, high]: [f64; 2], q: f64| [low.min(q), high.max(q)];
            let [low, high] = angles.fold([f64::MAX, f64::MIN], wide);
            std::f64::consts::TAU / (high - low)
        };
        (0..self.problem.arm.dof()).map(of_joint).collect()
    }

    /// The model without the effects `out` and with another; `None` if squares and prior penalty of the exact fit
    /// do not come `below` something, or an end was asked for before it was done.
    pub(super) fn with(
        &self,
        now: &Explained,
        out: &[usize],
        added: Vec<Fitted>,
        below: f64,
    ) -> Result<Option<Fit>, DiagnoseError> {
        let mut model = now.fit.model.clone();
        for &index in out.iter().rev() {
            model.found.remove(index);
        }
        let kept = model.found.len();
        if let Some(one) = added.first() {
            (self.progress)(Stage::Try(kept, one.effect.identifier(), one.spot.place));
        }
        model.found.extend(added);
        let near = &now.fit.predicted.sims;
        let fitted = |model| refit_below(self.problem, model, Some(near), &now.weights, below);
        // An arm that finds no rest with the values of the linear fit begins from none.
        let fit = fitted(model.clone()).or_else(|_| {
            model.found[kept..].iter_mut().for_each(|added| added.values.fill(0.0));
            fitted(model)
        });
        let Some(fit) = fit.ok().filter(|_| !self.stopped()) else { return Ok(None) };
        let left = squares(self.problem, &fit.predicted.gaps, &now.weights);
        Ok((left + prior_penalty(self.problem, &fit.model) <= below).then_some(fit))
    }

    /// The model with every effect as a whole: a form that leaves out numbers is as likely as the
    /// search found it, but nobody has shown that these are 0.
    pub(crate) fn whole(&self, now: Explained) -> Result<Explained, DiagnoseError> {
        let Explained { fit, weights, .. } = &now;
        let mut model = fit.model.clone();
        for found in &mut model.found {
            let Some((whole, spot)) = self.whole_of(found.effect, found.spot) else { continue };
            let mut values = found.values.clone();
            values.resize(whole.size, 0.0);
            *found = whole.fitted(spot, values).unwrap_or_else(|| found.clone());
        }
        if model.parameters(self.problem) == fit.model.parameters(self.problem) {
            return Ok(now);
        }
        let weights = *weights;
        let fit = refit(self.problem, model, Some(&fit.predicted.sims), &weights)?;
        self.converged(fit, weights)
    }

    /// The candidate that has all numbers of a form that leaves some out, and its form; `None` of one that is whole.
    pub(crate) fn whole_of(
        &self,
        effect: &'static dyn Effect,
        spot: Spot,
    ) -> Option<(&Candidate, Spot)> {
        let whole = Spot { form: effect.whole(spot.form), ..spot };
        if effect.forms_are() != Forms::One || whole == spot {
            return None;
        }
        let is_it = |c: &&Candidate| c.effect() == Some((effect, whole));
        self.candidates.iter().find(is_it).map(|candidate| (candidate, whole))
    }

    /// The model without the effects `out` (ascending), fitted again.
    pub(crate) fn fitted_without(
        &self,
        now: Explained,
        out: &[usize],
    ) -> Result<Explained, DiagnoseError> {
        let Explained { fit, weights, .. } = now;
        let mut model = fit.model;
        for &index in out.iter().rev() {
            model.found.remove(index);
        }
        let fit = refit(self.problem, model, Some(&fit.predicted.sims), &weights)?;
        self.converged(fit, weights)
    }
}
