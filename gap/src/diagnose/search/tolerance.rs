//! What makers tolerate, as these data have it. Told is what is usual of arms; of one arm whose table is off by twice
//! as much, numbers that are held to the usual stay too near the table, and others bend to make up for them.

use nalgebra::DVector;

use super::forward::{Explained, Search};
use crate::diagnose::fit::{Model, refit};
use crate::diagnose::normal_equations::Candidate;
use crate::diagnose::options::DiagnoseError;
use crate::infer::limits::ROUNDS;
use crate::infer::{Basis, Observations, likely_scale};

/// A factor of a tolerance that is nearer to 1 changes no value by more than a tenth of its deviation.
const SAME: f64 = 1.05;

impl Search<'_, '_> {
    /// The model with what was found within makers' tolerances held to the most likely multiple of these, no less
    /// than 1, and fitted again.
    pub(super) fn as_tolerated(&self, mut now: Explained) -> Result<Explained, DiagnoseError> {
        for _ in 0..ROUNDS {
            let Some((index, factor)) = self.looser(&now) else { break };
            let Explained { fit, weights, .. } = now;
            let mut model = fit.model;
            model.found[index].usual.held.iter_mut().for_each(|held| *held /= factor);
            let fit = refit(self.problem, model, Some(&fit.predicted.sims), &weights)?;
            now = self.converged(fit, weights)?;
        }
        Ok(now)
    }

    /// What was found within tolerances that are to be other ones, and by which factor.
    fn looser(&self, now: &Explained) -> Option<(usize, f64)> {
        let (problem, found) = (self.problem, &now.fit.model.found);
        let is_held = |k: &usize| found[*k].effect.is_tolerated();
        let index = (Model::along(problem)..found.len()).find(is_held)?;
        let before = found[..index].iter().map(|f| f.values.len()).sum::<usize>();
        let own = &found[index];
        let told = Candidate::of(problem, own.effect, own.spot, own.usual.multiplicity).usual.held;
        let held = DVector::from_column_slice(&own.usual.held);
        let is_now = told[0] / held[0];
        let t = Basis::new(&self.normal(now)).t;
        let t = t.rows(Model::nuisances(problem) + before, held.len()).into_owned();
        let beside = Basis::new(&(&t * t.transpose())).t;
        let precision = &beside * beside.transpose();
        let precision = precision.map_with_location(|r, c, x| x / (held[r] * held[c]));
        let values = DVector::from_column_slice(&own.values).component_mul(&held);
        let factor = likely_scale(precision, &values, is_now).max(1.0) / is_now;
        (!(1.0 / SAME..SAME).contains(&factor)).then_some((index, factor))
    }
}
