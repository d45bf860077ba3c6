//! Inference from normal equations of independent blocks: a campaign's visits, a log's stretches of time.
//!
//! **In:** [`Products`] of a model's columns, of candidates' columns and of what is to be explained, block by
//! block, whatever the observations are.
//! **Out:** a [`Screen`] that gives the [`Score`] of each candidate beside the model, the squares that it
//! leaves on blocks that no fit has seen, and each block's share in it, whose signs [`SignFlips`] set at random.
//! Candidates are [`Ranked`] by the evidence that they add, and the terms of a model of any [`Observations`] are
//! [`pruned`] by the same. [`Asked`] holds the questions by which a candidate is found, and a finding kept.
//!
//! Least squares are solved by a [`Basis`], with bounds by [`Squares`]; `autocorrelation` says how long errors
//! last, `resample` how far a shrink scatters when blocks are drawn again. [`rng`] draws the same numbers from a seed in
//! every version, [`parallel`] works on all cores with results in their order.

mod asked;
mod autocorrelation;
mod basis;
mod bounded;
pub mod constants;
mod dependent;
mod evidence;
pub mod limits;
mod order;
pub mod parallel;
mod products;
mod quantile;
mod rank;
mod resample;
pub mod rng;
mod score;
mod screen;
mod select;
mod signs;

pub use asked::{Answer, Asked, Doubt, worst};
pub use autocorrelation::{Autoregression, correlation_time};
pub use basis::{Basis, RANK, principal};
pub use bounded::Squares;
pub use dependent::Dependent;
pub use evidence::{Scale, likely_scale};
pub use order::ordered;
pub use products::{Choice, Products, starts};
pub use quantile::{ascending, middle, percentile};
pub use rank::Ranked;
pub use resample::{drawn, interval, students_t, two_sided};
pub use score::{Own, Score, price};
pub use screen::{Columns, Screen, Usual};
pub use select::{Observations, Terms, Weighed, against, costs, pruned};
pub use signs::{SignFlips, Signs, deviate, unit};
