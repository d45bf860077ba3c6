//! Decimals to numbers and back, so that a robot that is written reads back as the same doubles.

use crate::number::Number;

/// Reads a decimal literal; exactly, unless it has so many digits that the fraction would not be
/// evaluated to the literal's own double. Zero is exact however it is written. `None` if no double
/// holds it.
pub(crate) fn read(text: &str) -> Option<Number> {
    let number = Number::from_decimal(text)?;
    let double: f64 = text.replace('_', "").parse().ok()?;
    if double == 0.0 {
        Some(Number::ZERO)
    } else if number.to_f64() == double {
        Some(number)
    } else {
        Some(Number::Rounded(double))
    }
}

/// A finite double as the decimal that prints it; `None` if it is not finite.
pub(crate) fn of_double(x: f64) -> Option<Number> {
    read(&format!("{x:?}"))
}

/// The shortest decimal that reads back as the same double.
pub(crate) fn write(n: Number) -> String {
    format!("{:?}", n.to_f64())
}

/// `1/n`; `None` where no double holds it.
pub(crate) fn recip(n: Number) -> Option<Number> {
    (1.0 / n.to_f64()).is_finite().then(|| n.recip()).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_decimals_are_exact() {
        assert_eq!(read("0.35"), Some(Number::ratio(35, 100)));
        assert_eq!(read("1_000e-3"), Some(Number::ONE));
        assert_eq!(read("0e999"), Some(Number::ZERO));
        assert_eq!(read("1e-999"), Some(Number::ZERO));
        assert_eq!(read("1e999"), None);
        assert_eq!(of_double(f64::NAN), None);
    }

    #[test]
    fn reciprocals_are_finite() {
        assert_eq!(recip(Number::integer(4)), Some(Number::ratio(1, 4)));
        assert_eq!(recip(Number::ZERO), None);
        assert_eq!(recip(Number::Rounded(1e-310)), None);
    }

    #[test]
    fn every_double_survives() {
        for x in [0.005_969_026_041_820_606_5, 2.7e-5, 1e300, -0.1, core::f64::consts::PI, 1e-320] {
            let number = of_double(x).unwrap();
            assert_eq!(number.to_f64(), x);
            assert_eq!(read(&write(number)), Some(number));
        }
    }
}
