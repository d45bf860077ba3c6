//! Findings in the order in which they shrink the held-out error most, and what is left after each.

use nalgebra::{DMatrix, DVector};

use super::Search;
use super::dictionary::Mixed;
use super::fit::{Fitted, weights};
use super::judge::Verdict;
use super::normal_equations::quadratic;
use crate::infer::{Basis, ordered};
use crate::parallel;

/// Products of all columns of a model, from which any of its terms may be left out.
struct Parts {
    /// Columns of the rigid links, then those of each term, and where those stand that it does at the values about which
    /// it is linearised, if they are not 0.
    links: usize,
    terms: Vec<(core::ops::Range<usize>, Option<usize>)>,
    /// Of all folds but one, each joint told in its size.
    others: Vec<DMatrix<f64>>,
    /// Of each joint each fold's, and the joint's rows.
    own: Vec<(Vec<DMatrix<f64>>, f64)>,
}

impl Search<'_, '_> {
    /// A verdict in that order, and what is left of each joint after each finding. `size` is what is made smaller.
    pub fn ordered(
        &self,
        verdict: Verdict,
        size: impl Fn(&[f64]) -> f64,
    ) -> (Verdict, Vec<Vec<f64>>) {
        let parts = self.parts(&verdict);
        let count = verdict.findings.len();
        let each = ordered(count, |terms| parts.left(terms), |left: &Vec<f64>| size(left));
        let (done, left): (Vec<usize>, Vec<Vec<f64>>) = each.into_iter().unzip();
        let Verdict { findings, mut now, blocks } = verdict;
        let terms: Vec<_> = done.iter().map(|k| now.fit.terms[*k].clone()).collect();
        now.fit = Fitted::of(self.dict, &terms, self.links, &now.sizes);
        let mut findings: Vec<_> = findings.into_iter().map(Some).collect();
        let findings = done.iter().filter_map(|k| findings[*k].take()).collect();
        (Verdict { findings, now, blocks }, left)
    }

    fn parts(&self, verdict: &Verdict) -> Parts {
        let (fit, blocks) = (&verdict.now.fit, &verdict.blocks);
        let mut columns: Vec<Mixed> = fit.columns.clone();
        let links = columns.len() - fit.terms.iter().map(|t| t.values.len()).sum::<usize>();
        let mut at = links;
        let mut terms = Vec::new();
        for term in &fit.terms {
            let own = at..at + term.values.len();
            at = own.end;
            let done = self.dict.entry(term).done.clone();
            terms.push((own, done.as_ref().map(|_| columns.len())));
            columns.extend(done);
        }
        columns.push(self.dict.left(self.links, &[]));
        let (sums, count) = (self.dict.sums(blocks), columns.len());
        let folds = |products: Vec<DMatrix<f64>>| {
            let mut folds = vec![DMatrix::zeros(count, count); blocks.folds];
            products.iter().zip(&blocks.fold).for_each(|(own, fold)| folds[*fold] += own);
            folds
        };
        let told = folds(sums.squares(&columns, &weights(&verdict.now.sizes)));
        let whole = told.iter().fold(DMatrix::zeros(count, count), |sum, fold| sum + fold);
        let joints = verdict.now.sizes.len();
        let own = parallel::map(joints, &|joint| {
            let rows = self.dict.rows_of(blocks, joint).iter().sum();
            (folds(sums.squares_of(joint, &columns)), rows)
        });
        let others = told.iter().map(|fold| &whole - fold).collect();
        Parts { links, terms, others, own }
    }
}

impl Parts {
    /// Root mean square of what the links and some terms leave of each joint, held out; 0 of a joint that has no rows.
    fn left(&self, terms: &[usize]) -> Vec<f64> {
        let terms = || terms.iter().map(|k| &self.terms[*k]);
        let kept: Vec<usize> = (0..self.links).chain(terms().flat_map(|t| t.0.clone())).collect();
        let of_fold = |others: &DMatrix<f64>| {
            let mut left = DVector::zeros(others.nrows());
            left[others.nrows() - 1] = 1.0;
            terms().filter_map(|term| term.1).for_each(|done| left[done] = -1.0);
            let matrix = others.select_rows(&kept).select_columns(&kept);
            let values = Basis::ordered(&matrix).solve(&(others * &left).select_rows(&kept));
            kept.iter().zip(values.iter()).for_each(|(column, value)| left[*column] = -value);
            left
        };
        let left: Vec<DVector<f64>> = self.others.iter().map(of_fold).collect();
        let of_joint = |(folds, rows): &(Vec<DMatrix<f64>>, f64)| {
            let squares = folds.iter().zip(&left).map(|(own, left)| quadratic(own, left));
            if *rows > 0.0 { (squares.sum::<f64>() / rows).sqrt() } else { 0.0 }
        };
        self.own.iter().map(of_joint).collect()
    }
}
