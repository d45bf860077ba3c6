//! Which of the unknowns the rows determine.

use nalgebra::{DMatrix, DVector};

use super::Unknown;
use crate::diagnose::fit::{Basis, RANK};

/// A column below this part of the largest of its kind is rounding.
const EMPTY: f64 = 1e-9;

/// A part of a combination below this does not belong to it.
const BELONGS: f64 = 1e-3;

/// Which columns are found, and of the others why not.
pub(super) struct Choice {
    /// Indices of columns, ascending.
    pub(super) found: Vec<usize>,
    /// Index of a column and of those that it is a combination of; none where it is empty.
    pub(super) held: Vec<(usize, Vec<usize>)>,
}

/// Of the products of whitened columns. Joints come first, those that show most before the others;
/// then links, then the base.
pub(super) fn choose(normal: &DMatrix<f64>, unknowns: &[Unknown]) -> Choice {
    let rank = |k: usize| match unknowns[k] {
        Unknown::Joint(_) => 0,
        Unknown::Link(_) => 1,
        Unknown::Base(component) => 2 + component / 3,
    };
    let norms = normal.diagonal().map(f64::sqrt);
    let largest = |kind: usize| {
        let same = (0..unknowns.len()).filter(|k| rank(*k) == kind);
        same.map(|k| norms[k]).fold(0.0, f64::max)
    };
    let mut order: Vec<usize> = (0..unknowns.len()).collect();
    order.sort_by(|&a, &b| rank(a).cmp(&rank(b)).then(norms[b].total_cmp(&norms[a])));
    let (mut found, mut held): (Vec<usize>, Vec<(usize, Vec<usize>)>) = Default::default();
    for k in order {
        if norms[k] <= EMPTY * largest(rank(k)) {
            held.push((k, Vec::new()));
            continue;
        }
        let with_found = normal.column(k).select_rows(&found);
        let beside = normal.select_rows(&found).select_columns(&found);
        let parts: DVector<f64> = Basis::new(&beside).solve(&with_found);
        let own = 1.0 - parts.dot(&with_found) / normal[(k, k)];
        // So that of as many columns together no direction is undecided.
        if own > RANK * unknowns.len() as f64 {
            found.push(k);
            continue;
        }
        let belongs = |(of, part): &(&usize, &f64)| part.abs() * norms[**of] > BELONGS * norms[k];
        let mut with: Vec<usize> =
            found.iter().zip(parts.iter()).filter(belongs).map(|(of, _)| *of).collect();
        with.sort_unstable();
        held.push((k, with));
    }
    found.sort_unstable();
    held.sort_unstable_by_key(|(k, _)| *k);
    Choice { found, held }
}
