//! The measurement that would tell a finding from its nearest rival: out of a pool of the poses of
//! this data under loads along each axis, the one at which the two predict readings furthest apart.

use nalgebra::{DVector, Matrix6xX, Vector6};

use super::outcome::Group;
use crate::diagnose::normal_equations::Candidate;
use crate::diagnose::search::{Explained, Search};
use crate::infer::limits::SOME_ROWS;
use crate::instrument::View;
use crate::measurement::Row;
use crate::simulate::Sim;

/// A load to try where the data has none, N.
const USUAL: f64 = 100.0;

/// Part of the reach beyond which a prediction is no prediction.
const FAR: f64 = 0.03;

/// How much larger a load than any of the data may be asked for.
const MORE: f64 = 1.5;

impl Search<'_, '_> {
    /// What to measure, in words.
    pub(crate) fn separating(
        &self,
        now: &Explained,
        group: &Group,
        (rival, values): &(Candidate, Vec<f64>),
    ) -> String {
        let rows = &self.problem.data.rows;
        let every = rows.len().div_ceil(SOME_ROWS).max(1);
        let strongest = rows.iter().map(|r| r.wrench.fixed_rows::<3>(0).norm()).fold(0.0, f64::max);
        let force = if strongest > 0.0 { strongest * MORE } else { USUAL };
        let rival_values = DVector::from_column_slice(values);
        let mut best: Option<(f64, usize, Vector6<f64>, f64)> = None;
        for (index, row) in rows.iter().enumerate().step_by(every) {
            for wrench in loads(row, force) {
                let Some(apart) = self.apart(now, group, rival, &rival_values, index, &wrench)
                else {
                    continue;
                };
                let white = apart.component_mul(&now.weights).norm();
                let first = if self.problem.measures_position() { 0 } else { 3 };
                let plain = apart.fixed_rows::<3>(first).norm();
                if best.is_none_or(|(most, ..)| white > most) {
                    best = Some((white, index, wrench, plain));
                }
            }
        }
        let found = &now.fit.model.found[group[0]];
        let here = format!("{} at {}", words(found.effect.identifier()), found.spot.place);
        let Some((effect, spot)) = rival.effect() else { return String::new() };
        let there = format!("{} at {}", words(effect.identifier()), spot.place);
        let Some((white, index, wrench, plain)) = best.filter(|b| b.0 > 1.0) else {
            return format!("no load at a pose of these data distinguishes {here} from {there}");
        };
        let size = match rows[index].view(self.problem.data.kind).map(|view| view.unit()) {
            Some((part, "px")) => format!("{:.2} px", plain / part),
            _ if self.problem.measures_position() => format!("{:.3} mm", plain * 1e3),
            _ => format!("{:.3} mrad", plain * 1e3),
        };
        let pose = match &rows[index].pose {
            Some(id) => format!("pose {id}"),
            None => format!("the pose of line {}", rows[index].line),
        };
        format!(
            "measure {pose} with {}: there {here} and {there} predict measurements {size} apart, {white:.1} \
             times the noise",
            load_in_words(&wrench)
        )
    }

    /// What the two explanations differ by at one row under one load.
    fn apart(
        &self,
        now: &Explained,
        group: &Group,
        rival: &Candidate,
        values: &DVector<f64>,
        row: usize,
        wrench: &Vector6<f64>,
    ) -> Option<Vector6<f64>> {
        let (model, when) = (&now.fit.model, self.problem.moments.at(row));
        let mut moved = self.problem.data.rows[row].clone();
        moved.wrench = *wrench;
        let actual = |with: bool| {
            let mut actual = crate::simulate::Actual::new(&model.arm, &moved.q, &moved.wrench);
            actual.base = model.bases[self.problem.stands.base_of[row]];
            let known = self.problem.known.iter();
            known.for_each(|known| known.alter(&mut actual, &moved, &when));
            for (index, found) in model.found.iter().enumerate() {
                if with || !group.contains(&index) {
                    found.effect.alter(&mut actual, &moved, &when, found.spot, &found.values);
                }
            }
            actual
        };
        let without = actual(false);
        let with = actual(true);
        let state = crate::simulate::rest(&without, None).ok()?;
        let found = crate::simulate::rest(&with, None).ok()?;
        let point = state.tool.translation.vector;
        let scene = crate::effects::Scene {
            nominal: self.problem.arm,
            row: &moved,
            when: &when,
            actual: &without,
            state: &state,
            point,
            base: &without.base,
        };
        let shift = found.tool.translation.vector - point;
        let turn = (found.tool.rotation * state.tool.rotation.inverse()).scaled_axis();
        let finding = Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z);
        let other = rival.block(&scene) * values;
        let far = FAR * self.problem.reach;
        let size = |v: &Vector6<f64>| v.fixed_rows::<3>(0).norm();
        if size(&finding) > far || size(&other) > far {
            return None;
        }
        let view =
            |of: View| self.problem.bench_of[row].map_or(of, |k| model.bench[k].pointed(&of));
        let sim = Sim {
            loaded: state.clone(),
            unloaded: None,
            measured: model.measured(self.problem, row),
            base: without.base,
            metre: without.metre,
            view: moved.view(self.problem.data.kind).map(view),
        };
        let apart = Matrix6xX::from_columns(&[finding - other]);
        let apart: Vector6<f64> = sim.change(|_, _| apart.clone()).column(0).into_owned();
        apart.iter().all(|x| x.is_finite()).then(|| apart.component_mul(&self.problem.mask))
    }
}

/// The row's own load, and a force along each axis.
fn loads(row: &Row, force: f64) -> Vec<Vector6<f64>> {
    let mut loads = vec![row.wrench];
    for axis in 0..3 {
        loads.extend([force, -force].map(|f| Vector6::ith(axis, f)));
    }
    loads
}

/// An identifier as it is said.
fn words(identifier: &str) -> String {
    identifier.replace('_', " ")
}

fn sign(value: f64) -> &'static str {
    if value < 0.0 { "−" } else { "" }
}

fn load_in_words(wrench: &Vector6<f64>) -> String {
    let names = ["x", "y", "z"];
    let forces = (0..3).filter(|&k| wrench[k].abs() > 0.0);
    let parts: Vec<String> = forces
        .map(|k| format!("{:.0} N along {}{}", wrench[k].abs(), sign(wrench[k]), names[k]))
        .collect();
    if parts.is_empty() { "no load".to_owned() } else { parts.join(", ") }
}
