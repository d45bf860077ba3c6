//! The explanation so far: the frames as they were fitted and the effects that have been found, as
//! an exact model of every row.

use std::borrow::Cow;

use nalgebra::{DMatrix, DVector, Isometry3, Matrix6xX, Point3, Vector3, Vector6};
use stiffarm_kernels::generic::Arm;

use super::axes::Axes;
use super::bond::Bond;
use crate::diagnose::data::{LARGEST, Problem, Thing};
use crate::diagnose::normal_equations::Candidate;
use crate::diagnose::options::{DiagnoseError, Nuisance};
use crate::displacement::Displacement;
use crate::effects::{Depends, Effect, JOINT_SPRING, Known, Place, Scene, Spot, file_name};
use crate::gap::row_gap;
use crate::infer::Usual;
use crate::instrument::View;
use crate::parallel;
use crate::simulate::{Actual, Moment, Sim, Site, State};

/// An effect with its values.
#[derive(Clone)]
pub(crate) struct Fitted {
    pub(crate) effect: &'static dyn Effect,
    pub(crate) spot: Spot,
    pub(crate) values: Vec<f64>,
    pub(crate) usual: Usual,
    /// By how much more evidence it had than any other when last compared; 0 before.
    pub(crate) margin: f64,
}

impl Fitted {
    /// Whether it is the spring of a joint (from 0).
    pub(crate) fn is_spring_of(&self, joint: usize) -> bool {
        self.effect == JOINT_SPRING && self.spot == Spot::at(Place::Joint(joint + 1))
    }

    /// As an effect that is known; what happened in the session of `file` is there alone.
    pub(crate) fn known(&self, file: &str) -> Known {
        let session = || file_name(file).to_owned();
        Known {
            effect: self.effect,
            spot: self.spot,
            values: self.values.clone(),
            session: (self.effect.depends() == Depends::Session).then(session),
            at: Default::default(),
        }
    }
}

/// An exact model of the data.
#[derive(Clone)]
pub(crate) struct Model {
    /// The arm of the robot file, its tool where the fit has put it: what is measured, and where
    /// loads act.
    pub(crate) arm: Arm,
    /// Where each board or camera that is on the tool sits in the tool frame, at which loads act all the same.
    pub(crate) mounts: Vec<Isometry3<f64>>,
    /// Where the base stands in each measuring frame.
    pub(crate) bases: Vec<Isometry3<f64>>,
    /// Whose axes loads and gravity are told in.
    pub(crate) axes: Axes,
    /// Where the unknown markers are on the tool, m.
    pub(crate) markers: Vec<Vector3<f64>>,
    /// The unknown things of the bench.
    pub(crate) bench: Vec<View>,
    pub(crate) found: Vec<Fitted>,
}

/// Of more rows the states are worked out again wherever they are asked for: they would be most of the
/// memory, and to find one again is less than what is done with it.
const MOST_KEPT: usize = 10_000;

/// What a model makes of the data.
#[derive(Clone)]
pub(crate) struct Predicted {
    /// The states of each row; of very many rows, none.
    pub(crate) sims: Vec<Sim>,
    /// Measured minus predicted, one per row, less the mean of the rows that share a constant; 0 of
    /// rows that are left out.
    pub(crate) gaps: Vec<Vector6<f64>>,
}

impl Model {
    /// The robot file as it is, with the geometry to be fitted along if that is unknown.
    pub(crate) fn nominal(problem: &Problem<'_>) -> Self {
        let along = problem.along.and_then(|effect| {
            let spot = Spot { place: Place::Arm, form: 0 };
            let candidate = Candidate::of(problem, effect, spot, 1);
            candidate.fitted(spot, vec![0.0; candidate.size])
        });
        Self {
            arm: problem.arm.clone(),
            mounts: vec![Isometry3::identity(); problem.stands.mounts.len()],
            bases: vec![problem.arm.base; problem.stands.bases.len()],
            axes: Axes::Arm,
            markers: vec![Vector3::zeros(); problem.markers.len()],
            bench: problem.bench.iter().map(|thing| thing.aim.view).collect(),
            found: along.into_iter().collect(),
        }
    }

    /// How many of the effects, from the first, are fitted along and never findings.
    pub(crate) fn along(problem: &Problem<'_>) -> usize {
        usize::from(problem.along.is_some())
    }

    /// The arm in one row, loaded or not.
    pub(crate) fn actual(&self, problem: &Problem<'_>, row: usize, loaded: bool) -> Actual<'_> {
        let (data, when) = (&problem.data.rows[row], &problem.moments.at(row));
        let wrench = if loaded { data.wrench } else { Vector6::zeros() };
        let mut actual = Actual::new(&self.arm, &data.q, &wrench);
        actual.base = self.bases[problem.stands.base_of[row]];
        self.axes.tell(&mut actual);
        problem.known.iter().for_each(|known| known.alter(&mut actual, data, when));
        for found in &self.found {
            found.effect.alter(&mut actual, data, when, found.spot, &found.values);
        }
        actual
    }

    /// The measured frame of a row in the tool frame.
    pub(crate) fn measured(&self, problem: &Problem<'_>, row: usize) -> Isometry3<f64> {
        let offset = match problem.marker_of[row] {
            Some(marker) => self.markers[marker],
            None => problem.data.rows[row].offset.unwrap_or_default().into(),
        };
        let offset = Isometry3::translation(offset.x, offset.y, offset.z);
        problem.stands.mount_of[row].map_or(offset, |mount| self.mounts[mount] * offset)
    }

    /// Brings one row to rest; `near` is where to begin.
    pub(crate) fn sim(
        &self,
        problem: &Problem<'_>,
        row: usize,
        near: Option<&Sim>,
    ) -> Result<Sim, DiagnoseError> {
        self.at_rest(problem, row, near, true)
    }

    /// The same with its load or without.
    fn at_rest(
        &self,
        problem: &Problem<'_>,
        row: usize,
        near: Option<&Sim>,
        load: bool,
    ) -> Result<Sim, DiagnoseError> {
        let measured = self.measured(problem, row);
        let at_rest = Sim::of(problem.data.kind, measured, near, |loaded| {
            self.actual(problem, row, loaded && load)
        });
        let known = problem.data.rows[row].view(problem.data.kind);
        let fitted =
            |view: View| problem.bench_of[row].map_or(view, |k| self.bench[k].pointed(&view));
        let view = known.map(fitted);
        Ok(at_rest.map_err(|_| problem.unstable(row))?.seen_by(view))
    }

    /// Brings every row to rest; `near` is where to begin.
    pub(crate) fn predict(
        &self,
        problem: &Problem<'_>,
        near: Option<&[Sim]>,
    ) -> Result<Predicted, DiagnoseError> {
        let rows = problem.data.rows.len();
        let seen = |row: usize| {
            let near = near.and_then(|near| near.get(row));
            if problem.fits[row] {
                return self.seen(problem, row, near);
            }
            // Nothing is asked of it: its load may be more than the arm bears.
            let unloaded = |_| self.at_rest(problem, row, None, false);
            Ok((self.sim(problem, row, near).or_else(unloaded)?, Vector6::zeros()))
        };
        let (sims, mut gaps): (Vec<Sim>, Vec<Vector6<f64>>) = if rows <= MOST_KEPT {
            parallel::tried(rows, &seen)?.into_iter().unzip()
        } else {
            (Vec::new(), parallel::tried(rows, &|row| seen(row).map(|(_, gap)| gap))?)
        };
        for rows in &problem.constants {
            let mean = rows.iter().map(|&row| gaps[row]).sum::<Vector6<f64>>() / rows.len() as f64;
            rows.iter().for_each(|&row| gaps[row] -= mean);
        }
        Ok(Predicted { sims, gaps })
    }

    /// The states of one row, and its gap.
    pub(crate) fn seen(
        &self,
        problem: &Problem<'_>,
        row: usize,
        near: Option<&Sim>,
    ) -> Result<(Sim, Vector6<f64>), DiagnoseError> {
        let sim = self.sim(problem, row, near)?;
        let reading = problem.with_own_sim(row, &sim.reading(), &sim.base);
        let gap = row_gap(problem.data, &problem.data.rows[row], &reading);
        let is_small = gap.iter().all(|g| g.abs() < LARGEST);
        if is_small { Ok((sim, gap)) } else { Err(problem.unstable(row)) }
    }

    /// The states of a row that was predicted. There is an error only where there was one then.
    pub(crate) fn state<'s>(
        &self,
        problem: &Problem<'_>,
        predicted: &'s Predicted,
        row: usize,
    ) -> Result<Cow<'s, Sim>, DiagnoseError> {
        match predicted.sims.get(row) {
            Some(sim) => Ok(Cow::Borrowed(sim)),
            None => self.sim(problem, row, None).map(Cow::Owned),
        }
    }

    /// Change of one row's reading, 6×p, by what `twists` gives for a scene.
    pub(crate) fn change(
        &self,
        problem: &Problem<'_>,
        sim: &Sim,
        row: usize,
        twists: impl Fn(&Scene<'_>) -> Matrix6xX<f64>,
    ) -> Matrix6xX<f64> {
        let when = problem.moments.at(row);
        sim.change(|state, loaded| {
            let actual = self.actual(problem, row, loaded);
            twists(&self.scene(problem, row, (sim, state), &actual, &when))
        })
    }

    pub(crate) fn scene<'s>(
        &self,
        problem: &'s Problem<'_>,
        row: usize,
        (sim, state): (&'s Sim, &'s State),
        actual: &'s Actual<'s>,
        when: &'s Moment,
    ) -> Scene<'s> {
        Scene {
            nominal: problem.arm,
            row: &problem.data.rows[row],
            when,
            actual,
            state,
            point: sim.point(state),
            base: &sim.base,
        }
    }

    /// The first parameter of each unknown thing of the bench: they are the last of the nuisances.
    pub(crate) fn begins_of_bench(problem: &Problem<'_>) -> Vec<usize> {
        let first = 6 * problem.frames().count() + 3 * problem.markers.len();
        let begin = |at: &mut usize, thing: &Thing| {
            let begin = *at;
            *at += thing.aim.free.len();
            Some(begin)
        };
        problem.bench.iter().scan(first, begin).collect()
    }

    /// Number of nuisance parameters.
    pub(crate) fn nuisances(problem: &Problem<'_>) -> usize {
        let bench = problem.bench.iter().map(|thing| thing.aim.free.len());
        6 * problem.frames().count() + 3 * problem.markers.len() + bench.sum::<usize>()
    }

    /// Number of parameters: of the nuisances first, then of each effect found.
    pub(crate) fn parameters(&self, problem: &Problem<'_>) -> usize {
        Self::nuisances(problem) + self.found.iter().map(|f| f.values.len()).sum::<usize>()
    }

    /// Twists by all the parameters, in that order, at one scene.
    pub(crate) fn block(&self, problem: &Problem<'_>, row: usize, s: &Scene<'_>) -> Matrix6xX<f64> {
        let mut block = Matrix6xX::zeros(self.parameters(problem));
        let mut column = 0;
        let mut put = |part: &Matrix6xX<f64>| {
            block.columns_mut(column, part.ncols()).copy_from(part);
            column += part.ncols();
        };
        let units: [Vector6<f64>; 6] = std::array::from_fn(|k| Vector6::ith(k, 1.0));
        for (frame, number) in problem.frames() {
            put(&match (frame, problem.stands.mount_of[row]) {
                _ if !problem.is_told_of(row, (frame, number)) => Matrix6xX::zeros(6),
                (Nuisance::BaseFrame, _) => s.state.base_moved(),
                (Nuisance::ToolFrame, Some(mount)) => mount_moved(&self.mounts[mount], s.state),
                (Nuisance::ToolFrame, None) if !self.mounts.is_empty() => Matrix6xX::zeros(6),
                (Nuisance::ToolFrame, None) => s.carried(Site::Tool, &units),
            });
        }
        for marker in 0..problem.markers.len() {
            let mut shifts = Matrix6xX::zeros(3);
            if problem.marker_of[row] == Some(marker) {
                let turn = s.state.tool.rotation.to_rotation_matrix();
                shifts.fixed_view_mut::<3, 3>(0, 0).copy_from(turn.matrix());
            }
            put(&shifts);
        }
        for (number, (thing, view)) in problem.bench.iter().zip(&self.bench).enumerate() {
            let mut twists = Matrix6xX::zeros(thing.aim.free.len());
            if problem.bench_of[row] == Some(number) {
                // The tool's way in base axes that reads as much as each constant.
                let view = s.row.view(problem.data.kind).map_or(*view, |of| view.pointed(&of));
                let back = s.base.rotation.inverse().to_rotation_matrix();
                let mount = problem.stands.mount_of[row].map(|mount| self.mounts[mount].rotation);
                let turn = s.base.rotation * s.state.tool.rotation * mount.unwrap_or_default();
                let at = (s.base * Point3::from(s.point)).coords * s.actual.metre;
                let all = view.as_twists(&Isometry3::from_parts(at.into(), turn));
                twists = all.select_columns(thing.aim.free);
                for mut column in twists.column_iter_mut() {
                    let shift = back * column.fixed_rows::<3>(0) / s.actual.metre;
                    let turn = back * column.fixed_rows::<3>(3);
                    column.fixed_rows_mut::<3>(0).copy_from(&shift);
                    column.fixed_rows_mut::<3>(3).copy_from(&turn);
                }
            }
            put(&twists);
        }
        for found in &self.found {
            put(&found.effect.block(s, found.spot));
        }
        block
    }

    /// Where the tool is, or what is on it, as reports have it: in the last frame.
    pub(crate) fn tool(&self, number: usize) -> Isometry3<f64> {
        self.mounts.get(number).map_or(self.arm.tool, |mount| self.arm.tool * mount)
    }

    /// Inverse of the standard deviation to which each parameter is held; 0 where any value is as
    /// good.
    pub(crate) fn held(&self, problem: &Problem<'_>) -> Vec<f64> {
        let mut held = vec![0.0; Self::nuisances(problem)];
        held.extend(self.found.iter().flat_map(|f| &f.usual.held));
        held
    }

    /// Adds to normal equations whose first parameters are the model's what holds them: each loosely to what is
    /// usual, and some to what is known beside the rows.
    pub(crate) fn hold(
        &self,
        problem: &Problem<'_>,
        normal: &mut DMatrix<f64>,
        right: &mut DVector<f64>,
    ) {
        for (at, (held, value)) in self.held(problem).iter().zip(self.values(problem)).enumerate() {
            normal[(at, at)] += held * held;
            right[at] -= held * held * value;
        }
        Bond::all(problem, self).iter().for_each(|bond| bond.add(normal, right));
    }

    /// The values of all parameters, those of the nuisances as 0.
    pub(crate) fn values(&self, problem: &Problem<'_>) -> Vec<f64> {
        let mut values = vec![0.0; Self::nuisances(problem)];
        values.extend(self.found.iter().flat_map(|f| &f.values));
        values
    }

    /// The model with its parameters moved by `step` (in the order of [`Model::block`]); values
    /// stay physical.
    pub(crate) fn moved(&self, problem: &Problem<'_>, step: &[f64]) -> Self {
        let mut model = self.clone();
        let (nuisances, effects) = step.split_at(Self::nuisances(problem));
        let (frames, points) = nuisances.split_at(6 * problem.frames().count());
        for ((frame, number), step) in problem.frames().zip(frames.chunks_exact(6)) {
            let by = Displacement::new(&Vector6::from_column_slice(step)).transform();
            match frame {
                Nuisance::BaseFrame => model.bases[number] *= by,
                Nuisance::ToolFrame => match model.mounts.get_mut(number) {
                    Some(mount) => *mount *= by,
                    None => model.arm.tool *= by,
                },
            }
        }
        let (markers, mut bench) = points.split_at(3 * problem.markers.len());
        for (point, step) in model.markers.iter_mut().zip(markers.chunks_exact(3)) {
            *point += Vector3::from_column_slice(step);
        }
        for (view, thing) in model.bench.iter_mut().zip(&problem.bench) {
            let (step, others) = bench.split_at(thing.aim.free.len());
            (*view, bench) = (thing.aim.moved(*view, step), others);
        }
        let mut effects = effects;
        for found in &mut model.found {
            let (step, others) = effects.split_at(found.values.len());
            effects = others;
            let next = found.effect.stepped(found.spot, &found.values, step);
            found.values =
                next.iter().zip(&found.usual.least).map(|(v, least)| v.max(*least)).collect();
        }
        model
    }
}

/// Twists of the tool that move what is on it as displacements in its own axes do.
fn mount_moved(mount: &Isometry3<f64>, state: &State) -> Matrix6xX<f64> {
    let turn = state.tool.rotation * mount.rotation;
    let arm = state.tool.rotation * mount.translation.vector;
    let mut twists = Matrix6xX::zeros(6);
    for k in 0..3 {
        let axis = turn * Vector3::ith(k, 1.0);
        twists.fixed_view_mut::<3, 1>(0, k).copy_from(&axis);
        twists.fixed_view_mut::<3, 1>(0, 3 + k).copy_from(&arm.cross(&axis));
        twists.fixed_view_mut::<3, 1>(3, 3 + k).copy_from(&axis);
    }
    twists
}
