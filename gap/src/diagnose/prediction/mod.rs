//! What was found, as a model that predicts.
//!
//! **In:** the fits before and after the search.
//! **Out:** an [`Explanation`]: what the corrected arm reads in other measurements, and what is
//! [`Expected`] at a posture that was not measured, with what the spread of the fitted numbers
//! leaves of it.

mod at_tool;
mod expected;
mod explanation;
mod spread;
mod trust;

pub use expected::Expected;
pub use explanation::{Explanation, Prediction};
pub use trust::Trust;
