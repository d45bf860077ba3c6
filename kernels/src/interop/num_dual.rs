//! num-dual's numbers as scalars: a kernel of them gives derivatives, exact but for rounding.

use num_dual::{
    Dual, Dual2, Dual2SVec, Dual3, DualNum, DualSVec, DualStruct as _, HyperDual, HyperHyperDual,
};

use crate::Scalar;

macro_rules! scalar {
    ($($doc:literal [$($size:tt)*] $dual:ty;)+) => {$(
        #[doc = $doc]
        impl<T: DualNum<Primitive = f64> + Copy $($size)*> Scalar for $dual {
            fn lit(x: f64) -> Self {
                x.into()
            }
            fn recip(self) -> Self {
                DualNum::recip(&self)
            }
            fn sqrt(self) -> Self {
                DualNum::sqrt(&self)
            }
            fn sign(self) -> Self {
                Scalar::sign(self.re()).into()
            }
            fn select(self, positive: Self, otherwise: Self) -> Self {
                if self.re() > 0.0 { positive } else { otherwise }
            }
            fn atan2(self, x: Self) -> Self {
                DualNum::atan2(&self, x)
            }
            fn sin_cos_all<const M: usize>(angles: [Self; M]) -> ([Self; M], [Self; M]) {
                crate::scalar::each(angles, |angle| angle.sin_cos())
            }
            fn is_positive(self) -> bool {
                self.re() > 0.0
            }
        }
    )+};
}

scalar! {
    "A first derivative by one variable."
    [] Dual<T>;
    "First and second derivative by one variable."
    [] Dual2<T>;
    "Up to the third derivative by one variable."
    [] Dual3<T>;
    "A second derivative by two variables."
    [] HyperDual<T>;
    "A third derivative by three variables."
    [] HyperHyperDual<T>;
    "A gradient by `N` variables."
    [, const N: usize] DualSVec<T, N>;
    "A gradient and a Hessian by `N` variables."
    [, const N: usize] Dual2SVec<T, N>;
}
