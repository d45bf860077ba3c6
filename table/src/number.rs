//! Exact numbers: decimals and unit conversions stay rational, so that a structural zero *is* zero.

use core::fmt;
use core::hash::{Hash, Hasher};

use num_rational::Ratio;
use num_traits::{CheckedAdd, CheckedMul, Signed, ToPrimitive, Zero};

/// A real constant: rational while that fits 128 bits, a rounded double otherwise.
///
/// Arithmetic with a rounded operand that lands within a few units of rounding error of an integer
/// is taken to *be* that integer: `cos²45° + sin²45°` is exactly 1, so no residue of rounding ever
/// survives as a literal.
#[derive(Clone, Copy, Debug)]
pub enum Number {
    /// An exact rational.
    Exact(Ratio<i128>),
    /// A finite double whose exact value is irrational or too long.
    Rounded(f64),
}

impl Default for Number {
    fn default() -> Self {
        Number::ZERO
    }
}

/// Relative rounding error that a folded constant may carry: a few operations' worth.
const SNAP: f64 = 16.0 * f64::EPSILON;

impl Number {
    /// Zero.
    pub const ZERO: Number = Number::Exact(Ratio::new_raw(0, 1));
    /// One.
    pub const ONE: Number = Number::Exact(Ratio::new_raw(1, 1));

    /// The integer `n`.
    pub const fn integer(n: i128) -> Self {
        Number::Exact(Ratio::new_raw(n, 1))
    }

    /// The fraction `n/d`, reduced. `d` must not be zero.
    pub fn ratio(n: i128, d: i128) -> Self {
        Number::Exact(Ratio::new(n, d))
    }

    /// A finite double that stands for an irrational value, right to a few units of its own rounding.
    pub fn rounded(x: f64) -> Self {
        debug_assert!(x.is_finite());
        snap(x, x.abs())
    }

    /// A component of a unit vector, right to a few units of the rounding of 1: below that it is 0.
    pub fn cosine(x: f64) -> Self {
        debug_assert!(x.is_finite());
        snap(x, 1.0)
    }

    /// Reads a decimal literal (`-1.25e-3`, `350`, `1_000`) exactly; `None` if it is not one, or
    /// is not finite as a double.
    pub fn from_decimal(text: &str) -> Option<Self> {
        let clean: String = text.chars().filter(|c| *c != '_').collect();
        let value: f64 = clean.parse().ok().filter(|v: &f64| v.is_finite())?;
        Some(exact_decimal(&clean).map_or(Number::Rounded(value), Number::Exact))
    }

    /// The nearest double.
    pub fn to_f64(self) -> f64 {
        match self {
            // Both parts below 2^53 make the quotient correctly rounded; larger ones cost at most 1 ulp.
            Number::Exact(r) => {
                r.numer().to_f64().unwrap_or(f64::NAN) / r.denom().to_f64().unwrap_or(f64::NAN)
            }
            Number::Rounded(x) => x,
        }
    }

    /// Numerator and denominator, where the value is a fraction that no decimal of a few digits is.
    pub fn fraction(self) -> Option<(i128, i128)> {
        let Number::Exact(r) = self else { return None };
        let (n, d) = (*r.numer(), *r.denom());
        let mut rest = d;
        for prime in [2, 5] {
            while rest % prime == 0 {
                rest /= prime;
            }
        }
        (rest != 1 && n.abs() < 1_000_000 && d < 1_000_000).then_some((n, d))
    }

    /// Whether the value is exactly zero.
    pub fn is_zero(self) -> bool {
        matches!(self, Number::Exact(r) if r.is_zero())
    }

    /// Whether the value is exactly one.
    pub fn is_one(self) -> bool {
        matches!(self, Number::Exact(r) if r == Ratio::new_raw(1, 1))
    }

    /// Whether the value is below zero.
    pub fn is_negative(self) -> bool {
        match self {
            Number::Exact(r) => r.is_negative(),
            Number::Rounded(x) => x < 0.0,
        }
    }

    /// The absolute value.
    pub fn abs(self) -> Self {
        if self.is_negative() { -self } else { self }
    }

    /// `1/self`, or `None` where that is not finite.
    pub fn recip(self) -> Option<Self> {
        match self {
            _ if self.is_zero() => None,
            Number::Exact(r) => Some(Number::Exact(r.recip())),
            Number::Rounded(x) => Some(1.0 / x).filter(|r| r.is_finite()).map(Number::rounded),
        }
    }

    /// The square root: exact for squares of rationals; `None` for a negative number.
    pub fn sqrt(self) -> Option<Self> {
        if self.is_negative() {
            return None;
        }
        if let Number::Exact(r) = self
            && let (Some(n), Some(d)) = (exact_root(*r.numer()), exact_root(*r.denom()))
        {
            return Some(Number::ratio(n, d));
        }
        Some(Number::rounded(libm::sqrt(self.to_f64())))
    }
}

fn exact_root(n: i128) -> Option<i128> {
    let guess = n.to_f64().map(libm::sqrt)? as i128;
    (guess.saturating_sub(1)..=guess + 1).find(|g| g.checked_mul(g) == Some(n))
}

fn exact_decimal(text: &str) -> Option<Ratio<i128>> {
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((m, e)) => (m, e.parse::<i32>().ok()?),
        None => (text, 0),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: i128 = format!("{whole}{fraction}").parse().ok()?;
    let power = exponent.checked_sub(i32::try_from(fraction.len()).ok()?)?;
    let scale = 10i128.checked_pow(power.unsigned_abs())?;
    Some(if power >= 0 {
        Ratio::from(digits.checked_mul(scale)?)
    } else {
        Ratio::new(digits, scale)
    })
}

fn snap(x: f64, scale: f64) -> Number {
    let nearest = libm::round(x);
    if (x - nearest).abs() <= SNAP * scale && nearest.abs() < 1e15 {
        Number::integer(nearest as i128)
    } else {
        Number::Rounded(x)
    }
}

impl core::ops::Neg for Number {
    type Output = Number;
    fn neg(self) -> Number {
        match self {
            Number::Exact(r) => Number::Exact(-r),
            Number::Rounded(x) => Number::Rounded(-x),
        }
    }
}

impl core::ops::Add for Number {
    type Output = Number;
    fn add(self, other: Number) -> Number {
        if let (Number::Exact(a), Number::Exact(b)) = (self, other)
            && let Some(sum) = a.checked_add(&b)
        {
            return Number::Exact(sum);
        }
        let (a, b) = (self.to_f64(), other.to_f64());
        snap(a + b, a.abs().max(b.abs()))
    }
}

impl core::ops::Mul for Number {
    type Output = Number;
    fn mul(self, other: Number) -> Number {
        if self.is_zero() || other.is_zero() {
            return Number::ZERO;
        }
        if let (Number::Exact(a), Number::Exact(b)) = (self, other)
            && let Some(product) = a.checked_mul(&b)
        {
            return Number::Exact(product);
        }
        let product = self.to_f64() * other.to_f64();
        snap(product, product.abs())
    }
}

impl PartialEq for Number {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Number::Exact(a), Number::Exact(b)) => a == b,
            (Number::Rounded(a), Number::Rounded(b)) => a.to_bits() == b.to_bits(),
            _ => false,
        }
    }
}

impl Eq for Number {}

impl Hash for Number {
    fn hash<H: Hasher>(&self, state: &mut H) {
        match self {
            Number::Exact(r) => (r.numer(), r.denom()).hash(state),
            Number::Rounded(x) => x.to_bits().hash(state),
        }
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.to_f64(), f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_exact() {
        let sum = Number::from_decimal("0.1").unwrap() + Number::from_decimal("0.2").unwrap();
        assert_eq!(sum, Number::from_decimal("0.3").unwrap());
        assert_eq!(Number::from_decimal("-1.25e-3").unwrap(), Number::ratio(-1, 800));
        assert_eq!(Number::from_decimal("69e9").unwrap().to_f64(), 69e9);
        assert!(Number::from_decimal("1e999").is_none());
        assert!(Number::from_decimal("nan").is_none());
        assert!(Number::from_decimal("").is_none());
    }

    #[test]
    fn rounding_residue_is_snapped() {
        let c = Number::ratio(1, 2).sqrt().unwrap();
        assert_eq!(c * c + c * c, Number::ONE);
        assert!((c + -c).is_zero());
    }

    #[test]
    fn the_reciprocal_of_a_large_constant_is_small_and_not_zero() {
        let large = Number::rounded(2.9e14_f64.sqrt()) * Number::rounded(1e16_f64.sqrt() * 1.1);
        for x in [large, Number::Rounded(1e15 / 3.0), Number::Rounded(1e300)] {
            let product = x.recip().unwrap().to_f64() * x.to_f64();
            assert!((product - 1.0).abs() < 1e-15, "{x}: {product}");
        }
        let tiny = Number::Rounded(1e-20 / 3.0).sqrt().unwrap().to_f64();
        assert!((tiny * tiny * 3e20 - 1.0).abs() < 1e-15);
        assert!(Number::cosine(libm::cos(core::f64::consts::FRAC_PI_2)).is_zero());
    }

    #[test]
    fn overflow_falls_back_to_doubles() {
        let big = Number::integer(i128::MAX / 2);
        assert!(matches!(big * big, Number::Rounded(x) if x > 1e75));
    }

    #[test]
    fn square_roots_of_squares_are_exact() {
        assert_eq!(Number::ratio(9, 16).sqrt(), Some(Number::ratio(3, 4)));
        assert_eq!(Number::integer(-1).sqrt(), None);
    }
}
