//! The steps of Gauss and Newton, and how sure their end is.

use nalgebra::{DMatrix, DVector, Matrix6, Vector6};
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use super::choose::{Choice, choose};
use super::hold_out::Gap;
use super::regress::{Line, STIFFEST, Sheet};
use super::{Answer, MeasuredError, Parameter, Question, Status, Uncertainty, Unknown};
use crate::identify::pull::{Pull, pull};

/// Most steps; the gap is nearly linear in the compliances, so that a handful is enough.
const MOST_STEPS: usize = 30;

/// A step below this part of what all unknowns do changes nothing more.
const CONVERGED: f64 = 1e-10;

/// A step below this part of the noise of all rows together changes nothing more.
const NOTHING: f64 = 1e-6;

/// Rounds of fitting and taking the noise from what is left.
const ROUNDS: usize = 4;

/// The part of all work that the fit to all rows is; the rest is the folds.
pub(super) const FITTED: f64 = 0.5;

/// A noise below this, m or rad, is none.
const LEAST: f64 = 1e-13;

/// A number with a standard deviation of more than this part of it is weak.
const WEAK: f64 = 0.5;

/// Standard deviations of what was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Of a coordinate, m; none if none was measured.
    pub position: Option<f64>,
    /// Of a component of a rotation, rad; none if none was measured.
    pub rotation: Option<f64>,
    /// Both were given, so that the intervals do not depend on what is left.
    pub given: bool,
}

impl Noise {
    /// One over the noise of each measured component, 0 of the others.
    fn weights(&self, components: [bool; 6]) -> [f64; 6] {
        core::array::from_fn(|k| {
            let noise = if k < 3 { self.position } else { self.rotation };
            noise.filter(|_| components[k]).map_or(0.0, |sd| 1.0 / sd)
        })
    }
}

/// The fit to all rows.
pub(super) struct Fitted {
    pub(super) x: Vec<f64>,
    pub(super) choice: Choice,
    pub(super) noise: Noise,
    /// `(JᵀJ)⁻¹` of the whitened columns found.
    covariance: DMatrix<f64>,
    scaled_condition: f64,
    chi2: f64,
    freedom: usize,
}

/// Fits all rows.
pub(super) fn fit(
    sheet: &Sheet<'_>,
    question: &Question,
    done: &dyn Fn(f64),
) -> Result<Fitted, MeasuredError> {
    let rows: Vec<usize> = (0..sheet.data.rows.len()).collect();
    let components = sheet.data.kind.components();
    let start = sheet.start();
    let lines = sheet.lines(&rows, &start)?;
    let mut noise = Noise {
        position: components[..3].contains(&true).then(|| {
            question.noise_position.unwrap_or_else(|| rms(&lines, 0, components).max(LEAST))
        }),
        rotation: components[3..].contains(&true).then(|| {
            question.noise_rotation.unwrap_or_else(|| rms(&lines, 3, components).max(LEAST))
        }),
        given: false,
    };
    let known = |given: Option<f64>, measured: Option<f64>| measured.is_none() || given.is_some();
    noise.given = known(question.noise_position, noise.position)
        && known(question.noise_rotation, noise.rotation);
    // To first order: the loaded geometry alone tells two springs apart as little as it tells a
    // spring from noise.
    let mut stiff = start.clone();
    for (value, unknown) in stiff.iter_mut().zip(&sheet.unknowns) {
        if matches!(unknown, Unknown::Joint(_)) {
            *value = 0.0;
        }
    }
    let first_order = sheet.lines(&rows, &stiff)?;
    let choice = choose(&stacked(&first_order, &noise.weights(components)).1, &sheet.unknowns);
    let measured = components.iter().filter(|c| **c).count();
    let numbers = measured * (rows.len() - sheet.constants_in(&rows));
    if choice.found.is_empty() {
        let held = choice.held.iter().map(|(k, with)| {
            let why = if with.is_empty() { "leaves no trace" } else { "is not alone" };
            format!("{} {why}", sheet.unknowns[*k])
        });
        return Err(MeasuredError::Nothing { file: sheet.data.file.clone(), held: held.collect() });
    }
    if numbers <= choice.found.len() {
        let (file, unknowns) = (sheet.data.file.clone(), choice.found.len());
        return Err(MeasuredError::TooFew { file, rows: numbers, unknowns });
    }
    let freedom = numbers - choice.found.len();
    let mut x = start;
    let rounds = if noise.given { 1 } else { ROUNDS };
    for round in 0..rounds {
        done(FITTED * (round + 1) as f64 / (rounds + 1) as f64);
        x = settle(sheet, &rows, x, &choice.found, &noise)?;
        let lines = sheet.lines(&rows, &x)?;
        let part = (numbers as f64 / freedom as f64).sqrt();
        let left = |first: usize| (rms(&lines, first, components) * part).max(LEAST);
        if question.noise_position.is_none() {
            noise.position = noise.position.map(|_| left(0));
        }
        if question.noise_rotation.is_none() {
            noise.rotation = noise.rotation.map(|_| left(3));
        }
    }
    let (gap, columns) = stacked(&sheet.lines(&rows, &x)?, &noise.weights(components));
    let (covariance, scaled_condition) = covariance(&columns.select_columns(&choice.found));
    Ok(Fitted { x, choice, noise, covariance, scaled_condition, chi2: gap.norm_squared(), freedom })
}

/// Steps over some rows, from `x`, of the columns `found` only, until nothing moves.
fn settle(
    sheet: &Sheet<'_>,
    rows: &[usize],
    mut x: Vec<f64>,
    found: &[usize],
    noise: &Noise,
) -> Result<Vec<f64>, MeasuredError> {
    for _ in 0..MOST_STEPS {
        let (next, settled) = step(sheet, rows, x, found, noise)?;
        x = next;
        if settled {
            return Ok(x);
        }
    }
    Err(MeasuredError::Unsettled { file: sheet.data.file.clone() })
}

/// One step, and whether it changed nothing more.
pub(super) fn step(
    sheet: &Sheet<'_>,
    rows: &[usize],
    mut x: Vec<f64>,
    found: &[usize],
    noise: &Noise,
) -> Result<(Vec<f64>, bool), MeasuredError> {
    let weights = noise.weights(sheet.data.kind.components());
    let mut at = x.clone();
    for (value, unknown) in at.iter_mut().zip(&sheet.unknowns) {
        match unknown {
            Unknown::Joint(_) => *value = value.max(0.0),
            Unknown::Link(_) => *value = value.max(STIFFEST),
            Unknown::Base(_) => {}
        }
    }
    let (gap, columns) = stacked(&sheet.lines(rows, &at)?, &weights);
    let mut scaled = columns.select_columns(found);
    let norms = scaled.column_iter().map(|c| c.norm().max(f64::MIN_POSITIVE));
    let scale = DVector::from_iterator(found.len(), norms);
    for (mut column, norm) in scaled.column_iter_mut().zip(scale.iter()) {
        column /= *norm;
    }
    let change = scaled.svd(true, true).solve(&gap, 1e-12);
    let change = change.unwrap_or_else(|_| DVector::zeros(found.len())).component_div(&scale);
    if !change.iter().all(|s| s.is_finite()) {
        return Err(MeasuredError::Unsettled { file: sheet.data.file.clone() });
    }
    let before = x.clone();
    for (&k, change) in found.iter().zip(change.iter()) {
        x[k] = at[k] + change;
    }
    // In units of the noise, against the largest part that any unknown has in the gap.
    let part = |k: usize, scale: f64| (x[k].abs() * scale, (x[k] - before[k]).abs() * scale);
    let parts: Vec<_> = found.iter().zip(scale.iter()).map(|(&k, s)| part(k, *s)).collect();
    let largest = parts.iter().map(|(size, _)| *size).fold(0.0, f64::max);
    let settled = parts.iter().all(|(_, moved)| *moved <= CONVERGED * largest || *moved <= NOTHING);
    Ok((x, settled))
}

/// Whitened: gaps and columns of all rows below each other.
fn stacked(lines: &[Line], weights: &[f64; 6]) -> (DVector<f64>, DMatrix<f64>) {
    let unknowns = lines.first().map_or(0, |line| line.columns.ncols());
    let gap = DVector::from_fn(6 * lines.len(), |r, _| lines[r / 6].gap[r % 6] * weights[r % 6]);
    let columns = DMatrix::from_fn(6 * lines.len(), unknowns, |r, c| {
        lines[r / 6].columns[(r % 6, c)] * weights[r % 6]
    });
    (gap, columns)
}

/// Root mean square of the measured components of one kind.
fn rms(lines: &[Line], first: usize, components: [bool; 6]) -> f64 {
    let each = (first..first + 3).filter(|&k| components[k]);
    let squares: Vec<f64> =
        each.flat_map(|k| lines.iter().map(move |line| line.gap[k].powi(2))).collect();
    (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
}

fn covariance(columns: &DMatrix<f64>) -> (DMatrix<f64>, f64) {
    let norms: Vec<f64> = columns.column_iter().map(|c| c.norm()).collect();
    let scaled =
        DMatrix::from_fn(columns.nrows(), columns.ncols(), |r, c| columns[(r, c)] / norms[c]);
    let parts = scaled.svd(false, true);
    let values = parts.singular_values;
    let v_t = parts.v_t.unwrap_or_else(|| DMatrix::identity(norms.len(), norms.len()));
    let back =
        DMatrix::from_fn(norms.len(), norms.len(), |r, c| v_t[(c, r)] / values[c] / norms[r]);
    (&back * back.transpose(), values.max() / values.min())
}

impl Fitted {
    /// With the gap that the held-out poses leave.
    pub(super) fn answer(&self, sheet: &Sheet<'_>, question: &Question, gap: Gap) -> Answer {
        let reduced = self.chi2 / self.freedom as f64;
        // Noise that was taken from what is left has been divided out already, but for what given
        // and estimated noise leave of each other.
        let variance = if self.noise.given { 1.0 } else { reduced };
        let upper = 0.5 + question.confidence / 2.0;
        let factor = if self.noise.given {
            Normal::standard().inverse_cdf(upper)
        } else {
            let students = StudentsT::new(0.0, 1.0, self.freedom as f64);
            students.map_or(f64::INFINITY, |t| t.inverse_cdf(upper))
        };
        let start = sheet.start();
        let parameters = sheet.unknowns.iter().enumerate().map(|(k, &unknown)| {
            let (value, file) = (self.x[k], start[k]);
            let held = |with: &Vec<usize>| Status::Held {
                with: with.iter().map(|&k| sheet.unknowns[k]).collect(),
                pull: advice(sheet, unknown),
            };
            if let Some((_, with)) = self.choice.held.iter().find(|(held, _)| *held == k) {
                return Parameter { unknown, status: held(with), value, file, spread: None };
            }
            let at = self.choice.found.iter().position(|found| *found == k).unwrap_or(0);
            let deviation = (variance * self.covariance[(at, at)].max(0.0)).sqrt();
            let weak = deviation > WEAK * value;
            let status =
                if weak { Status::Weak(advice(sheet, unknown)) } else { Status::Determined };
            let interval = [value - factor * deviation, value + factor * deviation];
            let spread = Some(Uncertainty { deviation, interval });
            Parameter { unknown, status, value, file, spread }
        });
        Answer {
            parameters: parameters.collect(),
            freedom: self.freedom,
            noise: self.noise,
            reduced_chi2: Some(reduced),
            scaled_condition: self.scaled_condition,
            gap,
        }
    }
}

/// The pull that would show a joint in the postures of the file.
fn advice(sheet: &Sheet<'_>, unknown: Unknown) -> Option<Pull> {
    let Unknown::Joint(joint) = unknown else { return None };
    let components = sheet.data.kind.components();
    let part = |k: usize| components[k / 3 * 3..][..3].contains(&true);
    let weights = Vector6::from_fn(|k, _| f64::from(u8::from(part(k))));
    let postures = sheet.data.rows.iter().map(|row| row.q.as_slice());
    pull(sheet.arm, postures, |_| Some(Matrix6::from_diagonal(&weights)), joint - 1)
}
