//! What the data show, what explains it, and which rows do not fit that.

use nalgebra::Vector6;

use super::data::{Precision, Problem, fitting};
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
        let size = Statistics::of(self.problem.kept(&before));
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

    /// Which rows fit an explanation, how far those that do not are from it, and how precise each row
    /// is.
    pub(crate) fn fitting(
        &self,
        now: &Explained,
    ) -> Result<(Vec<bool>, Vec<LeftOut>, Precision), DiagnoseError> {
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
        let parameters = now.fit.model.parameters(self.problem);
        let precision = Precision::beyond(self.problem.data, &gaps, &fits, parameters);
        Ok((fits, told, precision))
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{data, normal};
    use crate::diagnose::data::{Stream, generator};
    use crate::diagnose::{Options, diagnose};
    use crate::fixture::bent;
    use crate::measurement::Kind;
    use crate::simulate::simulate;

    #[test]
    fn rows_that_do_not_fit_are_named_and_leave_the_rest_as_it_is() {
        let clean = data(20, [0.0, 4e-6, 0.0], 2e-5, 11);
        let mut bad = clean.clone();
        bad.rows[9].measured[0] += 5e-3;
        bad.rows[30].measured[2] -= 4e-3;
        let options = Options::default();
        let [without, with] = [&clean, &bad].map(|data| diagnose(&bent(), data, &options).unwrap());
        assert!(without.left_out.is_empty(), "{:?}", without.left_out);
        let [first, second] = &with.left_out[..] else { panic!("{:?}", with.left_out) };
        assert_eq!([first.line, second.line], [bad.rows[9].line, bad.rows[30].line]);
        // The noise of three numbers, some four of its deviations.
        assert!((first.position - 5e-3).abs() < 1e-4 && (second.position - 4e-3).abs() < 1e-4);
        for d in [&without, &with] {
            let [finding] = &d.findings[..] else { panic!("{:?}", d.findings) };
            assert_eq!((finding.effect, finding.place.as_str()), ("joint_compliance", "joint 2"));
            let [low, high] = finding.parameters[0].ci95;
            assert!((low..=high).contains(&4e-6), "{low} {high}");
        }
        assert!((with.gap.after.position_rms / without.gap.after.position_rms - 1.0).abs() < 0.1);
        let kept = Options { keep_all: true, ..Options::default() };
        let kept = diagnose(&bent(), &bad, &kept).unwrap();
        assert!(kept.left_out.is_empty());
        assert!(kept.gap.after.position_rms > 10.0 * with.gap.after.position_rms);
    }

    #[test]
    fn ordinary_calibration_is_one_finding_or_fitted_along() {
        let mut plant = bent();
        let mut dice = generator(3, Stream::Signs);
        for joint in &mut plant.joints {
            joint.theta += 5e-4 * normal(&mut dice);
            joint.alpha += 5e-4 * normal(&mut dice);
            joint.a += 3e-4 * normal(&mut dice);
            joint.d += 3e-4 * normal(&mut dice);
        }
        let mut data = data(40, [0.0; 3], 0.0, 4);
        for row in &mut data.rows {
            let exact = simulate(&plant, row, Kind::Pose { orientation: true }).unwrap();
            row.measured = exact.reading().vector().map(|x| x + 2e-5 * normal(&mut dice));
        }
        let found = diagnose(&bent(), &data, &Options::default()).unwrap();
        let [finding] = &found.findings[..] else { panic!("{:?}", found.findings) };
        assert_eq!((finding.effect, finding.place.as_str()), ("geometry", "arm"));
        assert!(found.gap.after.position_rms < 1.2 * found.gap.noise.position_rms);
        let mut along = Options::default();
        along.fit_along(&["geometry".to_owned()]).unwrap();
        let found = diagnose(&bent(), &data, &along).unwrap();
        assert!(found.findings.is_empty(), "{:?}", found.findings);
        assert!(found.gap.before.position_rms < 1.2 * found.gap.noise.position_rms);
        let nested = Options { nested: true, ..Options::default() };
        let nested = diagnose(&bent(), &data, &nested).unwrap().gap;
        let left = nested.nested.unwrap().position_rms / nested.after.position_rms;
        assert!((0.9..1.2).contains(&left), "{left}");
    }
}
