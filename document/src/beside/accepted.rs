//! Pass or fail: the corrected arm against a tolerance.

use serde::Serialize;

/// What was asked for, and what is reached by 95 % of the rows: of those of another file where one was
/// checked, else of those of this one, each predicted by fits that have not seen it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Accepted {
    /// m.
    pub tolerance: f64,
    /// The 95th percentile of the position's gap with the findings, m.
    pub position_p95: f64,
    /// Whether that is within the tolerance.
    pub accepted: bool,
    /// `held out`, or the file that was checked.
    pub of: String,
}
