//! The bench as it was fitted along, with intervals.

use super::certainty::Certainty;
use crate::diagnose::data::Thing;
use crate::diagnose::fit::Model;
use crate::diagnose::report::{BenchReport, PairReport};
use crate::diagnose::search::{Explained, Search};
use crate::instrument::{MOST_CONSTANTS, View};
use crate::report::Parameter;

impl Search<'_, '_> {
    /// Every thing of the bench that was unknown. A plane is told by its normal and its distance from the origin.
    pub(super) fn bench(&self, now: &Explained, certainty: &Certainty) -> Vec<BenchReport> {
        let (problem, model) = (self.problem, &now.fit.model);
        let things = problem.bench.iter().zip(&model.bench);
        let mut all = Vec::new();
        for ((Thing { aim, session }, view), at) in things.zip(Model::begins_of_bench(problem)) {
            let mut half = [0.0; MOST_CONSTANTS];
            aim.free.iter().zip(&certainty.half[at..]).for_each(|(free, own)| half[*free] = *own);
            let parameter =
                |name: &'static str, value: f64, half: f64, unit: &'static str| Parameter {
                    name: name.into(),
                    value,
                    unit: unit.into(),
                    ci95: [value - half, value + half],
                    by_command: None,
                };
            let constants = match view {
                View::Plane(plane) => {
                    let [u, v] = plane.axes();
                    let tilted = |u: f64, v: f64| (u * half[0]).hypot(v * half[1]);
                    let normal = ["nx", "ny", "nz"].into_iter().enumerate();
                    let normal = normal
                        .map(|(k, name)| parameter(name, plane.normal[k], tilted(u[k], v[k]), "1"));
                    let offset = tilted(u.dot(&plane.at), v.dot(&plane.at)).hypot(half[2]);
                    normal.chain([parameter("offset", plane.offset(), offset, "m")]).collect()
                }
                _ => {
                    let value = |k: &usize| {
                        let (value, unit) = view.constant(*k);
                        parameter(aim.seen.constant(*k), value, half[*k] * unit, aim.seen.unit(*k))
                    };
                    aim.free.iter().map(value).collect()
                }
            };
            all.push(BenchReport {
                kind: aim.seen.thing().to_owned(),
                name: aim.name.clone(),
                session: (problem.sessions.len() > 1).then(|| problem.sessions[*session].clone()),
                constants,
            });
        }
        all
    }

    /// Every distance between points that is known, and the one that was fitted.
    pub(super) fn pairs_apart(&self, now: &Explained) -> Vec<PairReport> {
        let model = &now.fit.model;
        let each = self.problem.pairs.iter().map(|(pair, [one, other])| PairReport {
            points: pair.points.clone(),
            known: pair.distance,
            sigma: pair.sigma,
            fitted: (one.at(model) - other.at(model)).norm(),
        });
        each.collect()
    }
}
