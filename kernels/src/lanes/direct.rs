//! Sines and cosines of lanes in the registers that the caller is compiled for.

use crate::scalar::each;
use crate::sin_cos::{double, single};

macro_rules! poses {
    ($name:ident, $lanes:ty, $sin_cos:path) => {
        /// All angles of several poses, each angle in lanes of its own.
        #[inline(always)]
        pub(crate) fn $name<const M: usize>(angles: [$lanes; M]) -> ([$lanes; M], [$lanes; M]) {
            each(angles, $sin_cos)
        }
    };
}

poses!(f64x4, wide::f64x4, double::sin_cos);
poses!(f64x8, wide::f64x8, double::sin_cos);
poses!(f32x8, wide::f32x8, single::sin_cos);
