//! The six numbers of a frame's displacement.

use nalgebra::Vector6;

use super::{Parameter, Quantity};
use crate::displacement::Displacement;

/// Of these kinds: how far it is shifted, and turned.
pub const fn displacement(length: Quantity, angle: Quantity) -> [Parameter; 6] {
    [
        Parameter::free("x", length).usually(0.05),
        Parameter::free("y", length).usually(0.05),
        Parameter::free("z", length).usually(0.05),
        Parameter::free("rx", angle).usually(0.05),
        Parameter::free("ry", angle).usually(0.05),
        Parameter::free("rz", angle).usually(0.05),
    ]
}

/// One displacement of a frame and then, in the frame that it leads to, another; six numbers each.
pub fn one_after_other(first: &[f64], then: &[f64]) -> Vec<f64> {
    let [first, then] = [first, then].map(|v| Displacement::new(&Vector6::from_column_slice(v)));
    first.then(&then).vector().iter().copied().collect()
}
