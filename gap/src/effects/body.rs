//! The ten numbers of a body, as the regressor of rigid links has them.

use super::{Parameter, Quantity};

const FIRST: Quantity = Quantity::In("kg·m");
const SECOND: Quantity = Quantity::In("kg·m²");

/// Mass, first moments, and the tensor of the second about the frame's origin.
pub const BODY: [Parameter; 10] = [
    Parameter::free("m", Quantity::Mass),
    Parameter::free("mx", FIRST),
    Parameter::free("my", FIRST),
    Parameter::free("mz", FIRST),
    Parameter::free("xx", SECOND),
    Parameter::free("xy", SECOND),
    Parameter::free("yy", SECOND),
    Parameter::free("xz", SECOND),
    Parameter::free("yz", SECOND),
    Parameter::free("zz", SECOND),
];

/// Ten numbers of a body of which one is a unit.
pub fn units() -> impl Iterator<Item = [f64; 10]> {
    (0..10).map(|k| std::array::from_fn(|l| f64::from(u8::from(k == l))))
}
