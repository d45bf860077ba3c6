//! Whether an effect explains more of the gap than chance would, at the best of all places tried.
//!
//! If the gap had no cause, the gap of each pose could as well have had the other sign. So the
//! signs of whole poses are flipped, and the best that *any* candidate then explains is compared
//! with what the chosen one explains of the gap as it is (the distribution of the maximum:
//! corrected for the number tried).

use nalgebra::{DVector, Vector6};
use rand_chacha::rand_core::Rng;

use super::fit::{Candidate, by_pose, sum};
use super::normal::Normal;
use super::problem::Problem;
use super::rng::{Stream, generator};

/// Sign patterns drawn at random.
const DRAWS: usize = 9_999;

/// Up to this many poses all sign patterns are gone through.
const MOST_EXACT: usize = 13;

/// Two statistics closer than this (relative) are equal but for rounding.
const TIE: f64 = 1e-9;

/// One candidate's normal equations at the model as it is.
struct Trial {
    poses: Vec<Normal>,
    whole: Normal,
    least: DVector<f64>,
    /// `Xᵀ r` of each pose for the first parameter.
    xr: Vec<f64>,
}

impl Trial {
    /// What the candidate explains with the poses' gaps signed so.
    fn explained(&mut self, signs: &[bool]) -> f64 {
        if let [least] = self.least.as_slice() {
            return self.explained_by_one(*least, signs);
        }
        self.whole.xr.fill(0.0);
        for (pose, flipped) in self.poses.iter().zip(signs) {
            let sign = if *flipped { -1.0 } else { 1.0 };
            self.whole.xr.axpy(sign, &pose.xr, 1.0);
        }
        let c = self.whole.solve(&self.least);
        self.whole.explained(&c)
    }

    /// The same of a single parameter, without matrices: this runs ten thousand times.
    fn explained_by_one(&self, least: f64, signs: &[bool]) -> f64 {
        let xx = self.whole.xx[(0, 0)];
        let signed =
            self.xr.iter().zip(signs).map(|(xr, flipped)| if *flipped { -xr } else { *xr });
        let xr: f64 = signed.sum();
        let c = if xx > 0.0 { (xr / xx).max(least) } else { 0.0 };
        2.0 * c * xr - c * c * xx
    }
}

/// The probability that the best of `candidates` explains as much of a gap without cause as
/// `chosen` (its index) does of this one. `w` weights the components of a row.
pub(crate) fn p_value(
    problem: &Problem<'_>,
    candidates: &[Candidate],
    chosen: usize,
    w: &Vector6<f64>,
    seed: u64,
) -> f64 {
    let mut trials: Vec<Trial> = candidates
        .iter()
        .map(|candidate| {
            let poses = by_pose(problem, &candidate.nominal, w);
            let xr = poses.iter().map(|p| p.xr.get(0).copied().unwrap_or(0.0)).collect();
            Trial { whole: sum(&poses, |_| true), least: candidate.least(), xr, poses }
        })
        .collect();
    let poses = problem.data.poses;
    let observed = trials[chosen].explained(&vec![false; poses]);
    let mut as_much = |signs: &[bool]| {
        trials.iter_mut().any(|trial| trial.explained(signs) >= observed * (1.0 - TIE))
    };
    if poses <= MOST_EXACT {
        let patterns = 1_usize << poses;
        let hits = (0..patterns)
            .filter(|pattern| {
                let signs: Vec<bool> = (0..poses).map(|pose| pattern >> pose & 1 == 1).collect();
                as_much(&signs)
            })
            .count();
        return hits as f64 / patterns as f64;
    }
    let mut generator = generator(seed, Stream::Signs);
    let mut signs = vec![false; poses];
    let mut hits = 0;
    for _ in 0..DRAWS {
        let mut bits = 0;
        for (pose, sign) in signs.iter_mut().enumerate() {
            if pose % 64 == 0 {
                bits = generator.next_u64();
            }
            *sign = bits & 1 == 1;
            bits >>= 1;
        }
        hits += usize::from(as_much(&signs));
    }
    (1 + hits) as f64 / (1 + DRAWS) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::visibility::candidates;
    use crate::effects::CATALOGUE;
    use crate::fixture::{rigid, row, table};
    use crate::measurement::{Kind, Measurements, Row};
    use crate::simulate::simulate;

    /// `poses` poses whose gap is `gap(pose)` downwards at the tool.
    fn data(poses: usize, gap: impl Fn(usize) -> f64) -> Measurements {
        let kind = Kind::Pose { orientation: false };
        let rows = (0..poses)
            .map(|group| {
                let t = group as f64;
                let q = [0.3 * t, (1.7 * t).sin(), (0.9 * t).cos()];
                let mut row =
                    Row { group, ..row(&q, Vector6::new(0.0, 0.0, -500.0, 0.0, 0.0, 0.0)) };
                row.measured = simulate(&rigid(), &row, kind).unwrap().reading().vector();
                row.measured[2] -= gap(group);
                row
            })
            .collect();
        table(rows, kind)
    }

    fn p(data: &Measurements) -> f64 {
        let arm = rigid();
        let problem = Problem::new(&arm, data).unwrap();
        let (candidates, _) = candidates(&problem, &CATALOGUE);
        let w = Vector6::repeat(1.0);
        (0..candidates.len()).map(|k| p_value(&problem, &candidates, k, &w, 5)).fold(1.0, f64::min)
    }

    #[test]
    fn a_steady_sag_is_significant_and_alternation_is_not() {
        assert!(p(&data(10, |_| 1e-3)) <= 2.0 / 1024.0);
        assert!(p(&data(40, |_| 1e-3)) <= 2e-4);
        assert!(p(&data(10, |k| if k % 2 == 0 { 1e-3 } else { -1e-3 })) > 0.05);
        assert!(p(&data(40, |k| if k % 2 == 0 { 1e-3 } else { -1e-3 })) > 0.05);
    }

    #[test]
    fn one_parameter_and_matrices_agree() {
        let (arm, data) = (rigid(), data(6, |k| 1e-3 * (1.0 + k as f64)));
        let problem = Problem::new(&arm, &data).unwrap();
        let (candidates, _) = candidates(&problem, &CATALOGUE);
        let poses = by_pose(&problem, &candidates[0].nominal, &Vector6::repeat(1.0));
        let mut whole = sum(&poses, |_| true);
        let xr: Vec<f64> = poses.iter().map(|p| p.xr[0]).collect();
        let least = candidates[0].least();
        let signs = [false, true, false, false, true, false];
        let mut trial = Trial { poses, whole: whole.clone(), least: least.clone(), xr };
        whole.xr[0] = trial.xr.iter().zip(signs).map(|(x, s)| if s { -x } else { *x }).sum();
        let want = whole.explained(&whole.solve(&least));
        assert!((trial.explained(&signs) - want).abs() <= 1e-12 * want.abs());
    }

    #[test]
    fn few_poses_cannot_be_significant() {
        assert!(p(&data(3, |_| 1e-3)) >= 1.0 / 8.0);
    }
}
