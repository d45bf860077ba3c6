//! Whose axes loads and gravity are told in, as far as the data say so.

use nalgebra::Isometry3;

use super::forward::{Explained, Search};
use crate::constants::LARGE_ANGLE;
use crate::diagnose::fit::{Axes, Model, prior_penalty, refit_below, squares};
use crate::diagnose::options::DiagnoseError;
use crate::infer::constants::DISTINGUISHABLE;
use crate::infer::{Observations, costs};

impl Search<'_, '_> {
    /// The same with loads and gravity in the measuring frame's axes, if the data are rather those of it than of the
    /// arm's. A tilt of gravity that was found is then not needed.
    pub(crate) fn with_loads_as_measured(
        &self,
        now: &Explained,
    ) -> Result<Option<Model>, DiagnoseError> {
        let (problem, model) = (self.problem, &now.fit.model);
        let lean = |base: &Isometry3<f64>| {
            let own = &problem.arm.gravity;
            own.angle(&Axes::Measuring.gravity(base, own))
        };
        let turned = model.bases.iter().any(|base| base.rotation.angle() > 0.0);
        let leans = turned && model.bases.iter().all(|base| lean(base) <= LARGE_ANGLE);
        if model.axes == Axes::Measuring || !leans || problem.nominal.is_some() || self.stopped() {
            return Ok(None);
        }
        let (left, scale) = (self.left(now), self.scale(now));
        let variance = scale.variance(left, model.parameters(problem));
        let tilt = model.found.iter().position(|found| found.effect.tilts_gravity());
        let cost = tilt.map_or(0.0, |k| costs(self, now, variance)[k]);
        let mut other = model.clone();
        other.axes = Axes::Measuring;
        other.found.retain(|found| !found.effect.tilts_gravity());
        let below = left + variance * (cost - DISTINGUISHABLE);
        let fit = refit_below(problem, other, None, &now.weights, below);
        let fit = match fit {
            // A frame that lies on its side lets the arm fall.
            Err(DiagnoseError::Unstable { .. }) => return Ok(None),
            fit => fit?,
        };
        let left = squares(problem, &fit.predicted.gaps, &now.weights)
            + prior_penalty(problem, &fit.model);
        Ok((left < below).then_some(fit.model))
    }
}
