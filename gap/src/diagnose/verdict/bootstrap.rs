//! Intervals by resampling poses: a pose is drawn with all its rows, and what is compared is
//! compared on the same poses.

use crate::infer::percentile;
use crate::rng::{Rng, Stream};

/// Resamplings of each interval.
const DRAWS: usize = 10_000;

/// 1 − rms after / rms before, from sums of squares; 0 if there is nothing to shrink.
pub(crate) fn shrink(before: f64, after: f64) -> f64 {
    if before > 0.0 { 1.0 - (after / before).sqrt() } else { 0.0 }
}

/// 95 % interval of the mean over rows of a difference, from its sum over each pose and the rows of
/// each pose.
pub(crate) fn mean_interval(differences: &[f64], rows: &[f64], seed: u64) -> [f64; 2] {
    let poses = differences.len();
    let mut rng = Rng::new(seed, Stream::Bootstrap);
    let mut mean = || {
        let (mut sum, mut count) = (0.0, 0.0);
        for _ in 0..poses {
            let pose = rng.index(poses);
            sum += differences[pose];
            count += rows[pose];
        }
        sum / f64::max(count, 1.0)
    };
    let mut means: Vec<f64> = (0..DRAWS).map(|_| mean()).collect();
    means.sort_by(f64::total_cmp);
    [0.025, 0.975].map(|p| percentile(&means, p))
}

/// Whether an interval leaves out 0.
pub(crate) fn excludes_zero([low, high]: [f64; 2]) -> bool {
    low > 0.0 || high < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_of_a_mean_is_that_of_the_normal_distribution() {
        let values: Vec<f64> = (0..200).map(|k| f64::from(k % 20) - 9.5).collect();
        let [low, high] = mean_interval(&values, &[1.0; 200], 3);
        let sd = (33.25_f64 / 200.0).sqrt();
        assert!((low + 1.96 * sd).abs() < 0.05 && (high - 1.96 * sd).abs() < 0.05, "{low} {high}");
        assert_eq!(mean_interval(&values, &[1.0; 200], 3), [low, high]);
        assert!(!excludes_zero([low, high]));
    }

    #[test]
    fn half_of_a_gap_is_a_quarter_of_its_squares() {
        assert_eq!(shrink(112.0, 28.0), 0.5);
        assert_eq!(shrink(0.0, 0.0), 0.0);
        assert!(excludes_zero([0.5, 0.5]) && excludes_zero([-2.0, -1.0]));
    }
}
