//! The two kinds of numbers, made of integers alone so that every machine makes the same ones.

use stiffarm::kernels::Scalar;

/// `f32` or `f64`.
pub trait Real: Scalar + PartialEq + 'static {
    /// Bytes of one number.
    const BYTES: usize;
    /// Infinity.
    const INFINITY: Self;
    /// Not a number.
    const NAN: Self;

    /// An integer below 2^24 in magnitude, exactly.
    fn of(integer: i32) -> Self;

    /// A number in [-1, 1), evenly spread, of random bits: exact.
    fn unit(bits: u64) -> Self;

    /// Neither infinite nor NaN.
    fn is_finite(self) -> bool;

    /// No number.
    fn is_nan(self) -> bool;

    /// The number's bits, little end first; the first [`Real::BYTES`] count.
    fn bytes(self) -> [u8; 8];

    /// The number with these bits.
    fn from_bytes(bytes: [u8; 8]) -> Self;
}

macro_rules! real {
    ($float:ident, $word:ty, $integer:ty, $bits:literal) => {
        impl Real for $float {
            const BYTES: usize = size_of::<$float>();
            const INFINITY: Self = $float::INFINITY;
            const NAN: Self = $float::NAN;

            fn of(integer: i32) -> Self {
                integer as $float
            }
            fn unit(bits: u64) -> Self {
                let half = 1 << ($bits - 1);
                let integer = (bits >> (64 - $bits)) as $integer - half;
                integer as $float * (1.0 / half as $float)
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }
            fn is_nan(self) -> bool {
                $float::is_nan(self)
            }
            fn bytes(self) -> [u8; 8] {
                u64::from(self.to_bits()).to_le_bytes()
            }
            fn from_bytes(bytes: [u8; 8]) -> Self {
                $float::from_bits(u64::from_le_bytes(bytes) as $word)
            }
        }
    };
}

real!(f32, u32, i32, 24);
real!(f64, u64, i64, 53);
