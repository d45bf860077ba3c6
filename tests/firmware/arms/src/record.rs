//! How results are written as bits.

use stiffarm::kernels::Unstable;

use crate::Real;
use crate::set_point::{Correction, Refusal};

/// In the place of a length: there is no stable equilibrium.
pub const UNSTABLE: u32 = u32::MAX;

/// In the place of a length: the input was refused.
pub const NOT_FINITE: u32 = u32::MAX - 1;

/// Where bits go.
pub trait Sink {
    /// An integer.
    fn word(&mut self, word: u32);
    /// A number.
    fn number<S: Real>(&mut self, number: S);
}

/// An output: how many numbers it has and their bits, or [`UNSTABLE`].
#[inline(never)]
pub fn output<S: Real>(sink: &mut impl Sink, result: Result<&[S], Unstable>) {
    match result {
        Ok(values) => {
            sink.word(values.len() as u32);
            values.iter().for_each(|value| sink.number(*value));
        }
        Err(Unstable) => sink.word(UNSTABLE),
    }
}

/// A period of the loop: deflection and set-point, or why there is none.
pub fn period<S: Real>(sink: &mut impl Sink, result: &Result<Correction<S>, Refusal>) {
    match result {
        Ok(correction) => {
            sink.word((correction.deflection.len() + correction.set_point.len()) as u32);
            correction.deflection.iter().for_each(|value| sink.number(*value));
            correction.set_point.iter().for_each(|value| sink.number(*value));
        }
        Err(Refusal::Unstable) => sink.word(UNSTABLE),
        Err(Refusal::NotFinite) => sink.word(NOT_FINITE),
    }
}
