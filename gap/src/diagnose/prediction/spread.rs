//! How well the numbers of a fit are known, and what is left of the readings beside them.

use nalgebra::{DMatrix, Matrix6xX, Vector6};

use crate::diagnose::data::Problem;
use crate::diagnose::fit::{Model, Predicted, block, squares};
use crate::diagnose::search::{Explained, Search};
use crate::infer::{Basis, Observations};
use crate::parallel;

/// Part by which a leverage changes with the arm that it is worked out for: the corrections themselves are
/// some thousandths of what they correct.
const SECOND: f64 = 0.01;

/// How well the numbers that were fitted are known.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Spread {
    /// `S` with `S Sᵀ` the covariance of what was fitted: frames (of the
    /// first session), then effects; no points.
    pub(super) root: DMatrix<f64>,
    /// Variance that is left of each measured number, m² and rad²; 0 of those not measured.
    pub(super) left: Vector6<f64>,
    /// The largest leverage of a row that was fitted.
    pub(super) leverage: f64,
}

impl Spread {
    /// Whether a row's leverage is no larger than that of a row that was fitted, by those `numbers` of what was
    /// fitted that `model` has; where it has no state it is infinite.
    pub(super) fn covers(
        &self,
        problem: &Problem<'_>,
        model: &Model,
        predicted: &Predicted,
        row: usize,
        numbers: &[usize],
    ) -> bool {
        let leverage = model.state(problem, predicted, row).map_or(f64::INFINITY, |sim| {
            let block = model.change(problem, &sim, row, |s| model.block(problem, row, s));
            self.leverage(&block.select_columns(&columns(problem, model, row)), numbers)
        });
        leverage <= self.leverage * (1.0 + SECOND)
    }

    /// Leverage of a row, whose `block` has these of the numbers that were fitted: the variance of its
    /// prediction over that of a measurement, summed over what is measured.
    fn leverage(&self, block: &Matrix6xX<f64>, numbers: &[usize]) -> f64 {
        let mut doubt = block * self.root.select_rows(numbers);
        for mut column in doubt.column_iter_mut() {
            let white = |x: f64, left: f64| if left > 0.0 { x / left.sqrt() } else { 0.0 };
            column.zip_apply(&self.left, |x, left| *x = white(*x, left));
        }
        doubt.norm_squared()
    }
}

/// The columns of a row's block that a [`Spread`] knows of: its own frames, and effects.
fn columns(problem: &Problem<'_>, model: &Model, row: usize) -> Vec<usize> {
    let frames = problem.frames().enumerate();
    let frames = frames.filter(|(_, frame)| problem.is_told_of(row, *frame));
    let mut own: Vec<usize> = frames.flat_map(|(k, _)| 6 * k..6 * k + 6).collect();
    own.extend(Model::nuisances(problem)..model.parameters(problem));
    own
}

impl Search<'_, '_> {
    /// Of the numbers of a fit.
    pub(crate) fn spread(&self, now: &Explained) -> Spread {
        let normal = self.normal(now);
        let left = squares(self.problem, &now.fit.predicted.gaps, &now.weights);
        let variance = self.scale(now).variance(left, normal.nrows());
        let root = Basis::new(&normal).t * variance.sqrt();
        // Elsewhere an arm stands in one frame, and is seen from nowhere in particular.
        let frames = self.problem.frames().enumerate();
        let one = frames.filter(|(_, (_, number))| *number == 0);
        let mut kept: Vec<usize> = one.flat_map(|(k, _)| 6 * k..6 * k + 6).collect();
        kept.extend(Model::nuisances(self.problem)..root.nrows());
        let spread = Spread {
            root: root.select_rows(&kept),
            left: now.weights.map(|w| if w > 0.0 { variance / (w * w) } else { 0.0 }),
            leverage: 0.0,
        };
        let numbers: Vec<usize> = (0..spread.root.nrows()).collect();
        let unit = self.problem.mask;
        let of_row = |row: usize| {
            let block = block(self.problem, &now.fit, row, &unit);
            let own = columns(self.problem, &now.fit.model, row);
            spread.leverage(&block.select_columns(&own), &numbers)
        };
        let leverage = parallel::map(self.problem.fits.len(), &of_row).into_iter();
        Spread { leverage: leverage.fold(0.0, f64::max), ..spread.clone() }
    }
}
