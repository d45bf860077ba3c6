//! The search itself, held out: run again on all blocks but one fold's, for each.

use super::Search;
use super::blocks::Blocks;
use super::dictionary::Dictionary;
use super::fit::Links;
use super::normal_equations::quadratic;
use crate::parallel;

/// Root mean square that is left of each joint by what a search finds that has not seen a fold, over all
/// folds; 0 of a joint that has no rows.
pub fn nested(dict: &Dictionary<'_>, blocks: &Blocks, links: &Links, seed: u64) -> Vec<f64> {
    let joints = dict.case.signals.joints();
    let offers: Vec<usize> = (0..dict.offers.len()).collect();
    let sums = dict.sums(blocks);
    let of_fold = |fold: usize| -> Vec<f64> {
        let seen = dict.without(blocks, fold);
        let search = Search::new(&seen, links, &offers, seed);
        let last = search.run(&[], &mut |_| {});
        let (columns, values) = search.converged(&last, &mut |_| {}).now.fit.bordered();
        let values = nalgebra::DVector::from_vec(values);
        let left = |joint: usize| {
            let products = sums.squares_of(joint, &columns);
            let own = products.iter().zip(&blocks.fold).filter(|(_, of)| **of == fold);
            own.map(|(product, _)| quadratic(product, &values)).sum()
        };
        (0..joints).map(left).collect()
    };
    let squares: Vec<Vec<f64>> = parallel::map(blocks.folds, &of_fold);
    let size = |joint: usize| {
        let rows: f64 = dict.rows_of(blocks, joint).iter().sum();
        let sum: f64 = squares.iter().map(|fold| fold[joint]).sum();
        if rows > 0.0 { (sum / rows).sqrt() } else { 0.0 }
    };
    (0..joints).map(size).collect()
}
