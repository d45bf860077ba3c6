//! The numbers a kernel can be evaluated with.

use core::ops::{Add, Mul, Neg, Sub};

/// What generated code asks of its numbers: f32 and f64 here; SIMD lanes and dual numbers by
/// implementing this trait.
pub trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// A constant of the generated text, in every lane.
    fn lit(x: f64) -> Self;

    /// `1/self`.
    fn recip(self) -> Self;

    /// The square root.
    fn sqrt(self) -> Self;

    /// Sines and cosines of all angles of one pose at once, so that an implementation may compute
    /// them in lanes.
    fn sin_cos_all<const M: usize>(angles: [Self; M]) -> ([Self; M], [Self; M]);

    /// Whether the value is above zero, in every lane; false for NaN.
    fn is_positive(self) -> bool;
}

impl Scalar for f64 {
    fn lit(x: f64) -> Self {
        x
    }
    fn recip(self) -> Self {
        1.0 / self
    }
    fn sqrt(self) -> Self {
        libm::sqrt(self)
    }
    fn sin_cos_all<const M: usize>(angles: [Self; M]) -> ([Self; M], [Self; M]) {
        (angles.map(libm::sin), angles.map(libm::cos))
    }
    fn is_positive(self) -> bool {
        self > 0.0
    }
}

impl Scalar for f32 {
    fn lit(x: f64) -> Self {
        x as f32
    }
    fn recip(self) -> Self {
        1.0 / self
    }
    fn sqrt(self) -> Self {
        libm::sqrtf(self)
    }
    fn sin_cos_all<const M: usize>(angles: [Self; M]) -> ([Self; M], [Self; M]) {
        (angles.map(libm::sinf), angles.map(libm::cosf))
    }
    fn is_positive(self) -> bool {
        self > 0.0
    }
}
