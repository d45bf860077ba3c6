//! The findings and frames as they are reported.

use nalgebra::{Isometry3, UnitQuaternion, Vector3};

use super::bootstrap::shrink;
use super::certainty::Certainty;
use super::outcome::{Group, Shrinking};
use super::refitted::Refitted;
use super::rivals::Rivals;
use crate::diagnose::data::{Problem, Thing};
use crate::diagnose::fit::Model;
use crate::diagnose::options::Nuisance;
use crate::diagnose::report::{Cover, NuisanceReport};
use crate::diagnose::search::{Explained, Search};
use crate::infer::interval;
use crate::instrument::View;
use crate::report::{Finding, HeldOutGap, Parameter};
use crate::shrink::Shrink;

impl Search<'_, '_> {
    /// Each group, in order, with what it takes of the gap and its rivals, still without its numbers. `before` is how
    /// far the robot file as it is leaves each row.
    pub(crate) fn findings(
        &self,
        now: &Explained,
        groups: &[Group],
        rivals: Vec<Rivals>,
        before: &[f64],
        shrinking: &Shrinking,
        refitted: &Refitted,
    ) -> Vec<Finding> {
        let mut last = before.to_vec();
        let whole = self.problem.rms(before);
        let each = groups.iter().zip(rivals).enumerate().map(|(number, (group, rivals))| {
            let first = &now.fit.model.found[group[0]];
            let after = shrinking.sizes_after(number + 1);
            let to_separate =
                rivals.nearest.as_ref().map(|rival| self.separating(now, group, rival));
            let held_out = HeldOutGap::AtRest {
                held_out: self.shrink(&last, &after, refitted.spread(number, number + 1)),
            };
            last = after;
            Finding {
                effect: first.effect.identifier().into(),
                place: first.spot.place.to_string(),
                parameters: Vec::new(),
                share: held_out.share(whole),
                held_out,
                p_value: rivals.doubt.p_value,
                stability: Some(rivals.stability),
                alternatives: rivals.alternatives,
                to_separate: Some(to_separate),
            }
        });
        each.collect()
    }

    /// From sizes of gaps to others of the same rows, the logarithm of whose ratio scatters by `spread`.
    pub(super) fn shrink(&self, before: &[f64], after: &[f64], spread: f64) -> Shrink {
        let sum = |sizes: &[f64]| sizes.iter().map(|s| s * s).sum();
        let shrink = shrink(sum(before), sum(after));
        Shrink {
            before: self.problem.rms(before),
            after: self.problem.rms(after),
            shrink,
            shrink_ci95: interval(shrink, spread, self.folds.blocks()),
        }
    }

    /// The values of each effect found, with 95 % intervals.
    pub(super) fn intervals(&self, now: &Explained, certainty: &Certainty) -> Vec<Vec<Parameter>> {
        let searched = self.half_with_searched(now);
        let beside = |at: usize| searched.get(at).copied().unwrap_or(0.0);
        let half = certainty.half.iter().enumerate().map(|(at, half)| half.max(beside(at)));
        let mut half = half.skip(Model::nuisances(self.problem));
        let mut all = Vec::new();
        for (index, found) in now.fit.model.found.iter().enumerate() {
            let mut reports = Vec::new();
            if let Some(form) = found.effect.form_number() {
                let (name, unit) = (form.name, form.quantity.unit());
                let value = found.effect.forms_are().number(found.spot.form);
                let half = self.at_searched(now, index).map_or(0.0, beside);
                reports.push(Parameter {
                    name,
                    value,
                    unit: unit.into(),
                    ci95: [value - half, value + half],
                    by_command: None,
                });
            }
            let parameters = found.effect.parameters(self.problem.arm, found.spot);
            for ((parameter, &value), half) in parameters.iter().zip(&found.values).zip(&mut half) {
                reports.push(Parameter {
                    name: parameter.name.clone(),
                    value,
                    unit: parameter.quantity.unit_by(self.problem.data.is_timed()).into(),
                    ci95: [value - half, value + half],
                    by_command: None,
                });
            }
            all.push(reports);
        }
        all
    }
}

/// The frames that were fitted along.
pub(crate) fn nuisances(problem: &Problem<'_>, model: &Model) -> Vec<NuisanceReport> {
    let of =
        |session: usize| (problem.sessions.len() > 1).then(|| problem.sessions[session].clone());
    let frame = |name: &str, at: &Isometry3<f64>, session| NuisanceReport {
        name: name.to_owned(),
        session,
        translation: at.translation.vector.into(),
        rotation: at.rotation.scaled_axis().into(),
    };
    let frames = problem.frames().map(|(nuisance, number)| {
        let at = match nuisance {
            Nuisance::BaseFrame => model.bases[number],
            Nuisance::ToolFrame => model.tool(number),
        };
        frame(nuisance.identifier(), &at, problem.frame_of((nuisance, number)))
    });
    let point =
        |name: &str, at: &Vector3<f64>, session| frame(name, &Isometry3::from(*at), session);
    let markers = problem.markers.iter().zip(&model.markers);
    let markers = markers.map(|(name, at)| point(name, at, None));
    let bench =
        problem.bench.iter().zip(&model.bench).filter_map(|(Thing { aim, session }, view)| {
            let name = if aim.name.is_empty() { aim.seen.thing() } else { &aim.name };
            match view {
                View::Plane(plane) => {
                    let turn = UnitQuaternion::rotation_between(&Vector3::z(), &plane.normal);
                    let at = Isometry3::from_parts(plane.at.into(), turn.unwrap_or_default());
                    Some(frame(name, &at, of(*session)))
                }
                _ => Some(point(name, &view.place()?, of(*session))),
            }
        });
    frames.chain(markers).chain(bench).collect()
}

/// Where the data has been.
pub(crate) fn cover(problem: &Problem<'_>) -> Cover {
    let joint = |j: usize| {
        let values = problem.kept_rows().map(|r| r.q[j]);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], q| [low.min(q), high.max(q)])
    };
    let largest = |from: usize| {
        let loads = problem.kept_rows().map(|r| r.wrench.fixed_rows::<3>(from).norm());
        loads.fold(0.0, f64::max)
    };
    Cover {
        joints: (0..problem.arm.dof()).map(joint).collect(),
        force: largest(0),
        moment: largest(3),
    }
}
