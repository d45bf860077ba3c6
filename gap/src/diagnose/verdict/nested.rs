//! The search itself, held out: run again on all folds but one, for each.

use nalgebra::Vector6;

use crate::diagnose::data::{Folds, Problem};
use crate::diagnose::fit::Model;
use crate::diagnose::options::DiagnoseError;
use crate::diagnose::search::Search;

impl Search<'_, '_> {
    /// Gap of each row with what a search finds that has not seen its fold of these, m and rad; `model` is
    /// where each begins.
    pub(crate) fn nested(
        &self,
        model: &Model,
        folds: &Folds,
    ) -> Result<Vec<Vector6<f64>>, DiagnoseError> {
        let rows = self.problem.data.rows.len();
        let mut gaps = vec![Vector6::zeros(); rows];
        for fold in 0..folds.count {
            let is_held_out = |row: usize| folds.of_row(row) == fold;
            let fits = (0..rows).map(|row| self.problem.fits[row] && !is_held_out(row));
            let seen = Problem { fits: fits.collect(), ..self.problem.clone() };
            let search = Search { problem: &seen, ..*self };
            let explained = search.explain(search.begin(model.clone())?)?;
            let predicted = explained.fit.model.predict(self.problem, None)?;
            for row in (0..rows).filter(|row| is_held_out(*row)) {
                gaps[row] = predicted.gaps[row];
            }
        }
        Ok(gaps)
    }
}
