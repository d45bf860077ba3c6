//! What was found, put in order and held out: each row predicted by fits that have not seen it.

use nalgebra::{DMatrix, DVector, Vector6};
use rayon::prelude::*;

use crate::diagnose::data::{Folds, Problem};
use crate::diagnose::fit::{Basis, Fit, Model, block, squares};
use crate::diagnose::options::DiagnoseError;
use crate::diagnose::search::{Explained, Search};
use crate::diagnose::sums::Products;

/// The effects of one finding: all forms of one effect at one place are one.
pub(crate) type Group = Vec<usize>;

/// The fit's products fold by fold, ready to be solved again without some of its parts.
pub(crate) struct Held<'h> {
    problem: &'h Problem<'h>,
    folds: &'h Folds,
    fit: &'h Fit,
    /// Weighted, all effects given back.
    of_fold: Vec<Normal>,
    total: Normal,
    /// Which parameters belong to which effect; what is fitted along to none.
    owner: Vec<Option<usize>>,
}

/// A normal matrix, its right-hand side, and the squares to be explained.
#[derive(Clone)]
struct Normal {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    squares: f64,
}

impl Normal {
    fn zeros(k: usize) -> Self {
        Self { matrix: DMatrix::zeros(k, k), right: DVector::zeros(k), squares: 0.0 }
    }

    /// Adds the products of some rows, the parameters' `values` given back to what is left.
    fn add(&mut self, products: &Products, values: &DVector<f64>) {
        let model = &products.zz * values;
        self.squares += products.rr + values.dot(&model) + 2.0 * values.dot(&products.zr);
        self.matrix += &products.zz;
        self.right += &products.zr + model;
    }
}

impl<'h> Held<'h> {
    pub(crate) fn new(search: &Search<'h, 'h>, now: &'h Explained) -> Self {
        let (problem, folds, fit) = (search.problem, search.folds, &now.fit);
        let mut owner = vec![None; Model::nuisances(problem)];
        for (index, found) in fit.model.found.iter().enumerate() {
            let own = (index >= Model::along(problem)).then_some(index);
            owner.extend(std::iter::repeat_n(own, found.values.len()));
        }
        let values = DVector::from_vec(fit.model.values(problem));
        let mut of_fold = vec![Normal::zeros(owner.len()); folds.count];
        let mut total = Normal::zeros(owner.len());
        for (block, products) in search.gathered(now).blocks.iter().enumerate() {
            of_fold[folds.of_block[block]].add(products, &values);
            total.add(products, &values);
        }
        Self { problem, folds, fit, of_fold, total, owner }
    }

    /// The values of all parameters with the effects of `groups` fitted to the other folds, a
    /// column for each fold; those of other effects are 0.
    fn values(&self, groups: &[&Group]) -> DMatrix<f64> {
        let kept: Vec<usize> = (0..self.owner.len())
            .filter(|&c| self.owner[c].is_none_or(|o| groups.iter().any(|g| g.contains(&o))))
            .collect();
        let mut values = DMatrix::zeros(self.owner.len(), self.of_fold.len());
        let held = DVector::from_vec(self.fit.model.held(self.problem)).map(|held| held * held);
        let total = &self.total.matrix + DMatrix::from_diagonal(&held);
        for (fold, own) in self.of_fold.iter().enumerate() {
            let others = (&total - &own.matrix).select_rows(&kept);
            let right = (&self.total.right - &own.right).select_rows(&kept);
            let found = Basis::new(&others.select_columns(&kept)).solve(&right);
            for (at, value) in kept.iter().zip(found.iter()) {
                values[(*at, fold)] = *value;
            }
        }
        values
    }

    /// Weighted squares of the held-out rows with such values.
    fn squares(&self, values: &DMatrix<f64>) -> f64 {
        let each = self.of_fold.iter().zip(values.column_iter()).map(|(own, values)| {
            own.squares + values.dot(&(&own.matrix * values)) - 2.0 * values.dot(&own.right)
        });
        each.sum()
    }

    /// Gap of each row, m and rad, with each of the given values.
    fn gaps(&self, values: &[DMatrix<f64>]) -> Vec<Vec<Vector6<f64>>> {
        let own = DVector::from_vec(self.fit.model.values(self.problem));
        let unit = Vector6::repeat(1.0).component_mul(&self.problem.mask);
        let rows = &self.problem.data.rows;
        let each: Vec<Vec<Vector6<f64>>> = (0..rows.len())
            .into_par_iter()
            .map(|row| {
                let block = block(self.problem, self.fit, row, &unit);
                let gap = self.fit.predicted.gaps[row] + &block * &own;
                let fold = self.folds.of_pose(rows[row].group);
                values.iter().map(|values| gap - &block * values.column(fold)).collect()
            })
            .collect();
        (0..values.len()).map(|k| each.iter().map(|gaps| gaps[k]).collect()).collect()
    }

    /// The held-out gaps without any effect that was found.
    pub(crate) fn without_findings(&self) -> Vec<Vector6<f64>> {
        self.gaps(&[self.values(&[])]).remove(0)
    }

    /// The groups in the order in which they shrink the held-out gap most, and the held-out gaps
    /// before the first and after each.
    pub(crate) fn ordered(&self, groups: Vec<Group>) -> (Vec<Group>, Vec<Vec<Vector6<f64>>>) {
        let mut rest = groups;
        let mut done: Vec<Group> = Vec::new();
        let mut values = vec![self.values(&[])];
        while !rest.is_empty() {
            let tried: Vec<DMatrix<f64>> = rest
                .par_iter()
                .map(|next| self.values(&done.iter().chain([next]).collect::<Vec<_>>()))
                .collect();
            let sizes: Vec<f64> = tried.iter().map(|values| self.squares(values)).collect();
            let best = (0..rest.len()).min_by(|a, b| sizes[*a].total_cmp(&sizes[*b])).unwrap_or(0);
            done.push(rest.remove(best));
            values.extend(tried.into_iter().nth(best));
        }
        let gaps = self.gaps(&values);
        (done, gaps)
    }
}

impl Search<'_, '_> {
    /// The findings in order, as [`Held::ordered`]; those that do not shrink the held-out gap beside
    /// all the others are taken out of the model.
    #[allow(clippy::type_complexity, reason = "three parts of one answer")]
    pub(crate) fn shrinking(
        &self,
        mut now: Explained,
    ) -> Result<(Explained, Vec<Group>, Vec<Vec<Vector6<f64>>>), DiagnoseError> {
        loop {
            let (done, gaps) = Held::new(self, &now).ordered(groups(self.problem, &now.fit.model));
            let size = |k: usize| squares(&gaps[k], &now.weights);
            let idle = (0..done.len()).rev().find(|&k| size(k + 1) >= size(k));
            let Some(idle) = idle.filter(|_| !self.stopped()) else { return Ok((now, done, gaps)) };
            let mut out = done[idle].clone();
            out.sort_unstable();
            now = self.fitted_without(now, &out)?;
        }
    }
}

/// All forms of one effect at one place are one finding; what is fitted along is none.
pub(crate) fn groups(problem: &Problem<'_>, model: &Model) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for (index, found) in model.found.iter().enumerate().skip(Model::along(problem)) {
        let same = |group: &&mut Group| {
            let first = &model.found[group[0]];
            first.effect.identifier() == found.effect.identifier()
                && first.spot.place == found.spot.place
        };
        match groups.iter_mut().find(same) {
            Some(group) => group.push(index),
            None => groups.push(vec![index]),
        }
    }
    groups
}
