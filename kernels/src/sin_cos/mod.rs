//! Sine and cosine by an own polynomial: no branch on data, no table, no library.
//!
//! A number is brought into ±π/4 by the nearest multiple of π/2. Adding 1.5 · 2^m rounds that multiple
//! to an integer and leaves its last two bits, which say what the quadrant does to the pair, at the
//! end of the mantissa. Odd and even polynomial are both evaluated, and integer masks exchange them
//! and set their signs. The same text serves one number and lanes of numbers ([`Masked`]); every
//! operation rounds by itself, so all of them give the same bits (under the feature `fma` sums of products
//! are rounded once where the target can, and then other targets differ in the last bit).
//!
//! `tools/sin_cos.py` derives every constant, and the table that the tests compare with.
//!
//! Angles that are not finite, or so large that their own spacing is no angle any more
//! ([`double::LARGEST`], [`single::LARGEST`]), give NaN.

#[cfg(all(feature = "dispatch", target_arch = "x86_64", not(target_feature = "avx2")))]
pub(crate) mod dispatch;
pub(crate) mod double;
pub(crate) mod single;

use core::ops::{Add, BitAnd, BitOr, BitXor, Mul, Neg, Shl, Sub};

/// A number, or lanes of numbers, whose bits can be masked.
pub(crate) trait Masked:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// The bits of the number, or of each lane.
    type Word: Copy
        + BitAnd<Output = Self::Word>
        + BitOr<Output = Self::Word>
        + BitXor<Output = Self::Word>
        + Shl<u32, Output = Self::Word>;
    /// Bits of one number.
    const BITS: u32;

    /// A constant in every lane.
    fn of(x: f64) -> Self;

    /// `self·a + b`: rounded once under the feature `fma` where the target can.
    fn mul_add(self, a: Self, b: Self) -> Self;

    /// The bits.
    fn bits(self) -> Self::Word;

    /// The number with these bits.
    fn from_bits(word: Self::Word) -> Self;

    /// All bits set where the last bit of `word` is.
    fn spread_last(word: Self::Word) -> Self::Word;

    /// The sign bit alone.
    fn sign_bit() -> Self::Word;

    /// All bits set where `|self| > limit`.
    fn above(self, limit: f64) -> Self::Word;
}

/// Sine and cosine of an angle from those of the reduced angle; the last two bits of `shifted` are the
/// quadrant's.
#[inline(always)]
fn turn<F: Masked>(shifted: F, sine: F, cosine: F) -> (F, F) {
    let quadrant = shifted.bits();
    let odd = F::spread_last(quadrant);
    let exchanged = (sine.bits() ^ cosine.bits()) & odd;
    let second = F::BITS - 2;
    let sine_sign = (quadrant << second) & F::sign_bit();
    let cosine_sign = ((quadrant ^ (quadrant << 1)) << second) & F::sign_bit();
    (
        F::from_bits(sine.bits() ^ exchanged ^ sine_sign),
        F::from_bits(cosine.bits() ^ exchanged ^ cosine_sign),
    )
}

/// `x`, NaN where `|angle|` is above `limit`.
#[inline(always)]
fn nan_beyond<F: Masked>(x: F, angle: F, limit: f64) -> F {
    F::from_bits(x.bits() | angle.above(limit))
}

/// What a scalar and its lanes have in common.
macro_rules! masked_number {
    ($float:ty, $word:ty) => {
        impl Masked for $float {
            type Word = $word;
            const BITS: u32 = <$word>::BITS;

            #[inline(always)]
            fn of(x: f64) -> Self {
                x as $float
            }
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                crate::Scalar::mul_add(self, a, b)
            }
            #[inline(always)]
            fn bits(self) -> $word {
                self.to_bits()
            }
            #[inline(always)]
            fn from_bits(word: $word) -> Self {
                <$float>::from_bits(word)
            }
            #[inline(always)]
            fn spread_last(word: $word) -> $word {
                (word & 1).wrapping_neg()
            }
            #[inline(always)]
            fn sign_bit() -> $word {
                1 << (<$word>::BITS - 1)
            }
            #[inline(always)]
            fn above(self, limit: f64) -> $word {
                <$word>::from(self.abs() > limit as $float).wrapping_neg()
            }
        }
    };
}

masked_number!(f64, u64);
masked_number!(f32, u32);
