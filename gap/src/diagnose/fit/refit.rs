//! The exact fit: frames and effects together, as true transforms at equilibrium.
//!
//! Gauss-Newton; a direction that the data do not decide stays where it is, and a value that wants
//! to leave what is physical is held at its bound.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector, Matrix6xX, Vector6};

use super::bond::Bond;
use super::model::{Model, Predicted};
use crate::diagnose::data::Problem;
use crate::diagnose::options::DiagnoseError;
use crate::infer::limits::{CHUNK, NEWTON_STEPS};
use crate::infer::{RANK, Squares};
use crate::parallel;
use crate::simulate::Sim;

/// Halvings of a step that does not help.
const MOST_HALVINGS: usize = 8;

/// Models that are predicted on the way: what needs more is hopeless, or has arrived but for what
/// nobody sees. Data as they are take some ten.
const MOST_PREDICTED: usize = 60;

/// A fit that is to come below something has no hope of it once so many steps as long as the next would
/// not lead there: near its end each promises a tenth of the one before, or less.
const HOPE: f64 = 10.0;

/// A step that promises less than this part of the squares, and less than this number of units of
/// noise, is the last.
const LAST: f64 = 1e-9;

/// Chunks that are worked on at once: enough that no thread waits long for another.
const AT_ONCE: usize = 256;

/// A model and what it predicts.
#[derive(Clone)]
pub(crate) struct Fit {
    pub(crate) model: Model,
    pub(crate) predicted: Arc<Predicted>,
}

/// Weighted sum of squares of gaps.
pub(crate) fn squares(problem: &Problem<'_>, gaps: &[Vector6<f64>], weights: &Vector6<f64>) -> f64 {
    let weights = |row| problem.weights(row, weights);
    gaps.iter().enumerate().map(|(row, g)| g.component_mul(&weights(row)).norm_squared()).sum()
}

/// Fits all parameters of `model`.
pub(crate) fn refit(
    problem: &Problem<'_>,
    model: Model,
    near: Option<&[Sim]>,
    weights: &Vector6<f64>,
) -> Result<Fit, DiagnoseError> {
    refit_below(problem, model, near, weights, f64::INFINITY)
}

/// The same, given up where squares and prior penalty have no hope of coming `below` something.
pub(crate) fn refit_below(
    problem: &Problem<'_>,
    model: Model,
    near: Option<&[Sim]>,
    weights: &Vector6<f64>,
    below: f64,
) -> Result<Fit, DiagnoseError> {
    // Frames alone are fitted to rounding: theirs is hand-eye calibration.
    let last = if model.found.is_empty() { LAST * LAST } else { LAST };
    refit_until(problem, model, near, weights, [below, last])
}

/// The same, until a step promises less than a thirty-thousandth of the squares. Sizes are compared to a thousandth, which is
/// two of the squares: where each step promises a sixtieth less than the one before, no more is left.
pub(crate) fn refit_roughly(
    problem: &Problem<'_>,
    model: Model,
    weights: &Vector6<f64>,
) -> Result<Fit, DiagnoseError> {
    refit_until(problem, model, None, weights, [f64::INFINITY, LAST.sqrt()])
}

fn refit_until(
    problem: &Problem<'_>,
    model: Model,
    near: Option<&[Sim]>,
    weights: &Vector6<f64>,
    [below, last]: [f64; 2],
) -> Result<Fit, DiagnoseError> {
    let predicted = model.predict(problem, near)?;
    let mut fit = Fit { model, predicted: Arc::new(predicted) };
    if fit.model.parameters(problem) == 0 {
        return Ok(fit);
    }
    let cost = |model: &Model, predicted: &Predicted| {
        squares(problem, &predicted.gaps, weights) + prior_penalty(problem, model)
    };
    let mut now = cost(&fit.model, &fit.predicted);
    let mut predicted = 0;
    for _ in 0..NEWTON_STEPS {
        // Frames are fitted to the end; effects are not told before.
        if predicted >= MOST_PREDICTED || (problem.stop.is_asked() && !fit.model.found.is_empty()) {
            break;
        }
        let (step, promised) = step(problem, &fit, weights);
        if promised <= last * (1.0 + now) || now - HOPE * promised > below {
            break;
        }
        let mut part = 1.0;
        let mut better = None;
        for _ in 0..MOST_HALVINGS {
            predicted += 1;
            let step: Vec<f64> = step.iter().map(|s| s * part).collect();
            let model = fit.model.moved(problem, &step);
            // An arm that finds no rest is no better.
            if let Ok(predicted) = model.predict(problem, Some(&fit.predicted.sims)) {
                let then = cost(&model, &predicted);
                if then < now {
                    better = Some((Fit { model, predicted: Arc::new(predicted) }, then));
                    break;
                }
            }
            part /= 2.0;
        }
        let Some((next, then)) = better else { break };
        let converged = now - then <= last * (1.0 + now);
        (fit, now) = (next, then);
        if converged {
            break;
        }
    }
    Ok(fit)
}

/// Weighted normal matrix and right-hand side of all parameters, each loosely held to what is usual.
pub(crate) fn normal_equations(
    problem: &Problem<'_>,
    fit: &Fit,
    weights: &Vector6<f64>,
) -> (DMatrix<f64>, DVector<f64>) {
    let k = fit.model.parameters(problem);
    // Chunks of rows are worked on at once and added up in their order.
    let rows: Vec<usize> = (0..fit.predicted.gaps.len()).collect();
    let chunks: Vec<&[usize]> = match &problem.constants[..] {
        [] => rows.chunks(CHUNK).collect(),
        sets => sets.iter().map(Vec::as_slice).collect(),
    };
    let products = |rows: &&[usize]| {
        let mut columns = DMatrix::zeros(6 * rows.len(), k);
        let mut gaps = DVector::zeros(6 * rows.len());
        for (index, &row) in rows.iter().enumerate() {
            let weights = problem.weights(row, weights);
            let block = block(problem, fit, row, &weights);
            columns.rows_mut(6 * index, 6).copy_from(&block);
            let gap = fit.predicted.gaps[row].component_mul(&weights);
            gaps.rows_mut(6 * index, 6).copy_from(&gap);
        }
        if !problem.constants.is_empty() {
            subtract_means(&mut columns);
        }
        let across = columns.transpose();
        (&across * &columns, across * gaps)
    };
    let (mut normal, mut right) = (DMatrix::zeros(k, k), DVector::zeros(k));
    // Some at once: the products of all chunks of very many rows would be as large as the rows.
    for some in chunks.chunks(AT_ONCE) {
        let parts: Vec<(DMatrix<f64>, DVector<f64>)> = parallel::each(some, &products);
        for (products, with_gap) in &parts {
            normal += products;
            right += with_gap;
        }
    }
    fit.model.hold(problem, &mut normal, &mut right);
    (normal, right)
}

/// What it costs that values are beyond what is usual, and against what is known beside the rows.
pub(crate) fn prior_penalty(problem: &Problem<'_>, model: &Model) -> f64 {
    let values = model.values(problem);
    let held = model.held(problem);
    let usual: f64 = held.iter().zip(values).map(|(h, value)| (h * value).powi(2)).sum();
    usual + Bond::all(problem, model).iter().map(Bond::square).sum::<f64>()
}

/// Weighted 6×k block of one row.
pub(crate) fn block(
    problem: &Problem<'_>,
    fit: &Fit,
    row: usize,
    weights: &Vector6<f64>,
) -> Matrix6xX<f64> {
    let model = &fit.model;
    let state = model.state(problem, &fit.predicted, row).ok().filter(|_| problem.fits[row]);
    let Some(sim) = state else { return Matrix6xX::zeros(model.parameters(problem)) };
    let mut block = model.change(problem, &sim, row, |s| model.block(problem, row, s));
    for mut column in block.column_iter_mut() {
        column.component_mul_assign(weights);
    }
    block
}

/// Takes from each of the six components its mean over the rows.
fn subtract_means(columns: &mut DMatrix<f64>) {
    let rows = columns.nrows() / 6;
    for mut column in columns.column_iter_mut() {
        for component in 0..6 {
            let mut same = column.rows_with_step_mut(component, rows, 5);
            same.add_scalar_mut(-same.mean());
        }
    }
}

/// The step, with what wants to go below its least value taken to it; and by how much the squares
/// are to fall.
pub(crate) fn step(
    problem: &Problem<'_>,
    fit: &Fit,
    weights: &Vector6<f64>,
) -> (DVector<f64>, f64) {
    let (normal, right) = normal_equations(problem, fit, weights);
    let nuisances = Model::nuisances(problem);
    let each = fit.model.found.iter().flat_map(|f| f.usual.least.iter().zip(&f.values));
    let room = each.map(|(least, value)| least - value);
    let mut least = vec![f64::NEG_INFINITY; nuisances];
    least.extend(room);
    let sizes = normal.diagonal();
    let squares = Squares { matrix: &normal, right: &right, sizes, decided: RANK };
    let (step, _) = squares.solve(&least);
    let promised = squares.fall(&step);
    (step, promised)
}
