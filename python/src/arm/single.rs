//! One pose of arrays that lie well, as a controller's loop asks for it: of these there is nothing to convert, to broadcast or
//! to hand to other threads.

use numpy::{PyArray1, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use stiffarm_kernels::{Input, Output};

/// State and load, if every argument is one row of as many doubles as are expected, all of them finite. What else an
/// argument may be, and what is wrong with it, is for the general way to say.
pub fn read(
    output: Output,
    n: usize,
    inputs: &[&Bound<'_, PyAny>],
    wrench: Option<&Bound<'_, PyAny>>,
) -> Option<(Vec<f64>, [f64; 6])> {
    let (first, others) = inputs.split_first()?;
    let mut state = row(first, n)?;
    for other in others {
        state.extend(row(other, n)?);
    }
    let wrench = match output.takes(Input::Wrench) {
        true => row(wrench?, 6)?.try_into().ok()?,
        false => [0.0; 6],
    };
    let finite = state.iter().chain(&wrench).fold(true, |good, x| good & x.is_finite());
    (finite && state.len() == output.state(n)).then_some((state, wrench))
}

/// The numbers are copied, which takes less time than NumPy's book of who reads what.
fn row(given: &Bound<'_, PyAny>, size: usize) -> Option<Vec<f64>> {
    let array = given.cast::<PyArray1<f64>>().ok()?;
    (array.len() == size).then(|| array.to_vec().ok()).flatten()
}
