//! What a campaign and a log of one arm say of what both see.

use serde::Serialize;
use stiffarm_gap::spring::Joined;

/// What both say of what both see.
#[derive(Clone, Debug, Serialize)]
pub struct Said {
    /// What a log has a joint's spring as.
    pub effect: &'static str,
    /// Joints of which both tell something and one has found something.
    pub springs: Vec<Joined>,
    /// What the campaign measures: `m` or `rad`.
    pub measured_in: &'static str,
    /// What is left of the campaign, root mean square: with its own springs, with those of both.
    pub campaign: [f64; 2],
    /// What is left of the log, as a part of the joints' sizes: the same.
    pub log: [f64; 2],
}
