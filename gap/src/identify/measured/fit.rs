//! The diagnosis with a fixed set of effects: fitted, told with its uncertainty, and held out.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector, Matrix6, Vector6};
use stiffarm_kernels::generic::Arm;

use super::choose::{Choice, choose};
use super::{Answer, Gap, MeasuredError, Noise, Parameter, Question, Status, Uncertainty, Unknown};
use crate::constants::WEAK;
use crate::diagnose::data::{Folds, Problem};
use crate::diagnose::fit::{Fit, Model, normal_equations, placed, refit, squares, step};
use crate::diagnose::search::{Explained, Search};
use crate::diagnose::{DiagnoseError, Options};
use crate::effects::Known;
use crate::gap::Statistics;
use crate::identify::pull::{Pull, pull};
use crate::infer::constants::SIGNIFICANT;
use crate::infer::{Basis, Observations, students_t, two_sided};
use crate::measurement::{Measurements, Row};

/// The fit has not come to its end if another step promises more than this part of what there was.
const SETTLED: f64 = 1e-6;

/// The part of all work that the fit to all rows is; the rest is the folds.
const FITTED: f64 = 0.5;

/// Finds what the question asks for in a measurement file; `done` is told the part of the work that
/// is done, from 0 to 1. The user's own simulator, if the file has one, plays no part.
///
/// # Errors
/// [`MeasuredError`].
pub fn identify_measured(
    arm: &Arm,
    data: &Measurements,
    question: &Question,
    done: &dyn Fn(f64),
) -> Result<Answer, MeasuredError> {
    let file = || data.file.clone();
    if data.by_camera || data.by_board {
        return Err(MeasuredError::Camera { file: file() });
    }
    if let Some(row) = data.rows.iter().find(|row| row.offset.is_none()) {
        let marker = row.marker.clone().unwrap_or_default();
        return Err(MeasuredError::UnknownOffset { file: file(), line: row.line, marker });
    }
    if data.rows.iter().all(|row| row.wrench == Vector6::zeros()) {
        return Err(MeasuredError::NoLoad { file: file() });
    }
    let options = &question.options(data);
    let unknowns = Unknown::all(arm, question);
    let told = Measurements { sim_given: [false; 6], ..data.clone() };
    let data = &with_bench(arm, told, options, &unknowns)?;
    let problem = &problem(arm, data, options)?;
    let folds = &Folds::deal(data, options)?;
    let search = Search { problem, folds, candidates: &[], options, progress: &|_| {} };
    let nominal = Model::nominal(problem);
    let choice = chosen(&search, &nominal, &unknowns)?;
    let now = fitted(&search, &nominal, &unknowns, &choice)?;
    let before = nominal.predict(problem, None)?.gaps;
    let (_, promised) = step(problem, &now.fit, &now.weights);
    if promised > SETTLED * (1.0 + squares(problem, &before, &now.weights)) {
        return Err(MeasuredError::Unsettled { file: file() });
    }
    done(FITTED);
    let held_out = held_out(&search, &now, &|part| done(FITTED + (1.0 - FITTED) * part))?;
    let gap = Gap {
        before: Statistics::of(&before),
        held_out: Statistics::of(&held_out),
        rows: [before, held_out],
        folds: folds.count,
    };
    Ok(answer(&search, &now, &unknowns, &choice, question, gap))
}

/// What is unknown of the bench, where the arm with its springs shows it: what it is still off is the same under all
/// loads of a pose, to first order, and taken by that pose's constant. The springs are found twice: first before a bench
/// that the springs of the robot file place, where its tilts turn the deflections by what the springs are off.
fn with_bench(
    arm: &Arm,
    data: Measurements,
    options: &Options,
    unknowns: &[Unknown],
) -> Result<Measurements, MeasuredError> {
    if !data.rows.iter().any(Row::reads_unknown) {
        return Ok(data);
    }
    let first = &placed(arm, data.clone(), &options.known)?.data;
    let (problem, folds) = (&problem(arm, first, options)?, &Folds::deal(first, options)?);
    let search = Search { problem, folds, candidates: &[], options, progress: &|_| {} };
    let nominal = Model::nominal(problem);
    let choice = chosen(&search, &nominal, unknowns)?;
    let springs = fitted(&search, &nominal, unknowns, &choice)?.fit.model.found;
    let springs = springs.iter().map(|spring| spring.known(&data.file));
    let known: Vec<Known> = options.known.iter().cloned().chain(springs).collect();
    Ok(placed(arm, data, &known)?.data)
}

/// Poses with a constant of their own for each marker and each thing of the bench.
fn problem<'a>(
    arm: &'a Arm,
    data: &'a Measurements,
    options: &Options,
) -> Result<Problem<'a>, DiagnoseError> {
    let mut problem = Problem::new(arm, data, options)?;
    if !data.kind.is_difference() {
        let mut place = HashMap::new();
        for (index, row) in data.rows.iter().enumerate() {
            let constants = &mut problem.constants;
            let thing = row.aim.as_deref().map(|aim| (aim.seen, &aim.name));
            let at = *place.entry((row.group, &row.marker, thing)).or_insert(constants.len());
            if at == constants.len() {
                constants.push(Vec::new());
            }
            constants[at].push(index);
        }
    }
    Ok(problem)
}

/// What the rows determine, to first order: the loaded geometry alone tells two springs apart as
/// little as it tells a spring from noise.
fn chosen(
    search: &Search<'_, '_>,
    nominal: &Model,
    unknowns: &[Unknown],
) -> Result<Choice, MeasuredError> {
    let problem = search.problem;
    if problem.numbers() == 0 {
        return Err(MeasuredError::OneLoadEach { file: problem.data.file.clone() });
    }
    let rigid = |unknown: &Unknown| match unknown {
        Unknown::Joint(_) => unknown.added(problem.arm, -unknown.file(problem.arm)),
        Unknown::Link(_) | Unknown::Base(_) => unknown.added(problem.arm, 0.0),
    };
    let model = Model { found: unknowns.iter().map(rigid).collect(), ..nominal.clone() };
    let predicted = Arc::new(model.predict(problem, None)?);
    let choice = choose(&search.normal(&search.weigh(Fit { model, predicted })), unknowns);
    let file = problem.data.file.clone();
    if choice.found.is_empty() {
        let held = choice.held.iter().map(|(k, with)| {
            let why = if with.is_empty() { "leaves no trace" } else { "is not alone" };
            format!("{} {why}", unknowns[*k])
        });
        return Err(MeasuredError::Nothing { file, held: held.collect() });
    }
    let (rows, unknowns) = (problem.numbers(), choice.found.len());
    if rows <= unknowns {
        return Err(MeasuredError::TooFew { file, rows, unknowns });
    }
    Ok(choice)
}

/// The springs that were chosen, from the robot file's.
fn fitted(
    search: &Search<'_, '_>,
    nominal: &Model,
    unknowns: &[Unknown],
    choice: &Choice,
) -> Result<Explained, DiagnoseError> {
    let found = choice.found.iter().map(|k| unknowns[*k].added(search.problem.arm, 0.0)).collect();
    search.begin(Model { found, ..nominal.clone() })
}

/// The gap of each row by what is found without its fold.
fn held_out(
    search: &Search<'_, '_>,
    now: &Explained,
    done: &dyn Fn(f64),
) -> Result<Vec<Vector6<f64>>, DiagnoseError> {
    let Search { problem: &Problem { arm, data, .. }, folds, options, .. } = *search;
    let mut gaps = vec![Vector6::zeros(); data.rows.len()];
    for fold in 0..folds.count {
        done(fold as f64 / folds.count as f64);
        let is_held = |row: &usize| folds.of_row(*row) == fold;
        let part = |held: bool| {
            let rows = (0..gaps.len()).filter(|row| is_held(row) == held);
            Measurements { rows: rows.map(|row| data.rows[row].clone()).collect(), ..data.clone() }
        };
        let (own, others) = (part(true), part(false));
        let fitted =
            refit(&problem(arm, &others, options)?, now.fit.model.clone(), None, &now.weights)?;
        let predicted = fitted.model.predict(&problem(arm, &own, options)?, None)?;
        let rows = (0..gaps.len()).filter(is_held);
        rows.zip(predicted.gaps).for_each(|(row, gap)| gaps[row] = gap);
    }
    Ok(gaps)
}

/// The numbers with their uncertainties: least squares, the remainder's variance, Student's t.
fn answer(
    search: &Search<'_, '_>,
    now: &Explained,
    unknowns: &[Unknown],
    choice: &Choice,
    question: &Question,
    gap: Gap,
) -> Answer {
    let (problem, scale) = (search.problem, search.scale(now));
    let (normal, right) = normal_equations(problem, &now.fit, &now.weights);
    let basis = Basis::new(&normal);
    let fitted = choice.found.len();
    let (left, freedom) =
        (squares(problem, &now.fit.predicted.gaps, &now.weights), scale.freedom(fitted));
    let variances = basis.variances() * scale.variance(left, fitted);
    // What the fit has held at its bound is told as the rows have it, be it below zero.
    let values = DVector::from_vec(now.fit.model.values(problem)) + basis.solve(&right);
    let factor = students_t(freedom, 0.5 + question.confidence / 2.0);
    let parameters = unknowns.iter().enumerate().map(|(k, &unknown)| {
        let file = unknown.file(problem.arm);
        let Some(at) = choice.found.iter().position(|found| *found == k) else {
            let held = choice.held.iter().find(|(held, _)| *held == k);
            let with =
                held.map_or(&[][..], |(_, with)| with).iter().map(|k| unknowns[*k]).collect();
            let status = Status::Held { with, pull: advice(problem, unknown) };
            return Parameter { unknown, status, value: file, file, spread: None, differs: false };
        };
        let (value, deviation) = (file + values[at], variances[at].sqrt());
        let weak = deviation > WEAK * value;
        let status = if weak { Status::Weak(advice(problem, unknown)) } else { Status::Determined };
        let interval = [value - factor * deviation, value + factor * deviation];
        Parameter {
            unknown,
            status,
            value,
            file,
            spread: Some(Uncertainty { deviation, interval }),
            differs: false,
        }
    });
    let mut parameters: Vec<Parameter> = parameters.collect();
    tell_apart(&mut parameters, freedom);
    let has = |kind: core::ops::Range<usize>| problem.measured.iter().any(|k| kind.contains(k));
    Answer {
        parameters,
        freedom: freedom as usize,
        noise: Noise {
            position: has(0..3).then_some(now.noise.position.sd),
            rotation: has(3..6).then_some(now.noise.rotation.sd),
            from: now.noise.main().source.name(),
        },
        reduced_chi2: Some(left / freedom),
        scaled_condition: condition(&normal, &basis),
        gap,
    }
}

/// Notes which numbers differ from the file's: the chance of the least likely is held against a level for all that were
/// found, that of the next for all others, and so on (Holm's step-down; Student's t of so many degrees of freedom).
fn tell_apart(parameters: &mut [Parameter], freedom: f64) {
    let p_value = |p: &Parameter| {
        let off = (p.value - p.file).abs();
        let found = p.spread.map(|spread| (off > 0.0, off / spread.deviation));
        found.map(|(is_off, t)| if is_off { two_sided(freedom, t) } else { 1.0 })
    };
    let mut found: Vec<(f64, &mut Parameter)> =
        parameters.iter_mut().filter_map(|p| p_value(p).map(|chance| (chance, p))).collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let others = (1..=found.len()).rev();
    let passes = |(tried, (chance, _)): &(usize, (f64, &mut Parameter))| {
        *tried as f64 * chance <= SIGNIFICANT
    };
    others.zip(found).take_while(passes).for_each(|(_, (_, parameter))| parameter.differs = true);
}

/// The condition number of the columns, each brought to length 1: `tᵀ A t = 1` has the singular
/// values' inverses as the lengths of the columns of `t` then.
fn condition(normal: &DMatrix<f64>, basis: &Basis) -> f64 {
    let sizes = normal.diagonal().map(f64::sqrt);
    let lengths = basis.t.column_iter().map(|column| column.component_mul(&sizes).norm());
    let (low, high) = lengths.fold((f64::MAX, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
    high / low
}

/// The pull that would show a joint in the postures of the file.
fn advice(problem: &Problem<'_>, unknown: Unknown) -> Option<Pull> {
    let Unknown::Joint(joint) = unknown else { return None };
    let part = |k: usize| problem.measured.iter().any(|m| m / 3 == k / 3);
    let weights = Vector6::from_fn(|k, _| f64::from(u8::from(part(k))));
    let nominal = Model::nominal(problem);
    let joints = |row| nominal.actual(problem, row, true).joints;
    let postures: Vec<Vec<f64>> = (0..problem.data.rows.len()).map(joints).collect();
    let postures = postures.iter().map(Vec::as_slice);
    pull(problem.arm, postures, |_| Some(Matrix6::from_diagonal(&weights)), joint - 1)
}
