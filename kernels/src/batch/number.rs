//! The numbers of which batches are made, and their lanes.

use crate::Scalar;
use crate::lanes;

/// A number that has lanes: f64 and f32.
pub trait Number: Scalar + Send + Sync {
    /// Several of them: as many as a register holds, or four doubles where that is fewer.
    type Lanes: Scalar;
    /// How many.
    const WIDTH: usize;

    /// Lanes of what `each` gives, `each(0)` first.
    fn pack(each: impl FnMut(usize) -> Self) -> Self::Lanes;

    /// Hands each lane to `each`, in order.
    fn unpack(lanes: Self::Lanes, each: impl FnMut((usize, Self)));

    /// Writes the lanes side by side; `out` is [`Number::WIDTH`] long.
    fn store(lanes: Self::Lanes, out: &mut [Self]);

    /// Writes the first lane of all `entries`, then the second of all, and so on; `out` is
    /// [`Number::WIDTH`] times as long as `entries`.
    fn store_by_lane(entries: &[Self::Lanes], out: &mut [Self]);
}

macro_rules! number {
    ($float:ty, $lanes:ty, $width:literal, $square:ty, $side:literal) => {
        type Lanes = $lanes;
        const WIDTH: usize = $width;

        #[inline(always)]
        fn pack(each: impl FnMut(usize) -> Self) -> Self::Lanes {
            let each: [$float; $width] = core::array::from_fn(each);
            <$lanes>::from(each)
        }
        #[inline(always)]
        fn unpack(lanes: Self::Lanes, each: impl FnMut((usize, Self))) {
            lanes.to_array().into_iter().enumerate().for_each(each);
        }
        #[inline(always)]
        fn store(lanes: Self::Lanes, out: &mut [Self]) {
            out.copy_from_slice(&lanes.to_array());
        }
        #[inline(always)]
        fn store_by_lane(entries: &[Self::Lanes], out: &mut [Self]) {
            let length = entries.len();
            let Some(begin) = length.checked_sub($side) else {
                for (at, lanes) in entries.iter().enumerate() {
                    for (lane, x) in lanes.to_array().into_iter().enumerate() {
                        out[lane * length + at] = x;
                    }
                }
                return;
            };
            // A square of numbers at a time, turned in registers; the last one goes back over entries that
            // are already there.
            for start in (0..length).step_by($side).map(|at| at.min(begin)) {
                let (square, rest) = (&entries[start..start + $side], &mut out[start..]);
                for first in (0..$width).step_by($side) {
                    let row = |k: usize| -> [$float; $side] {
                        core::array::from_fn(|lane| square[k].as_array()[first + lane])
                    };
                    let square: [$square; $side] = core::array::from_fn(|k| row(k).into());
                    for (lane, run) in <$square>::transpose(square).into_iter().enumerate() {
                        rest[(first + lane) * length..][..$side].copy_from_slice(&run.to_array());
                    }
                }
            }
        }
    };
}

#[cfg(target_feature = "avx512f")]
impl Number for f64 {
    number!(f64, lanes::f64x8, 8, lanes::f64x4, 4);
}

#[cfg(not(target_feature = "avx512f"))]
impl Number for f64 {
    number!(f64, lanes::f64x4, 4, lanes::f64x4, 4);
}

impl Number for f32 {
    number!(f32, lanes::f32x8, 8, lanes::f32x8, 8);
}
