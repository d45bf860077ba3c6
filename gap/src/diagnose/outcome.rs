//! What was found, put in order and held out: each row predicted by fits that have not seen it.

use nalgebra::{DMatrix, DVector, Matrix6xX, Vector6};

use super::basis::Basis;
use super::folds::Folds;
use super::model::Model;
use super::options::DiagnoseError;
use super::problem::Problem;
use super::refit::{Fit, block, squares};
use super::search::{Explained, Search};

/// The effects of one finding: all forms of one effect at one place are one.
pub(crate) type Group = Vec<usize>;

/// The fit's rows, ready to be fitted again without some of its parts.
pub(crate) struct Rows {
    /// Weighted blocks, 6×k, one per row.
    blocks: Vec<Matrix6xX<f64>>,
    /// Weighted gaps with all effects given back.
    gaps: Vec<Vector6<f64>>,
    /// Which parameters belong to which effect; the nuisances to none.
    owner: Vec<Option<usize>>,
    fold: Vec<usize>,
    folds: usize,
    weights: Vector6<f64>,
}

impl Rows {
    pub(crate) fn new(
        problem: &Problem<'_>,
        folds: &Folds,
        fit: &Fit,
        weights: &Vector6<f64>,
    ) -> Self {
        let mut owner = vec![None; Model::nuisances(problem)];
        let mut values = vec![0.0; owner.len()];
        for (index, found) in fit.model.found.iter().enumerate() {
            owner.extend(std::iter::repeat_n(Some(index), found.values.len()));
            values.extend(&found.values);
        }
        let values = DVector::from_vec(values);
        let rows = 0..problem.data.rows.len();
        let blocks: Vec<_> = rows.map(|row| block(problem, fit, row, weights)).collect();
        let gaps = fit.predicted.gaps.iter().zip(&blocks);
        let gaps = gaps.map(|(g, b)| g.component_mul(weights) + b * &values).collect();
        let fold = problem.data.rows.iter().map(|r| folds.of_pose(r.group)).collect();
        Self { blocks, gaps, owner, fold, folds: folds.count, weights: *weights }
    }

    /// Gap of each row, m and rad, with the effects of `groups` fitted to the other folds.
    pub(crate) fn held_out(&self, groups: &[&Group]) -> Vec<Vector6<f64>> {
        let kept: Vec<usize> = (0..self.owner.len())
            .filter(|&c| self.owner[c].is_none_or(|o| groups.iter().any(|g| g.contains(&o))))
            .collect();
        let k = kept.len();
        let parts: Vec<Matrix6xX<f64>> =
            self.blocks.iter().map(|b| Matrix6xX::from_fn(k, |r, c| b[(r, kept[c])])).collect();
        let mut normal = vec![DMatrix::<f64>::zeros(k, k); self.folds];
        let mut right = vec![DVector::<f64>::zeros(k); self.folds];
        for ((part, gap), &fold) in parts.iter().zip(&self.gaps).zip(&self.fold) {
            normal[fold].gemm_tr(1.0, part, part, 1.0);
            right[fold].gemv_tr(1.0, part, gap, 1.0);
        }
        let (all, target): (DMatrix<f64>, DVector<f64>) = (
            normal.iter().fold(DMatrix::zeros(k, k), |sum, n| sum + n),
            right.iter().fold(DVector::zeros(k), |sum, r| sum + r),
        );
        let values: Vec<DVector<f64>> = normal
            .iter()
            .zip(&right)
            .map(|(n, r)| Basis::new(&(&all - n)).solve(&(&target - r)))
            .collect();
        let rows = parts.iter().zip(&self.gaps).zip(&self.fold);
        let plain = self.weights.map(|w| if w > 0.0 { 1.0 / w } else { 0.0 });
        rows.map(|((part, gap), &fold)| (gap - part * &values[fold]).component_mul(&plain))
            .collect()
    }

    /// The groups in the order in which they shrink the held-out gap most, and the held-out gaps
    /// before the first and after each.
    pub(crate) fn ordered(&self, groups: Vec<Group>) -> (Vec<Group>, Vec<Vec<Vector6<f64>>>) {
        let mut rest = groups;
        let mut done: Vec<Group> = Vec::new();
        let mut gaps = vec![self.held_out(&[])];
        while !rest.is_empty() {
            let tried = rest.iter().map(|next| {
                let with: Vec<&Group> = done.iter().chain([next]).collect();
                self.held_out(&with)
            });
            let tried: Vec<_> = tried.collect();
            let size = |k: &usize| squares(&tried[*k], &self.weights);
            let best = (0..rest.len()).min_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(0);
            done.push(rest.remove(best));
            gaps.push(tried.into_iter().nth(best).unwrap_or_default());
        }
        (done, gaps)
    }
}

impl Search<'_, '_> {
    /// The findings in order, as [`Rows::ordered`]; those that do not shrink the held-out gap beside
    /// all the others are taken out of the model.
    #[allow(clippy::type_complexity, reason = "three parts of one answer")]
    pub(crate) fn shrinking(
        &self,
        mut now: Explained,
    ) -> Result<(Explained, Vec<Group>, Vec<Vec<Vector6<f64>>>), DiagnoseError> {
        loop {
            let rows = Rows::new(self.problem, self.folds, &now.fit, &now.weights);
            let (done, gaps) = rows.ordered(groups(&now.fit.model));
            let size = |k: usize| squares(&gaps[k], &now.weights);
            let idle = (0..done.len()).rev().find(|&k| size(k + 1) >= size(k));
            let Some(idle) = idle else { return Ok((now, done, gaps)) };
            let mut out = done[idle].clone();
            out.sort_unstable();
            now = self.fitted_without(now, &out)?;
        }
    }
}

/// All forms of one effect at one place are one finding.
pub(crate) fn groups(model: &Model) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for (index, found) in model.found.iter().enumerate() {
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
