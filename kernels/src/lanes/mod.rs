//! Lanes: one kernel call for four or eight poses at once.
//!
//! [`f64x4`], [`f64x8`] and [`f32x8`] are `wide`'s; each lane is one pose. Every operation rounds as it
//! does for one number, so a lane gives the same bits as the scalar kernel does.

use wide::{f32x4, f64x2, u32x4, u32x8, u64x2, u64x4, u64x8};
pub use wide::{f32x8, f64x4, f64x8};

use crate::Scalar;
use crate::arctan::{DOUBLE, SINGLE, atan2};
use crate::sin_cos::Masked;

#[cfg(not(feature = "libm"))]
pub(crate) mod pose;
#[cfg_attr(
    all(feature = "dispatch", target_arch = "x86_64", not(target_feature = "avx2")),
    path = "dispatched.rs"
)]
#[cfg_attr(
    not(all(feature = "dispatch", target_arch = "x86_64", not(target_feature = "avx2"))),
    path = "direct.rs"
)]
mod poses;

macro_rules! masked_lanes {
    ($lanes:ty, $float:ty, $words:ty, $word:ty) => {
        impl Masked for $lanes {
            type Word = $words;
            const BITS: u32 = <$word>::BITS;

            #[inline(always)]
            fn of(x: f64) -> Self {
                <$lanes>::splat(x as $float)
            }
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                if cfg!(feature = "fma") { <$lanes>::mul_add(self, a, b) } else { self * a + b }
            }
            #[inline(always)]
            fn bits(self) -> $words {
                self.to_bits()
            }
            #[inline(always)]
            fn from_bits(word: $words) -> Self {
                <$lanes>::from_bits(word)
            }
            #[inline(always)]
            fn spread_last(word: $words) -> $words {
                <$words>::splat(0) - (word & <$words>::splat(1))
            }
            #[inline(always)]
            fn sign_bit() -> $words {
                <$words>::splat(1 << (<$word>::BITS - 1))
            }
            #[inline(always)]
            fn above(self, limit: f64) -> $words {
                self.abs().simd_gt(<$lanes>::splat(limit as $float)).to_bits()
            }
        }
    };
}

masked_lanes!(f64x2, f64, u64x2, u64);
masked_lanes!(f64x4, f64, u64x4, u64);
masked_lanes!(f64x8, f64, u64x8, u64);
masked_lanes!(f32x4, f32, u32x4, u32);
masked_lanes!(f32x8, f32, u32x8, u32);

macro_rules! scalar_lanes {
    ($lanes:ty, $float:ty, $all:path, $arctan:path) => {
        /// Each lane is a number of its own; sines and cosines are those of the scalar, lane by lane
        /// (always the crate's own polynomial, with the feature `libm` too).
        impl Scalar for $lanes {
            #[inline(always)]
            fn lit(x: f64) -> Self {
                <$lanes>::splat(x as $float)
            }
            #[inline(always)]
            fn recip(self) -> Self {
                <$lanes>::ONE / self
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                <$lanes>::sqrt(self)
            }
            #[inline(always)]
            fn sign(self) -> Self {
                let one = |mask: Self| mask & <$lanes>::ONE;
                one(self.simd_gt(<$lanes>::ZERO)) - one(self.simd_lt(<$lanes>::ZERO))
            }
            #[inline(always)]
            fn select(self, positive: Self, otherwise: Self) -> Self {
                self.simd_gt(<$lanes>::ZERO).select(positive, otherwise)
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                atan2(self, x, $arctan)
            }
            #[cfg(feature = "fma")]
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                <$lanes>::mul_add(self, a, b)
            }
            #[inline(always)]
            fn sin_cos_all<const M: usize>(angles: [Self; M]) -> ([Self; M], [Self; M]) {
                $all(angles)
            }
            #[inline(always)]
            fn is_positive(self) -> bool {
                self.simd_gt(<$lanes>::ZERO).all()
            }
        }
    };
}

scalar_lanes!(f64x4, f64, poses::f64x4, DOUBLE);
scalar_lanes!(f64x8, f64, poses::f64x8, DOUBLE);
scalar_lanes!(f32x8, f32, poses::f32x8, SINGLE);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sin_cos::{double, single};

    /// Angles of every kind, from one that is no number to large ones.
    fn angles() -> impl Iterator<Item = f64> {
        let odd = [0.0, -0.0, 1e-310, f64::NAN, f64::INFINITY, -f64::INFINITY, 2e9, -1e300];
        let plain = (0..100_000).map(|k| 0.11 * f64::from(k) - 2500.3);
        odd.into_iter().chain(plain)
    }

    macro_rules! same_bits {
        ($name:ident, $lanes:ty, $float:ty, $sin_cos:path) => {
            #[test]
            fn $name() {
                let all: [$float; 100_008] = {
                    let mut each = angles();
                    core::array::from_fn(|_| each.next().expect("as many") as $float)
                };
                for run in all.as_chunks().0 {
                    let (sines, cosines) = $sin_cos(<$lanes>::from(*run));
                    let (sines, cosines) = (sines.to_array(), cosines.to_array());
                    for ((x, s), c) in run.iter().zip(sines).zip(cosines) {
                        let (sine, cosine) = $sin_cos(*x);
                        let same = |a: $float, b: $float| {
                            a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
                        };
                        assert!(same(s, sine) && same(c, cosine), "{x}: {s} {sine}, {c} {cosine}");
                    }
                }
            }
        };
    }

    same_bits!(two_doubles_are_as_one, f64x2, f64, double::sin_cos);
    same_bits!(four_doubles_are_as_one, f64x4, f64, double::sin_cos);
    same_bits!(eight_doubles_are_as_one, f64x8, f64, double::sin_cos);
    same_bits!(four_singles_are_as_one, f32x4, f32, single::sin_cos);
    same_bits!(eight_singles_are_as_one, f32x8, f32, single::sin_cos);

    #[test]
    fn positive_means_in_every_lane() {
        assert!(f64x4::splat(1e-300).is_positive());
        assert!(!f64x4::from([1.0, 2.0, 0.0, 3.0]).is_positive());
        assert!(!f32x8::splat(f32::NAN).is_positive());
    }

    #[test]
    fn quotients_and_roots_are_rounded_like_one() {
        fn check<S: Scalar>(x: f64) -> (S, S) {
            (S::lit(x).recip(), S::lit(x).sqrt())
        }
        for x in [2.0, 3.0, 7.7, 1e-3] {
            let (inverse, root) = check::<f64x8>(x);
            assert_eq!((inverse.to_array(), root.to_array()), ([1.0 / x; 8], [libm::sqrt(x); 8]));
            let (inverse, root) = check::<f32x8>(x);
            let x = x as f32;
            assert_eq!((inverse.to_array(), root.to_array()), ([1.0 / x; 8], [libm::sqrtf(x); 8]));
        }
    }
}
