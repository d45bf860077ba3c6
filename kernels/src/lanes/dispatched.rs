//! Sines and cosines of lanes in the registers that the machine has, where the caller is compiled for
//! less. A single pose is not worth the way there and back.

use crate::sin_cos::dispatch;

/// Numbers in a set.
const SET: usize = 8;

macro_rules! poses {
    ($name:ident, $lanes:ty, $float:ty, $sets:path) => {
        /// All angles of several poses, each a set of its own.
        #[inline(always)]
        pub(crate) fn $name<const M: usize>(angles: [$lanes; M]) -> ([$lanes; M], [$lanes; M]) {
            let angles = angles.map(<$lanes>::to_array);
            let (mut sines, mut cosines) = (angles, angles);
            $sets(&angles, &mut sines, &mut cosines);
            (sines.map(<$lanes>::from), cosines.map(<$lanes>::from))
        }
    };
}

poses!(f64x8, wide::f64x8, f64, dispatch::doubles);
poses!(f32x8, wide::f32x8, f32, dispatch::singles);

/// All angles of four poses, two to a set.
#[inline(always)]
pub(crate) fn f64x4<const M: usize>(
    angles: [wide::f64x4; M],
) -> ([wide::f64x4; M], [wide::f64x4; M]) {
    // As many sets as there are angles: no length is a half in a constant expression.
    let (mut x, mut s, mut c) = ([[0.0; SET]; M], [[0.0; SET]; M], [[0.0; SET]; M]);
    for (k, lanes) in angles.into_iter().enumerate() {
        x[k / 2][SET / 2 * (k % 2)..][..SET / 2].copy_from_slice(&lanes.to_array());
    }
    let sets = M.div_ceil(2);
    dispatch::doubles(&x[..sets], &mut s[..sets], &mut c[..sets]);
    let lanes = |sets: &[[f64; SET]; M], k: usize| {
        let half = &sets[k / 2][SET / 2 * (k % 2)..][..SET / 2];
        wide::f64x4::from([half[0], half[1], half[2], half[3]])
    };
    (core::array::from_fn(|k| lanes(&s, k)), core::array::from_fn(|k| lanes(&c, k)))
}
