//! Which of the unknowns the rows determine.

use nalgebra::DMatrix;

use super::Unknown;
use crate::infer::limits::ROUNDING;
use crate::infer::{Dependent, RANK};

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
    // One that leaves no trace is no part of others.
    let is_empty = |k: &usize| norms[*k] <= ROUNDING * largest(rank(*k));
    let (empty, order): (Vec<usize>, Vec<usize>) = order.into_iter().partition(is_empty);
    // So that of as many columns together no direction is undecided.
    let least = RANK * unknowns.len() as f64;
    let Dependent { apart: mut found, others } = Dependent::of(normal, order.into_iter(), least);
    let mut held: Vec<(usize, Vec<usize>)> = empty.into_iter().map(|k| (k, Vec::new())).collect();
    held.extend(others.into_iter().map(|(k, parts)| {
        let belongs = parts.iter().filter(|(_, part)| part.abs() > BELONGS);
        let mut with: Vec<usize> = belongs.map(|(of, _)| *of).collect();
        with.sort_unstable();
        (k, with)
    }));
    found.sort_unstable();
    held.sort_unstable_by_key(|(k, _)| *k);
    Choice { found, held }
}
