//! Angles from sines and cosines by an own polynomial: no branch on data, no table, no library.
//!
//! The smaller of |y| and |x| over the larger is brought below tan(π/8) by one rotation of π/4, so that there is one
//! quotient. Every operation rounds by itself: numbers, lanes of them and the same text in C give the same bits.
//! `tools/arctan.py` derives the coefficients.

use crate::Scalar;

/// Minimax of `(arctan t - t)/t³` in t² for |t| ≤ tan(π/8), weighted for the error relative to t: 2.3e-18.
pub(crate) const DOUBLE: [f64; 11] = [
    -0.333333333333332,
    0.19999999999954068,
    -0.14285714280247166,
    0.11111110786067321,
    -0.09090897834335046,
    0.07692061598138061,
    -0.06663119926607666,
    0.05848005493912694,
    -0.050398296950787305,
    0.03807790975276162,
    -0.017921819378720106,
];

/// The same in single precision: 2.3e-9.
pub(crate) const SINGLE: [f64; 5] = [
    -0.33333316445350647,
    0.19998489320278168,
    -0.14243845641613007,
    0.10595975071191788,
    -0.060833822935819626,
];

/// tan(π/8).
const EIGHTH: f64 = 0.41421356237309503;

/// Below it both coordinates count as zero: its reciprocal is finite in single precision too.
const SMALLEST: f64 = 1e-37;

/// The angle of the direction (x, y), −π to π; 0 where both are zero. At most 2 ulp off.
#[inline(always)]
pub(crate) fn atan2<S: Scalar, const K: usize>(y: S, x: S, coefficients: [f64; K]) -> S {
    let lit = S::lit;
    let (up, right) = (y.select(y, -y), x.select(x, -x));
    let steep = up - right;
    let (low, high) = (steep.select(right, up), steep.select(up, right));
    let turned = low - lit(EIGHTH) * high;
    let numerator = turned.select(low - high, low);
    let denominator = turned.select(low + high, high);
    let t = (lit(SMALLEST) - denominator).select(lit(0.0), numerator * denominator.recip());
    let z = t * t;
    let mut polynomial = lit(coefficients[K - 1]);
    for coefficient in coefficients.iter().rev().skip(1) {
        polynomial = polynomial.mul_add(z, lit(*coefficient));
    }
    let first = (t * z).mul_add(polynomial, t);
    let first = turned.select(lit(core::f64::consts::FRAC_PI_4) + first, first);
    let first = steep.select(lit(core::f64::consts::FRAC_PI_2) - first, first);
    let half = (-x).select(lit(core::f64::consts::PI) - first, first);
    (-y).select(-half, half)
}

#[cfg(test)]
mod tests {
    use crate::Scalar;

    /// Directions of all sides, near the axes and the diagonals among them, of unit length.
    fn directions() -> impl Iterator<Item = (f64, f64)> {
        let turns = (-40_000..40_000).map(|k| f64::from(k) * 7.853_98e-5);
        let near = (-8..=8).flat_map(|k| {
            let corner = f64::from(k) * core::f64::consts::FRAC_PI_8;
            [-1e-7, -1e-12, 0.0, 1e-16, 1e-9].map(|beside| corner + beside)
        });
        turns.chain(near).map(|angle| (libm::sin(angle), libm::cos(angle)))
    }

    /// libm's is right to an ulp. An ulp of the angle is at most `2^-52 · |angle|`.
    #[test]
    fn doubles_are_two_ulp_off_at_most() {
        for (y, x) in directions() {
            let (found, expected) = (Scalar::atan2(y, x), libm::atan2(y, x));
            assert!((found - expected).abs() <= 3.0 * f64::EPSILON * expected.abs(), "{y} {x}");
        }
    }

    #[test]
    fn singles_are_two_ulp_off_at_most() {
        for (y, x) in directions() {
            let (y, x) = (y as f32, x as f32);
            let expected = libm::atan2(f64::from(y), f64::from(x));
            let error = (f64::from(Scalar::atan2(y, x)) - expected).abs();
            assert!(error <= 3.0 * f64::from(f32::EPSILON) * expected.abs(), "{y} {x}: {error:e}");
        }
    }

    #[test]
    fn no_direction_is_no_turn() {
        assert_eq!((Scalar::atan2(0.0_f64, 0.0), Scalar::atan2(0.0_f32, -0.0)), (0.0, 0.0));
        let nan = |y: f64, x: f64| Scalar::atan2(y, x).is_nan();
        assert!(nan(f64::NAN, 1.0) && nan(1.0, f64::NAN));
    }
}
