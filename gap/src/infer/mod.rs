//! Inference from normal equations of independent blocks: a campaign's visits, a log's stretches of time.
//!
//! **In:** [`Products`] of a model's columns, of candidates' columns and of what is to be explained, block by
//! block, whatever the observations are.
//! **Out:** a [`Screen`] that gives the [`Score`] of each candidate beside the model, the squares that it
//! leaves on blocks that no fit has seen, and each block's share in it, whose signs [`SignFlips`] set at random.
//! Candidates are [`Ranked`] by the evidence that they add, and the terms of a model of any [`Observations`] are
//! [`pruned`] by the same.
//!
//! Least squares are solved by a [`Basis`], with bounds by [`Squares`]; `autocorrelation` says how long errors
//! last, `resample` how far a shrink scatters when blocks are drawn again.

mod autocorrelation;
mod basis;
mod bounded;
pub(crate) mod constants;
mod dependent;
mod evidence;
mod order;
mod products;
mod rank;
mod resample;
mod score;
mod screen;
mod select;
mod signs;

pub(crate) use autocorrelation::{Autoregression, correlation_time};
pub(crate) use basis::{Basis, RANK, principal};
pub(crate) use bounded::Squares;
pub(crate) use dependent::Dependent;
pub(crate) use evidence::{Scale, likely_scale};
pub(crate) use order::ordered;
pub(crate) use products::{Choice, Products, starts};
pub(crate) use rank::Ranked;
pub(crate) use resample::{drawn, interval, students_t, two_sided};
pub(crate) use score::{Own, Score, price};
pub(crate) use screen::{Columns, Screen};
pub(crate) use select::{Observations, Terms, Weighed, against, costs, pruned};
pub(crate) use signs::{SignFlips, Signs, deviate, unit};
