//! The exact fit: frames and effects together, as true transforms of the arm at rest.
//!
//! **In:** a [`Problem`](crate::diagnose::data::Problem), a [`Model`] (the frames, and the effects
//! in it with their values), the weights.
//! **Out:** the [`Fit`]: the model with the values of least squares, and what it [`Predicted`] of
//! every row, so the residual.
//!
//! [`aligned`] is where it begins when frames are unknown. Least squares are solved by
//! [`infer`](crate::infer).

mod align;
mod axes;
mod bond;
mod model;
mod placed;
mod refit;

pub(crate) use align::{aligned, fitted_thing, rigid};
pub(crate) use axes::Axes;
pub(crate) use bond::{Bond, Place};
pub(crate) use model::{Fitted, Model, Predicted};
pub(crate) use placed::{Placed, placed};
pub(crate) use refit::{
    Fit, block, normal_equations, prior_penalty, refit, refit_below, refit_roughly, squares, step,
};
