//! Which of the unknowns the rows determine.

use nalgebra::{DMatrix, DVector};

use super::Unknown;

/// What is left of a column beside the others below this part of it is rounding.
const DEPENDENT: f64 = 1e-7;

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

/// Of whitened columns. Joints come first, those that show most before the others; then links, then
/// the base.
pub(super) fn choose(columns: &DMatrix<f64>, unknowns: &[Unknown]) -> Choice {
    let rank = |unknown: &Unknown| match unknown {
        Unknown::Joint(_) => 0,
        Unknown::Link(_) => 1,
        Unknown::Base(k) => 2 + k / 3,
    };
    let norms: Vec<f64> = columns.column_iter().map(|column| column.norm()).collect();
    let largest = |kind: usize| {
        let same = norms.iter().zip(unknowns).filter(|(_, u)| rank(u) == kind);
        same.map(|(norm, _)| *norm).fold(0.0, f64::max)
    };
    let mut order: Vec<usize> = (0..unknowns.len()).collect();
    order.sort_by(|&a, &b| {
        let kinds = rank(&unknowns[a]).cmp(&rank(&unknowns[b]));
        kinds.then(norms[b].total_cmp(&norms[a]))
    });
    let mut basis: Vec<DVector<f64>> = Vec::new();
    let (mut found, mut held): (Vec<usize>, Vec<(usize, Vec<usize>)>) = Default::default();
    for k in order {
        if norms[k] <= EMPTY * largest(rank(&unknowns[k])) {
            held.push((k, Vec::new()));
            continue;
        }
        let unit = columns.column(k) / norms[k];
        let mut rest = unit.clone();
        // Twice, so that rounding leaves nothing of the others.
        for _ in 0..2 {
            for direction in &basis {
                rest -= direction * direction.dot(&rest);
            }
        }
        if rest.norm() <= DEPENDENT {
            held.push((k, combination(columns, &norms, &found, &unit)));
        } else {
            basis.push(rest.normalize());
            found.push(k);
        }
    }
    found.sort_unstable();
    held.sort_unstable_by_key(|(k, _)| *k);
    Choice { found, held }
}

/// The columns of `found` that make up `unit`.
fn combination(
    columns: &DMatrix<f64>,
    norms: &[f64],
    found: &[usize],
    unit: &DVector<f64>,
) -> Vec<usize> {
    let scaled = DMatrix::from_fn(columns.nrows(), found.len(), |r, c| {
        columns[(r, found[c])] / norms[found[c]]
    });
    let parts = scaled.svd(true, true).solve(unit, DEPENDENT);
    let parts = parts.unwrap_or_else(|_| DVector::zeros(found.len()));
    let mut with: Vec<usize> = found
        .iter()
        .zip(parts.iter())
        .filter(|(_, p)| p.abs() > BELONGS)
        .map(|(k, _)| *k)
        .collect();
    with.sort_unstable();
    with
}
