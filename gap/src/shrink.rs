//! How far a gap shrinks on what no fit has seen, with an interval.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// The gap on what no fit has seen. Of a campaign: position, m (rotation, rad, if no position is
/// measured). Of a log: the mean of the joints' gaps as parts of their sizes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shrink {
    /// Root mean square without the finding.
    pub before: f64,
    /// Root mean square with it.
    pub after: f64,
    /// 1 − after/before.
    pub shrink: f64,
    /// 95 % interval of that in another campaign or log: poses, or blocks of time, are drawn again, those
    /// to fit and those to measure the gap on.
    pub shrink_ci95: [f64; 2],
}

impl Shrink {
    /// 95 % interval of what is left, in the unit of `before`.
    pub fn after_ci95(&self) -> [f64; 2] {
        let [low, high] = self.shrink_ci95;
        [self.before * (1.0 - high), self.before * (1.0 - low)]
    }
}

/// 95 % interval of a shrink whose logarithm of what is left scatters by `spread` over data
/// that are drawn again from so many poses or blocks. What is drawn again scatters less than what it was drawn
/// from: the limits stand off by Student's deviate, and by the ratio of the variances.
pub(crate) fn interval(shrink: f64, spread: f64, count: usize) -> [f64; 2] {
    let freedom = count.saturating_sub(1).max(1) as f64;
    let t = StudentsT::new(0.0, 1.0, freedom).map_or(f64::MAX, |t| t.inverse_cdf(0.975));
    let off = t * spread * (1.0 + 1.0 / freedom).sqrt();
    [off, -off].map(|off| 1.0 - (1.0 - shrink) * off.exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_shrink_is_certain() {
        assert_eq!(interval(0.5, 0.0, 3), [0.5, 0.5]);
        // Student's t of 9 degrees of freedom.
        let [low, high] = interval(0.5, 0.1, 10);
        let off = 2.262_157 * 0.1 * (10.0_f64 / 9.0).sqrt();
        assert!((low - (1.0 - 0.5 * off.exp())).abs() < 1e-6, "{low}");
        assert!((high - (1.0 - 0.5 / off.exp())).abs() < 1e-6, "{high}");
    }
}
