//! How far shrinks scatter from one campaign to another: poses are drawn again, once for those that
//! are fitted and once for those on which the gap is measured.

use nalgebra::{DMatrix, DVector};

use super::outcome::{Group, Held};
use crate::infer::{Products, drawn};
use crate::parallel;

/// Logarithms of the gap's root mean square in campaigns drawn from the poses of this one: before the
/// first of some groups and after each, a row for each draw. The parameters are fitted to one such
/// campaign, the gap is what they leave in another.
pub(crate) struct Refitted(DMatrix<f64>);

impl Refitted {
    pub(crate) fn new(held: &Held<'_>, groups: &[Group], seed: u64) -> Self {
        let steps: Vec<Vec<usize>> = (0..=groups.len())
            .map(|count| held.kept(&groups[..count].iter().collect::<Vec<_>>()))
            .collect();
        let draws = drawn(held.blocks.len(), seed);
        let rows = parallel::each(&draws, &|[fitted, measured]| {
            let sum = |times: &[f64], which: usize| {
                let mut sum = Products::zeros(held.parameters(), &[]);
                let several = held.blocks.iter().zip(times).filter(|(_, times)| **times > 0.0);
                several.for_each(|(block, times)| sum.add_scaled(&block[which], *times));
                sum
            };
            let (white, plain) = (sum(fitted, 0), sum(measured, 1));
            // What cancels leaves the rounding of the whole.
            let least = (f64::EPSILON * plain.rr).max(f64::MIN_POSITIVE);
            let left = |kept: &Vec<usize>| plain.left(&held.solved(&white, kept)).max(least);
            let logs = steps.iter().map(|kept| 0.5 * left(kept).ln());
            DVector::from_iterator(steps.len(), logs).transpose()
        });
        Self(DMatrix::from_rows(&rows))
    }

    /// Standard deviation of the logarithm of the gap after step `to` over that after step `from`, of
    /// one campaign against another: this one too is but one of those that might have been.
    pub(crate) fn spread(&self, from: usize, to: usize) -> f64 {
        (2.0 * (self.0.column(to) - self.0.column(from)).variance()).sqrt()
    }
}
