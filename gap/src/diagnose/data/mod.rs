//! The data as they are to be explained.
//!
//! **In:** the robot file's arm, the rows of a measurement file, the options.
//! **Out:** the [`Problem`] (rows whose numbers can be worked with, the components that are measured,
//! the frames and markers that are unknown, the rows that fit, the [`Visits`], the [`Precision`] of each
//! row), the [`Folds`] (which poses are held out together), and the [`Noise`] (what a residual is
//! weighted by, and whether what is left is more than noise).
//!
//! Everything random in a diagnosis is drawn from a stream of the [generator](crate::rng), so that the
//! same options on the same data give the same bytes.

mod folds;
mod noise;
mod outliers;
mod precision;
mod problem;
mod visits;

pub(crate) use folds::Folds;
pub(crate) use noise::Noise;
pub(crate) use outliers::fitting;
pub(crate) use precision::Precision;
pub use problem::LARGEST;
pub(crate) use problem::{Problem, Thing};
