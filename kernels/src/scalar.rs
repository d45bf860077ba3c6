//! The numbers a kernel can be evaluated with.

use core::ops::{Add, Mul, Neg, Sub};

use crate::arctan::{self, atan2};

/// What generated code asks of its numbers: f32 and f64 here, lanes of them with the feature `lanes`;
/// dual numbers by implementing this trait.
pub trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// A constant of the generated text, in every lane.
    fn lit(x: f64) -> Self;

    /// `1/self`.
    fn recip(self) -> Self;

    /// The square root.
    fn sqrt(self) -> Self;

    /// 1 above zero, −1 below it, 0 at zero.
    fn sign(self) -> Self;

    /// `positive` above zero, else `otherwise`: lane by lane, without a branch.
    fn select(self, positive: Self, otherwise: Self) -> Self;

    /// The angle of the direction (x, self), −π to π; 0 where both are zero.
    fn atan2(self, x: Self) -> Self;

    /// Sines and cosines of all angles of one pose at once, so that an implementation may compute
    /// them in lanes.
    fn sin_cos_all<const M: usize>(angles: [Self; M]) -> ([Self; M], [Self; M]);

    /// `self·a + b`, for text that asks for it to be fused. Rounded twice like the plain operators
    /// unless an implementation has the instruction: those of this crate use it under the feature `fma`,
    /// on a target that has it.
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }

    /// Whether the value is above zero, in every lane; false for NaN.
    fn is_positive(self) -> bool;
}

/// A precision of the machine as a scalar: its constants of the arctangent, the crate's own sine and
/// cosine, and libm's functions.
macro_rules! scalar {
    ($(#[$doc:meta])* $own:ident, $arctan:ident, $sin_cos:ident, $sqrt:ident, $sin:ident, $cos:ident) => {
        $(#[$doc])*
        impl Scalar for $own {
            #[inline(always)]
            fn lit(x: f64) -> Self {
                x as $own
            }
            #[inline(always)]
            fn recip(self) -> Self {
                1.0 / self
            }
            #[inline]
            fn sqrt(self) -> Self {
                libm::$sqrt(self)
            }
            #[inline(always)]
            fn sign(self) -> Self {
                $own::from(self > 0.0) - $own::from(self < 0.0)
            }
            #[inline(always)]
            fn select(self, positive: Self, otherwise: Self) -> Self {
                if self > 0.0 { positive } else { otherwise }
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                atan2(self, x, arctan::$arctan)
            }
            #[cfg(all(feature = "fma", any(target_feature = "fma", target_arch = "aarch64")))]
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                $own::mul_add(self, a, b)
            }
            #[cfg(feature = "libm")]
            fn sin_cos_all<const M: usize>(angles: [Self; M]) -> ([Self; M], [Self; M]) {
                (angles.map(libm::$sin), angles.map(libm::$cos))
            }
            #[cfg(all(feature = "lanes", not(feature = "libm")))]
            #[inline(always)]
            fn sin_cos_all<const M: usize>(angles: [Self; M]) -> ([Self; M], [Self; M]) {
                crate::lanes::pose::$own(angles)
            }
            #[cfg(not(any(feature = "lanes", feature = "libm")))]
            #[inline(always)]
            fn sin_cos_all<const M: usize>(angles: [Self; M]) -> ([Self; M], [Self; M]) {
                each(angles, crate::sin_cos::$sin_cos::sin_cos)
            }
            #[inline(always)]
            fn is_positive(self) -> bool {
                self > 0.0
            }
        }
    };
}

scalar!(
    /// Sines and cosines by the crate's own polynomial, without a branch: at most 1.5 ulp off for
    /// |angle| ≤ 1e4 rad and exact at 0. To 1e9 rad the error grows like the spacing of the angles; beyond,
    /// and where an angle is not finite, both are NaN. With the feature `libm` they are libm's.
    f64, DOUBLE, double, sqrt, sin, cos
);
scalar!(
    /// Sines and cosines by the crate's own polynomial in single precision alone, without a branch: at most
    /// 1e-7 off for |angle| ≤ 100 rad and exact at 0. To 1e5 rad the error grows like the spacing of the
    /// angles; beyond, and where an angle is not finite, both are NaN. With the feature `libm` they are
    /// libm's.
    f32, SINGLE, single, sqrtf, sinf, cosf
);

/// Both functions of one angle after the other.
#[allow(dead_code, reason = "which of the ways to a sine needs it depends on features and target")]
#[inline(always)]
pub(crate) fn each<S: Copy, const M: usize>(
    angles: [S; M],
    sin_cos: impl Fn(S) -> (S, S),
) -> ([S; M], [S; M]) {
    let (mut sines, mut cosines) = (angles, angles);
    for (k, angle) in angles.into_iter().enumerate() {
        (sines[k], cosines[k]) = sin_cos(angle);
    }
    (sines, cosines)
}
