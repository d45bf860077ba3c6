//! Batches behind a pointer.

use super::{Error, Layout, Number, Wrenches};
use crate::{Kernels, Output};

/// An arm of which batches can be asked, whatever its table: what [`Kernels`] is to one pose. Every
/// generated robot implements it.
pub trait Batched<T: Number>: Sync {
    /// As [`evaluate`](super::evaluate); with the feature `rayon` on all cores.
    ///
    /// # Errors
    /// As [`evaluate`](super::evaluate).
    fn evaluate_batch(
        &self,
        output: Output,
        layout: Layout,
        q: &[T],
        wrenches: Wrenches<'_, T>,
        out: &mut [T],
    ) -> Result<(), Error>;

    /// As [`evaluate_columns`](super::evaluate_columns), on the caller's core.
    ///
    /// # Errors
    /// As [`evaluate_columns`](super::evaluate_columns).
    fn evaluate_columns(
        &self,
        output: Output,
        q: &[&[T]],
        wrench: &[&[T]],
        out: &mut [T],
    ) -> Result<(), Error>;
}

impl<T, R> Batched<T> for R
where
    T: Number,
    R: Kernels<T> + Kernels<T::Lanes> + Sync,
{
    fn evaluate_batch(
        &self,
        output: Output,
        layout: Layout,
        q: &[T],
        wrenches: Wrenches<'_, T>,
        out: &mut [T],
    ) -> Result<(), Error> {
        #[cfg(feature = "rayon")]
        return super::evaluate_parallel(self, output, layout, q, wrenches, out);
        #[cfg(not(feature = "rayon"))]
        super::evaluate(self, output, layout, q, wrenches, out)
    }
    fn evaluate_columns(
        &self,
        output: Output,
        q: &[&[T]],
        wrench: &[&[T]],
        out: &mut [T],
    ) -> Result<(), Error> {
        super::evaluate_columns(self, output, q, wrench, out)
    }
}
