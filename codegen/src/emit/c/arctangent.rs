//! The angle of a direction in C: the Rust kernels' polynomial (`kernels/src/arctan.rs`), operation by operation.

use super::Precision;
use super::style::C;

/// The static function `direction`.
pub(super) fn direction(precision: Precision) -> String {
    let language = C { precision, device: false, math: false };
    let coefficients: &[&str] = match precision {
        Precision::F64 => &DOUBLE,
        Precision::F32 => &SINGLE,
    };
    let suffix = language.suffix();
    let (last, others) = coefficients.split_last().expect("some coefficients");
    let horner = others.iter().rev().fold(format!("({last}{suffix})"), |sum, coefficient| {
        format!("{sum} * z + ({coefficient}{suffix});\n    p = p")
    });
    let horner = horner.trim_end_matches(";\n    p = p");
    TEXT.replace("HORNER", horner).replace("REAL", language.real()).replace("@", suffix)
}

const DOUBLE: [&str; 11] = [
    "-0.333333333333332",
    "0.19999999999954068",
    "-0.14285714280247166",
    "0.11111110786067321",
    "-0.09090897834335046",
    "0.07692061598138061",
    "-0.06663119926607666",
    "0.05848005493912694",
    "-0.050398296950787305",
    "0.03807790975276162",
    "-0.017921819378720106",
];

const SINGLE: [&str; 5] = [
    "-0.33333316445350647",
    "0.19998489320278168",
    "-0.14243845641613007",
    "0.10595975071191788",
    "-0.060833822935819626",
];

const TEXT: &str = "
/* The angle of the direction (x, y), -pi to pi, without a branch; 0 where both are zero: at most 2 ulp off. */
static REAL direction(REAL y, REAL x)
{
    const REAL up = (y > 0.0@) ? y : -y;
    const REAL right = (x > 0.0@) ? x : -x;
    const REAL steep = up - right;
    const REAL low = (steep > 0.0@) ? right : up;
    const REAL high = (steep > 0.0@) ? up : right;
    const REAL turned = low - 0.41421356237309503@ * high;
    const REAL numerator = (turned > 0.0@) ? (low - high) : low;
    const REAL denominator = (turned > 0.0@) ? (low + high) : high;
    const REAL t = ((1e-37@ - denominator) > 0.0@) ? 0.0@ : (numerator * (1.0@ / denominator));
    const REAL z = t * t;
    REAL p = HORNER;
    p = t * z * p + t;
    p = (turned > 0.0@) ? (0.7853981633974483@ + p) : p;
    p = (steep > 0.0@) ? (1.5707963267948966@ - p) : p;
    p = ((-x) > 0.0@) ? (3.141592653589793@ - p) : p;
    return ((-y) > 0.0@) ? -p : p;
}
";
