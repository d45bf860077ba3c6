//! What every candidate does to the residual, in sums over the rows.
//!
//! **In:** a [`Fit`](crate::diagnose::fit::Fit) and a list of [`Candidate`]s: an effect at a place in
//! one form, or a [`Probe`], a displacement of free form.
//! **Out:** [`Gathered`]: the products of the model's columns, the candidates' columns and the
//! residual, by blocks of poses, from one pass over the data; and from these, without looking at a
//! row again, a [`Screen`] (some of the columns are the model's, the others stand beside it) that
//! gives the [`Score`](crate::infer::Score) of each candidate and its held-out squares.
//!
//! Candidates that move the same joint or frame share its columns (`layout`, `stack`); what they
//! share is multiplied once.

mod candidate;
mod gather;
mod layout;
mod probe;
mod screen;
mod stack;
mod usual;

pub(crate) use candidate::{Candidate, Source};
pub(crate) use gather::{Gathered, Wanted};
pub(crate) use probe::{About, Probe};
pub(crate) use screen::{Kept, Screen};
pub(crate) use usual::scale_elastic;
