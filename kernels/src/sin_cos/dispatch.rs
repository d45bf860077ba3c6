//! Many sines and cosines in the widest registers that the machine has, found out as it runs.
//!
//! What a caller compiles for plain x86-64 has two doubles to a register. The polynomial is compiled
//! here for AVX2 and AVX-512 as well, and each call takes the best that the processor offers. Nothing is
//! fused, so all of them give the same bits.

use fearless_simd::{Level, Simd, dispatch};

use super::{double, single};

macro_rules! dispatched {
    ($name:ident, $float:ty, $width:literal, $sin_cos:path) => {
        /// Sines and cosines of `angles`; all three are of one length. Whole sets, so that nothing is
        /// left over for a loop of its own.
        pub(crate) fn $name(
            angles: &[[$float; $width]],
            sines: &mut [[$float; $width]],
            cosines: &mut [[$float; $width]],
        ) {
            #[inline(always)]
            fn each<L: Simd>(_: L, angles: &[$float], sines: &mut [$float], cosines: &mut [$float]) {
                for ((x, s), c) in angles.iter().zip(sines).zip(cosines) {
                    (*s, *c) = $sin_cos(*x);
                }
            }
            dispatch!(Level::new(), level => each(
                level,
                angles.as_flattened(),
                sines.as_flattened_mut(),
                cosines.as_flattened_mut(),
            ));
        }
    };
}

dispatched!(doubles, f64, 8, double::sin_cos);
dispatched!(singles, f32, 8, single::sin_cos);
