//! All that a machine shows: every output at every draw, then both loops.

use crate::Real;
use crate::draw::COUNT;
use crate::outputs::visit;
use crate::record::{Sink, output, period};
use crate::{source, swing};

/// Writes it all, in the order in which it is compared.
pub fn write<S: Real>(sink: &mut impl Sink) {
    for k in 0..COUNT {
        visit::<S>(k, |result| output(sink, result));
    }
    source::run::<S>(|_, _, result| period(sink, result));
    swing::run::<S>(swing::PERIODS, |moved| output(sink, moved.map(|m| m.as_flattened())));
}
