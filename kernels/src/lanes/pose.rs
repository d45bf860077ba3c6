//! The angles of one pose, side by side in lanes.

use wide::{f32x4, f64x2};

use crate::sin_cos::{double, single};

/// A run of angles through one set of lanes: those from `first` on, as many as there are.
macro_rules! through {
    ($lanes:ty, $sin_cos:path, $angles:ident, $first:expr, $sines:ident, $cosines:ident) => {{
        let mut run = <$lanes>::ZERO.to_array();
        let count = ($angles.len() - $first).min(run.len());
        run[..count].copy_from_slice(&$angles[$first..$first + count]);
        let (s, c) = $sin_cos(<$lanes>::from(run));
        $sines[$first..$first + count].copy_from_slice(&s.to_array()[..count]);
        $cosines[$first..$first + count].copy_from_slice(&c.to_array()[..count]);
    }};
}

/// Doubles at a time: eight where the target is AMD's with AVX-512 (it alone has SSE4A), else four. Intel's cores close
/// port 1 to vectors while an instruction on 512 bits waits, and have but one port left for the products of a pose's
/// algebra, which are many times those of its sines: what they take in cycles at least, of a KUKA KR 240-2's compliance 151 where
/// four at a time leave 101, of its deflection 244 and 147.
const DOUBLES: usize =
    if cfg!(all(target_feature = "avx512f", target_feature = "sse4a")) { 8 } else { 4 };

/// All angles of one pose, [`DOUBLES`] at a time; what is left goes through half as many lanes where it fits.
#[inline(always)]
pub(crate) fn f64<const M: usize>(angles: [f64; M]) -> ([f64; M], [f64; M]) {
    let (mut sines, mut cosines) = (angles, angles);
    let mut first = 0;
    while first < M {
        let left = M - first;
        if left > 4 && DOUBLES == 8 {
            through!(wide::f64x8, double::sin_cos, angles, first, sines, cosines);
        } else if left > 2 {
            through!(wide::f64x4, double::sin_cos, angles, first, sines, cosines);
        } else {
            through!(f64x2, double::sin_cos, angles, first, sines, cosines);
        }
        first += DOUBLES;
    }
    (sines, cosines)
}

/// All angles of one pose, eight at a time; up to four that are left go through half as many lanes.
#[inline(always)]
pub(crate) fn f32<const M: usize>(angles: [f32; M]) -> ([f32; M], [f32; M]) {
    let (mut sines, mut cosines) = (angles, angles);
    let mut first = 0;
    while first < M {
        if M - first > 4 {
            through!(wide::f32x8, single::sin_cos, angles, first, sines, cosines);
        } else {
            through!(f32x4, single::sin_cos, angles, first, sines, cosines);
        }
        first += 8;
    }
    (sines, cosines)
}
