//! Numbers that were searched for stand beside those that were fitted: how far they are known, and how
//! much less is known of the others for it.

use nalgebra::{DMatrix, Matrix6xX};

use crate::diagnose::fit::{Fitted, block, squares};
use crate::diagnose::search::{Explained, Search};
use crate::effects::{Forms, Quantity, Scene, Spot};
use crate::infer::{Basis, Observations, students_t};
use crate::parallel;

/// Rows whose products are added up by one thread.
const CHUNK: usize = 256;

/// Whether it has a number that was searched for and may have any value: the row of a jump has none
/// between two.
pub(super) fn is_searched(found: &Fitted) -> bool {
    let forms = found.effect.forms_are();
    matches!(forms, Forms::Searched { quantity, .. } if quantity != Quantity::Row)
}

/// Twist of the tool by such a number: the difference between the steps on either side of it.
fn by_number(found: &Fitted, scene: &Scene<'_>) -> Matrix6xX<f64> {
    let Spot { form, place } = found.spot;
    let ends = [form - usize::from(form > 1), form + 1];
    let [before, behind] = ends.map(|form| found.effect.block(scene, Spot { place, form }));
    let [from, to] = ends.map(|form| found.effect.forms_are().number(form));
    let values = Matrix6xX::from_fn(found.values.len(), |_, k| found.values[k]);
    let change = (behind - before).component_mul(&values).column_sum() / (to - from);
    Matrix6xX::from_columns(&[change])
}

impl Search<'_, '_> {
    /// Half of the 95 % interval, by least squares, of each parameter beside the numbers that were
    /// searched for, and behind them of these; empty where there are none.
    pub(super) fn half_with_searched(&self, now: &Explained) -> Vec<f64> {
        let model = &now.fit.model;
        let searched: Vec<&Fitted> = model.found.iter().filter(|f| is_searched(f)).collect();
        if searched.is_empty() {
            return Vec::new();
        }
        let normal = self.normal_with(now, &searched);
        let (scale, parameters) = (self.scale(now), normal.nrows());
        let left = squares(self.problem, &now.fit.predicted.gaps, &now.weights);
        let variances = Basis::new(&normal).variances() * scale.variance(left, parameters);
        let t = students_t(scale.freedom(parameters), 0.975);
        variances.iter().map(|variance| t * variance.max(0.0).sqrt()).collect()
    }

    /// The normal matrix of all parameters, and behind them of the numbers that were searched for.
    fn normal_with(&self, now: &Explained, searched: &[&Fitted]) -> DMatrix<f64> {
        let (problem, model) = (self.problem, &now.fit.model);
        let normal = self.normal(now);
        let (fitted, count) = (normal.nrows(), searched.len());
        let products = |row: usize| {
            let weights = problem.weights(row, &now.weights);
            let own = block(problem, &now.fit, row, &weights);
            let mut more = Matrix6xX::zeros(count);
            let state = model.state(problem, &now.fit.predicted, row);
            if let Some(sim) = state.ok().filter(|_| problem.fits[row]) {
                more = model.change(problem, &sim, row, |scene| {
                    let each =
                        searched.iter().map(|found| by_number(found, scene).column(0).into_owned());
                    Matrix6xX::from_columns(&each.collect::<Vec<_>>())
                });
            }
            more.column_iter_mut().for_each(|mut column| column.component_mul_assign(&weights));
            let mut products = DMatrix::zeros(count, fitted + count);
            products.columns_mut(0, fitted).copy_from(&more.tr_mul(&own));
            products.columns_mut(fitted, count).copy_from(&more.tr_mul(&more));
            products
        };
        let none = || DMatrix::zeros(count, fitted + count);
        let sum = |chunk: &&[usize]| chunk.iter().fold(none(), |sum, row| sum + products(*row));
        // Added up in their order: the bits do not depend on the number of threads.
        let rows: Vec<usize> = (0..problem.data.rows.len()).collect();
        let chunks: Vec<&[usize]> = rows.chunks(CHUNK).collect();
        let parts = parallel::each(&chunks, &sum);
        let sums = parts.iter().fold(none(), |sum, part| sum + part);
        let mut all = normal.resize(fitted + count, fitted + count, 0.0);
        all.rows_mut(fitted, count).copy_from(&sums);
        let across = sums.columns(0, fitted).transpose();
        all.view_mut((0, fitted), (fitted, count)).copy_from(&across);
        all
    }

    /// Where the number of a finding stands in that matrix; none if it has none.
    pub(super) fn at_searched(&self, now: &Explained, index: usize) -> Option<usize> {
        let model = &now.fit.model;
        let before = model.found[..index].iter().filter(|f| is_searched(f)).count();
        is_searched(&model.found[index]).then(|| model.parameters(self.problem) + before)
    }
}
