//! How far a gap shrinks on what no fit has seen, with an interval.

use serde::{Deserialize, Serialize};

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
