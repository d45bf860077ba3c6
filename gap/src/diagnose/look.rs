//! What the data show, what explains it, and which rows do not fit that.

use nalgebra::Vector6;

use super::data::{Problem, fitting};
use super::fit::Model;
use super::options::DiagnoseError;
use super::report::{CannotSee, Gauge, LeftOut, Part, Share};
use super::search::{Explained, Search};
use super::verdict::Held;
use crate::effects::Effect;
use crate::gap::Statistics;

/// A gap below this, relative to the arm's reach, is rounding error.
const ROUNDING: f64 = 1e-12;

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
        let size = Statistics::of(&self.problem.kept(&before));
        let is_there = size.position_max > ROUNDING * (1.0 + self.problem.reach)
            || size.rotation_rms > ROUNDING;
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
            None if is_there => self.explain(begun)?,
            None => begun,
        };
        Ok(Looked { start, before, is_there, cannot_see, gauge, places, parts, explained })
    }

    /// Which rows fit an explanation, and how far those that do not are from it.
    pub(crate) fn fitting(
        &self,
        now: &Explained,
    ) -> Result<(Vec<bool>, Vec<LeftOut>), DiagnoseError> {
        let rows = &self.problem.data.rows;
        let all = Problem { fits: vec![true; rows.len()], ..self.problem.clone() };
        let gaps = now.fit.model.predict(&all, Some(&now.fit.predicted.sims))?.gaps;
        let fits = fitting(self.problem, &now.noise, &gaps);
        let out = rows.iter().zip(&gaps).zip(&fits).filter(|(_, fits)| !**fits);
        let told = out.map(|((row, gap), _)| LeftOut {
            line: row.line,
            position: gap.fixed_rows::<3>(0).norm(),
            rotation: gap.fixed_rows::<3>(3).norm(),
        });
        let told = told.collect();
        Ok((fits, told))
    }
}
