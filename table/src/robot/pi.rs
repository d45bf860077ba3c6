//! Multiples of π: which doubles are one, and which decimals look like a rounded one.

use core::f64::consts::PI;

use num_rational::Ratio;

use super::decimal;
use super::model::Angle;
use crate::number::Number;

/// The largest denominator of π that a double is compared with.
const LARGEST_DENOMINATOR: i64 = 12;
/// Denominators at which rounded decimals are recognised.
pub(crate) const ROUNDED_DENOMINATORS: [i64; 5] = [1, 2, 3, 4, 6];
/// Beyond this many radians no double is taken for a multiple of π: their spacing grows.
const LARGEST_ANGLE: f64 = 100.0;
/// Bounds of an exact multiple's parts: a millionth of a degree, and sums that still fit 64 bits.
const LARGEST_PARTS: i128 = 180_000_000;

/// The multiple kπ/n (n ≤ 12) that a double stands for: the one within two units in its last place,
/// since `k*PI/n` in double arithmetic may round twice.
pub(crate) fn exact_multiple(x: f64) -> Option<Ratio<i64>> {
    if x == 0.0 {
        return Some(Ratio::new_raw(0, 1));
    }
    if x.is_nan() || x.abs() > LARGEST_ANGLE {
        return None;
    }
    let tolerance = 2.0 * ulp(x.abs());
    (1..=LARGEST_DENOMINATOR).find_map(|n| {
        let k = libm::round(x * n as f64 / PI);
        let near = k != 0.0 && (x - k * PI / n as f64).abs() <= tolerance;
        near.then(|| Ratio::new(k as i64, n))
    })
}

fn ulp(x: f64) -> f64 {
    f64::from_bits(x.to_bits() + 1) - x
}

/// The simple multiple of π that an unsigned decimal literal is a rounding of: rounding or cutting
/// it to the decimals written gives the very digits, or it is the single-precision value.
pub(crate) fn rounded_multiple(literal: &str) -> Option<Ratio<i64>> {
    let x: f64 = literal.replace('_', "").parse().ok()?;
    let decimals = decimals(literal)?;
    if decimals < 3 || x.abs() > 4.0 * PI {
        return None;
    }
    let step = libm::pow(10.0, -f64::from(decimals));
    ROUNDED_DENOMINATORS.into_iter().find_map(|n| {
        let k = libm::round(x * n as f64 / PI);
        let exact = k * PI / n as f64;
        let rounded = (x - exact).abs() <= 0.5 * step * (1.0 + 1e-9);
        let cut = decimals >= 4 && (0.0..step).contains(&(exact - x));
        let single = x == f64::from(exact as f32);
        (k != 0.0 && (rounded || cut || single)).then(|| Ratio::new(k as i64, n))
    })
}

/// Number of decimals of a literal: `1.5708` and `1570.8e-3` have four.
fn decimals(literal: &str) -> Option<i32> {
    let clean = literal.replace('_', "");
    let (mantissa, exponent) = match clean.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
        None => (clean.as_str(), 0),
    };
    let fraction = mantissa.split_once('.').map_or(0, |(_, fraction)| fraction.len());
    i32::try_from(fraction).ok()?.checked_sub(exponent)
}

/// How to write a literal so that it is no longer taken for a rounded multiple of π.
pub(crate) fn spelled_out(literal: &str) -> Option<String> {
    if !literal.contains('.') || literal.contains(['e', 'E']) {
        return None;
    }
    (1..=6)
        .map(|zeros| format!("{literal}{}", "0".repeat(zeros)))
        .find(|longer| rounded_multiple(longer).is_none())
}

/// `r·π` as an exact angle where its parts are small enough to be added safely, else in radians.
pub(crate) fn multiple(r: Ratio<i128>) -> Angle {
    let small = r.denom().abs() <= LARGEST_PARTS && r.numer().abs() <= 64 * LARGEST_PARTS;
    match (i64::try_from(*r.numer()), i64::try_from(*r.denom())) {
        (Ok(numerator), Ok(denominator)) if small => Angle::Pi(Ratio::new(numerator, denominator)),
        _ => Angle::Radians(Number::Exact(r) * Number::Rounded(PI)),
    }
}

impl Angle {
    /// The angle of a double in radians: the exact multiple of π that it is nearest to (kπ/n with
    /// n ≤ 12), else the double itself. `None` if it is not finite.
    pub fn from_radians(x: f64) -> Option<Angle> {
        match exact_multiple(x) {
            Some(r) => Some(Angle::Pi(r)),
            None => decimal::of_double(x).map(Angle::Radians),
        }
    }
}

/// `r·π` as a robot file or a table writes it: `pi/2`, `-3*pi/4`, `0`.
pub fn spell(r: Ratio<i64>) -> String {
    let sign = if *r.numer() < 0 { "-" } else { "" };
    let factor = match r.numer().unsigned_abs() {
        0 => return "0".to_owned(),
        1 => String::new(),
        n => format!("{n}*"),
    };
    match r.denom() {
        1 => format!("{sign}{factor}pi"),
        d => format!("{sign}{factor}pi/{d}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_doubles_are_multiples() {
        for n in 1..=12_i64 {
            for k in (-30..=30_i64).filter(|k| *k != 0) {
                let expected = Some(Ratio::new(k, n));
                assert_eq!(exact_multiple(k as f64 * PI / n as f64), expected);
                assert_eq!(exact_multiple(k as f64 * (PI / n as f64)), expected);
                assert_eq!(exact_multiple((180.0 / n as f64 * k as f64).to_radians()), expected);
            }
        }
        assert_eq!(exact_multiple(-0.0), Some(Ratio::new(0, 1)));
    }

    #[test]
    fn other_doubles_are_not() {
        let near = core::f64::consts::FRAC_PI_2 + 4e-10;
        for x in [0.5, 1.2, near, -near, 1e-300, 1e300, 3.0, f64::NAN, f64::INFINITY] {
            assert_eq!(exact_multiple(x), None, "{x}");
        }
        assert_eq!(Angle::from_radians(f64::NAN), None);
        assert_eq!(Angle::from_radians(0.5), Some(Angle::Radians(Number::ratio(1, 2))));
    }

    #[test]
    fn rounded_multiples_are_recognised() {
        let cases = [
            ("1.5708", 1, 2),
            ("1.570796327", 1, 2),
            ("1.5707963", 1, 2),
            ("1.57079632", 1, 2),
            ("1.571", 1, 2),
            ("3.14159", 1, 1),
            ("3.1415", 1, 1),
            ("0.7854", 1, 4),
            ("1.0472", 1, 3),
            ("2.0944", 2, 3),
            ("0.5236", 1, 6),
            ("1570.8e-3", 1, 2),
            ("1.57079637050628662109375", 1, 2),
        ];
        for (literal, k, n) in cases {
            assert_eq!(rounded_multiple(literal), Some(Ratio::new(k, n)), "{literal}");
        }
    }

    #[test]
    fn honest_angles_are_not_accused() {
        for literal in ["0.5", "1.2", "1.57", "3.14", "0.61", "1.5710", "2", "90", "0.0", "0.0001"]
        {
            assert_eq!(rounded_multiple(literal), None, "{literal}");
        }
        assert_eq!(spelled_out("1.571").unwrap(), "1.5710");
        assert_eq!(spelled_out("1571e-3"), None);
    }

    #[test]
    fn multiples_are_spelled_as_they_are_read() {
        let spelled = |n, d| spell(Ratio::new(n, d));
        assert_eq!(spelled(1, 2), "pi/2");
        assert_eq!(spelled(-3, 4), "-3*pi/4");
        assert_eq!(spelled(2, 1), "2*pi");
        assert_eq!(spelled(-1, 1), "-pi");
        assert_eq!(spelled(0, 1), "0");
    }

    #[test]
    fn unwieldy_multiples_become_radians() {
        assert_eq!(multiple(Ratio::new(373, 1800)), Angle::Pi(Ratio::new(373, 1800)));
        let fine = multiple(Ratio::new(1, 1_000_000_007));
        assert!(matches!(fine, Angle::Radians(Number::Rounded(x)) if (x - PI / 1e9).abs() < 1e-16));
    }
}
