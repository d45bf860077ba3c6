//! The numbers of simba, and with them nalgebra's: whatever is a `RealField`, or lanes of one.

use core::ops::{Add, Mul, Neg, Sub};

use ::simba::simd::{SimdBool as _, SimdRealField};

use crate::Scalar;

/// A number of simba's as a scalar of kernels. It wraps, for `f64` is such a number and a scalar already.
///
/// Of lanes each is a pose; where a kernel can refuse a load, one lane's refusal is that of all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field<T>(pub T);

macro_rules! operators {
    ($($trait:ident, $function:ident;)*) => {$(
        impl<T: SimdRealField + Copy> $trait for Field<T> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Field($trait::$function(self.0, other.0))
            }
        }
    )*};
}

operators! {
    Add, add;
    Sub, sub;
    Mul, mul;
}

impl<T: SimdRealField + Copy> Neg for Field<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Field(-self.0)
    }
}

/// Sines and cosines are the number's own.
impl<T: SimdRealField + Copy> Scalar for Field<T> {
    fn lit(x: f64) -> Self {
        Field(T::from_subset(&x))
    }
    fn recip(self) -> Self {
        Field(self.0.simd_recip())
    }
    fn sqrt(self) -> Self {
        Field(self.0.simd_sqrt())
    }
    fn sign(self) -> Self {
        let (zero, one) = (T::zero(), T::one());
        let above = one.select(self.0.simd_gt(zero), zero);
        let below = one.select(self.0.simd_lt(zero), zero);
        Field(above - below)
    }
    fn select(self, positive: Self, otherwise: Self) -> Self {
        Field(positive.0.select(self.0.simd_gt(T::zero()), otherwise.0))
    }
    fn atan2(self, x: Self) -> Self {
        Field(self.0.simd_atan2(x.0))
    }
    fn sin_cos_all<const M: usize>(angles: [Self; M]) -> ([Self; M], [Self; M]) {
        crate::scalar::each(angles, |Field(angle)| {
            let (sine, cosine) = angle.simd_sin_cos();
            (Field(sine), Field(cosine))
        })
    }
    fn is_positive(self) -> bool {
        self.0.simd_gt(T::zero()).all()
    }
}
