//! Cross-validated prediction of a residual from other times.

use super::super::blocks::Blocks;
use super::super::dictionary::Dictionary;
use super::quantity::{Of, PARTS, Parts};

/// Quantities are asked one after the other so often: by then what depends on several is predicted.
const STEPS: usize = 6;

/// The fold and the part of a row, and the sign that what is left has there.
type At = Option<(usize, usize, f64)>;

/// Sums of what is left and their number, of each fold and part.
struct Means {
    sums: Vec<[f64; PARTS]>,
    counts: Vec<[f64; PARTS]>,
}

impl Means {
    fn of(left: &[Option<f64>], places: &[At], folds: usize) -> Means {
        let mut means =
            Means { sums: vec![[0.0; PARTS]; folds], counts: vec![[0.0; PARTS]; folds] };
        for (left, place) in left.iter().zip(places) {
            if let (Some(left), Some((fold, part, sign))) = (left, place) {
                means.sums[*fold][*part] += sign * left;
                means.counts[*fold][*part] += 1.0;
            }
        }
        means
    }

    /// The mean of a part in all folds but one; 0 where these have nothing of it.
    fn elsewhere(&self, fold: usize, part: usize) -> f64 {
        let others = || (0..self.sums.len()).filter(|other| *other != fold);
        let count: f64 = others().map(|other| self.counts[other][part]).sum();
        let sum: f64 = others().map(|other| self.sums[other][part]).sum();
        if count > 0.0 { sum / count } else { 0.0 }
    }

    /// By how much the squares become smaller if each fold's rows are told by the others'.
    fn gain(&self) -> f64 {
        let all = (0..self.sums.len()).flat_map(|fold| (0..PARTS).map(move |part| (fold, part)));
        all.map(|(fold, part)| {
            let mean = self.elsewhere(fold, part);
            mean * (2.0 * self.sums[fold][part] - mean * self.counts[fold][part])
        })
        .sum()
    }
}

/// What is left of a joint beside what the means of its parts in other folds predict, and by which quantities:
/// at every step by the one that predicts most, until none does.
pub(super) fn predicted(
    dict: &Dictionary<'_>,
    left: &[Option<f64>],
    quantities: &[&Parts],
    blocks: &Blocks,
) -> (Vec<Option<f64>>, Vec<Of>) {
    let fold = |k: usize| Some(blocks.fold[dict.block_of(blocks, dict.rows[k])?]);
    let folds: Vec<Option<usize>> = (0..left.len()).map(fold).collect();
    let places = |parts: &Parts| {
        let mut places = vec![None; left.len()];
        for (part, rows) in parts.rows.iter().enumerate() {
            for (k, sign) in rows {
                places[*k] = folds[*k].map(|fold| (fold, part, *sign));
            }
        }
        places
    };
    let places: Vec<Vec<At>> = quantities.iter().map(|p| places(p)).collect();
    // The mean before all else, which the parts of everything have in them.
    let is_mean = |places: &&Vec<At>| Means::of(left, places, blocks.folds).gain() > 0.0;
    let own = quantities.iter().zip(&places).filter(|(parts, _)| parts.of == Of::Mean);
    let mut by: Vec<Of> = own.filter(|(_, places)| is_mean(places)).map(|_| Of::Mean).collect();
    let counted = || left.iter().flatten();
    let mean = counted().sum::<f64>() / counted().count().max(1) as f64;
    let beyond =
        |(left, fold): (&Option<f64>, &Option<usize>)| fold.and(*left).map(|left| left - mean);
    let mut beside: Vec<Option<f64>> = left.iter().zip(&folds).map(beyond).collect();
    for _ in 0..STEPS {
        let means = places.iter().map(|places| Means::of(&beside, places, blocks.folds));
        let asked = means.enumerate().map(|(k, means)| (means.gain(), k, means));
        let Some((gain, k, means)) = asked.max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
        if gain <= 0.0 {
            break;
        }
        for (left, place) in beside.iter_mut().zip(&places[k]) {
            if let (Some(left), Some((fold, part, sign))) = (left, place) {
                *left -= sign * means.elsewhere(*fold, *part);
            }
        }
        by.push(quantities[k].of);
    }
    (beside, by)
}
