//! Angles and lengths that are meant to be round: exact multiples of π, and decimals without the
//! last digits' noise.

use core::f64::consts::{FRAC_PI_2, PI};

use crate::number::Number;
use crate::robot::pi::{ROUNDED_DENOMINATORS, rounded_multiple};
use crate::robot::space::{Frame, Vector};
use crate::robot::{Angle, Value};

/// The largest denominator of an exact multiple.
const LARGEST: u32 = 12;

/// What a table's entries may be off by: sums of a few dozen rounded numbers, no measured digit.
const NOISE: f64 = 1e-12;

/// So near to a simple multiple of π no other angle is meant, rad.
const NEAR: f64 = 1e-9;

/// The multiple of π that a number with three decimals or more is a rounding of: π/2 of `1.5708`.
pub fn meant(x: f64) -> Option<f64> {
    let text = format!("{:?}", x.abs());
    let decimals = text.split_once('.').map_or(0, |(_, behind)| behind.len());
    if text.contains('e') || !(3..=20).contains(&decimals) {
        return None;
    }
    let exact = rounded_multiple(&text).map(|r| *r.numer() as f64 * PI / *r.denom() as f64);
    // Differences of roundings, such as the 1.570796326589793 of some descriptions.
    let near = || {
        let each = ROUNDED_DENOMINATORS.map(|n| (x * n as f64 / PI).round() * PI / n as f64);
        each.into_iter().find(|exact| *exact != 0.0 && (x - exact).abs() <= NEAR)
    };
    exact.map(|exact| exact.copysign(x)).or_else(near).filter(|_| x.abs() <= 4.0 * PI)
}

/// Sine and cosine; exactly 0, 1 and −1 at the multiples of π/2.
pub fn sin_cos(x: f64) -> (f64, f64) {
    let quarter = (x / FRAC_PI_2).round();
    if quarter.abs() < 100.0 && (x - quarter * FRAC_PI_2).abs() <= 1e-15 * x.abs() {
        return match (quarter as i64).rem_euclid(4) {
            0 => (0.0, 1.0),
            1 => (1.0, 0.0),
            2 => (0.0, -1.0),
            _ => (-1.0, 0.0),
        };
    }
    x.sin_cos()
}

/// `Rz(yaw) Ry(pitch) Rx(roll)`, as a URDF has its `rpy`.
pub fn roll_pitch_yaw([roll, pitch, yaw]: Vector) -> Frame {
    let ((sr, cr), (sp, cp), (sy, cy)) = (sin_cos(roll), sin_cos(pitch), sin_cos(yaw));
    let turn = |axes| Frame { axes, origin: [0.0; 3] };
    let x = turn([[1.0, 0.0, 0.0], [0.0, cr, sr], [0.0, -sr, cr]]);
    let y = turn([[cp, 0.0, -sp], [0.0, 1.0, 0.0], [sp, 0.0, cp]]);
    let z = turn([[cy, sy, 0.0], [-sy, cy, 0.0], [0.0, 0.0, 1.0]]);
    z.then(&y).then(&x)
}

impl Frame {
    /// Roll, pitch and yaw, rad, of this frame's axes, `Rz(yaw) Ry(pitch) Rx(roll)`: yaw first, and the
    /// others of what is then left, so that none is lost where pitch is a right angle.
    pub fn roll_pitch_yaw(&self) -> Vector {
        let [x, ..] = self.axes;
        let yaw = x[1].atan2(x[0]);
        let left = roll_pitch_yaw([0.0, 0.0, yaw]).inverse().then(self);
        let [x, y, z] = left.axes;
        [(-z[1]).atan2(y[1]), (-x[2]).atan2(x[0]), yaw]
    }
}

/// An angle of the table: the multiple of π that it is but for noise, else a decimal.
pub fn angle(x: f64) -> Angle {
    for n in (1..=LARGEST).map(f64::from) {
        let exact = (x * n / PI).round() * PI / n;
        if (x - exact).abs() <= NOISE {
            return Angle::from_radians(exact).unwrap_or(Angle::ZERO);
        }
    }
    Angle::from_radians(tidy(x)).unwrap_or(Angle::ZERO)
}

/// A length, a mass or an acceleration of the table.
pub fn value(x: f64) -> Value {
    Value::Number(Number::from_decimal(&format!("{:?}", tidy(x))).unwrap_or(Number::ZERO))
}

/// Without the noise of the last digits: `0.425` of `0.42500000000000004`.
pub fn tidy(x: f64) -> f64 {
    let round = (x * 1e12).round() / 1e12;
    // The sum at the end turns −0 into 0.
    if (x - round).abs() <= 2e-15 * x.abs().max(1.0) { round + 0.0 } else { x }
}

#[cfg(test)]
mod unit {
    use super::*;

    #[test]
    #[allow(clippy::approx_constant, reason = "roundings are what is tested")]
    fn roundings_are_recognised() {
        for (x, multiple) in [
            (1.5708, FRAC_PI_2),
            (-1.570796, -FRAC_PI_2),
            (1.57079632679, FRAC_PI_2),
            (3.1415, PI),
            (3.14159265359, PI),
            (0.785398, PI / 4.0),
            (-2.0944, -2.0 * PI / 3.0),
            (f64::from(FRAC_PI_2 as f32), FRAC_PI_2),
            (1.570796326589793, FRAC_PI_2),
        ] {
            assert_eq!(meant(x), Some(multiple), "{x}");
        }
        for x in [0.0, 1.57, 1.5, 1.572, 0.123456, 1e-9, 1e9, 3.0] {
            assert_eq!(meant(x), None, "{x}");
        }
    }

    #[test]
    fn right_angles_have_no_noise() {
        for (x, s, c) in [(FRAC_PI_2, 1.0, 0.0), (-PI, 0.0, -1.0), (3.0 * FRAC_PI_2, -1.0, 0.0)] {
            assert_eq!(sin_cos(x), (s, c));
        }
        assert_eq!(sin_cos(0.3), 0.3_f64.sin_cos());
        assert_eq!(angle(FRAC_PI_2 + 3e-16), Angle::from_radians(FRAC_PI_2).unwrap());
        assert_eq!(angle(1e-16), Angle::ZERO);
        assert_eq!(angle(0.3).radians(), Some(0.3));
        assert_eq!(tidy(0.425_000_000_000_000_04), 0.425);
        assert_eq!(tidy(0.123_456_789_012_345), 0.123_456_789_012_345);
    }
}
