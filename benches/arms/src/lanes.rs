//! Poses packed into lanes.

use stiffarm_kernels::lanes::{f64x4, f64x8};

/// Four poses to an array of lanes.
pub fn by_four<const N: usize>(poses: &[[f64; N]]) -> Vec<[f64x4; N]> {
    let pack = |four: &[[f64; N]; 4]| core::array::from_fn(|j| f64x4::from(four.map(|q| q[j])));
    poses.as_chunks().0.iter().map(pack).collect()
}

/// Eight poses to an array of lanes.
pub fn by_eight<const N: usize>(poses: &[[f64; N]]) -> Vec<[f64x8; N]> {
    let pack = |eight: &[[f64; N]; 8]| core::array::from_fn(|j| f64x8::from(eight.map(|q| q[j])));
    poses.as_chunks().0.iter().map(pack).collect()
}
