//! Numbers by which both engines decide.

/// A finding's largest p value, over all candidates that were tried. The withheld suites measure the rate of
/// false alarms that it gives (`docs/gap.md`).
pub(crate) const SIGNIFICANT: f64 = 0.05;
