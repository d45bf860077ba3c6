//! What the data show, what explains it, and which rows do not fit that.

use nalgebra::Vector6;

use super::data::{LARGEST, Precision, Problem, fitting};
use super::fit::Model;
use super::options::DiagnoseError;
use super::report::{CannotSee, Gauge, LeftOut, Part, Share};
use super::search::{Explained, Search};
use super::verdict::Held;
use crate::effects::Effect;
use crate::infer::{Basis, Observations};
use crate::parallel;

/// What was seen before anything was found, and what explains it.
pub(crate) struct Looked {
    /// What is fitted along, alone, without the states of the rows.
    pub(crate) start: Explained,
    /// Gaps that it leaves, each row's by a fit that has not seen it.
    pub(crate) before: Vec<Vector6<f64>>,
    /// Whether these are more than rounding.
    pub(crate) is_there: bool,
    pub(crate) cannot_see: Vec<CannotSee>,
    pub(crate) gauge: Vec<Gauge>,
    pub(crate) places: Vec<Share>,
    pub(crate) parts: Vec<Part>,
    pub(crate) explained: Explained,
}

impl Search<'_, '_> {
    /// Looks from `model`, in which nothing is found; the search goes on from what is `known`.
    pub(crate) fn look(
        &self,
        effects: &[&'static dyn Effect],
        model: &Model,
        known: Option<Model>,
    ) -> Result<Looked, DiagnoseError> {
        let begun = self.begin(model.clone())?;
        let mut before = begun.fit.predicted.gaps.clone();
        let is_there = self.problem.is_there(&before);
        let seen = self.first(&begun);
        let cannot_see = self.cannot_see(effects, &begun, &seen);
        let gauge = self.gauges(&seen);
        let (mut places, mut parts) = (Vec::new(), Vec::new());
        if is_there {
            places = self.shares(&begun, &seen);
            self.begin_with(&begun, seen);
            if begun.fit.model.parameters(self.problem) > 0 {
                before = Held::new(self, &begun).without_findings();
            }
            parts = self.parts(&begun);
        }
        let start = begun.without_states();
        let explained = match known {
            Some(model) => self.explain(self.begin(model)?)?,
            None if is_there => self.explain(self.with_springs_of_log(begun)?)?,
            None => begun,
        };
        Ok(Looked { start, before, is_there, cannot_see, gauge, places, parts, explained })
    }

    /// Which rows fit an explanation, how far those that do not are from it, and how precise each row
    /// is.
    pub(crate) fn fitting(
        &self,
        now: &Explained,
    ) -> Result<(Vec<bool>, Vec<LeftOut>, Precision), DiagnoseError> {
        let rows = &self.problem.data.rows;
        let all = Problem { fits: vec![true; rows.len()], ..self.problem.clone() };
        let (model, sims) = (&now.fit.model, &now.fit.predicted.sims);
        let normal = (!self.problem.fits.iter().all(|fits| *fits)).then(|| self.normal(now));
        let basis = normal.map(|normal| Basis::new(&normal));
        // Of each row its gap, and the same as far as a model that was fitted without it is known; none
        // where the model comes to no rest.
        let seen = |row: usize| -> Option<[Vector6<f64>; 2]> {
            let (sim, gap) = model.seen(&all, row, sims.get(row)).ok()?;
            let Some(basis) = basis.as_ref().filter(|_| !self.problem.fits[row]) else {
                return Some([gap, gap]);
            };
            let mut block = model.change(&all, &sim, row, |s| model.block(&all, row, s));
            let weights = all.weights(row, &now.weights);
            block.column_iter_mut().for_each(|mut column| column.component_mul_assign(&weights));
            let doubt = block * &basis.t;
            let of = |k: usize| gap[k] / (1.0 + doubt.row(k).norm_squared()).sqrt();
            Some([gap, Vector6::from_fn(|k, _| of(k))])
        };
        let seen = parallel::map(rows.len(), &seen);
        let farthest = [Vector6::repeat(LARGEST); 2];
        let judged: Vec<_> = seen.iter().map(|both| both.unwrap_or(farthest)[1]).collect();
        let fits = fitting(self.problem, &now.noise, &judged);
        let out = rows.iter().zip(&seen).zip(&fits).filter(|(_, fits)| !**fits);
        let told = out.map(|((row, seen), _)| {
            let size = |from| seen.map(|[gap, _]| gap.fixed_rows::<3>(from).norm());
            let session = row.session.clone().filter(|_| self.problem.sessions.len() > 1);
            LeftOut { line: row.line, session, position: size(0), rotation: size(3) }
        });
        let told = told.collect();
        let gaps: Vec<_> =
            seen.iter().map(|both| both.map_or_else(Vector6::zeros, |b| b[0])).collect();
        let parameters = now.fit.model.parameters(self.problem);
        let precision = Precision::beyond(self.problem.data, &gaps, &fits, parameters);
        Ok((fits, told, precision))
    }
}
