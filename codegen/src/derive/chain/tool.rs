//! The constant rotations of tool and base.

use crate::number::Number;
use crate::robot::{Angle, Frame};

/// A frame's rotation matrix, columns, from its rotation vector (Rodrigues).
pub fn frame_rotation(frame: &Frame) -> [[Number; 3]; 3] {
    let vector = rotation_vector(frame);
    let angle = norm(vector);
    series(vector, ratio(angle, 1), ratio(angle, 2))
}

/// Rotation of the tool per unit of each entry of its rotation vector, columns: the left Jacobian of SO(3)
/// at the nominal vector.
pub fn left_jacobian(tool: &Frame) -> [[Number; 3]; 3] {
    let vector = rotation_vector(tool);
    let angle = norm(vector);
    series(vector, ratio(angle, 2), ratio(angle, 3))
}

/// `Σ (−φ²)^k / (2k + m)!`: sin φ/φ for m = 1, (1 − cos φ)/φ² for 2, (φ − sin φ)/φ³ for 3.
///
/// The quotients lose the digits that φ² has behind 1, all of them below 1e-8: up to one radian the
/// series is summed, whose terms fall to rounding within ten.
fn ratio(angle: f64, m: u32) -> f64 {
    let square = angle * angle;
    match m {
        _ if angle < 1.0 => {
            let fall = |k: u32| f64::from((2 * k + m - 1) * (2 * k + m));
            let first = 1.0 / (1..=m).map(f64::from).product::<f64>();
            first * (1..10).rev().fold(1.0, |sum, k| 1.0 - square / fall(k) * sum)
        }
        1 => libm::sin(angle) / angle,
        2 => (1.0 - libm::cos(angle)) / square,
        _ => (angle - libm::sin(angle)) / (square * angle),
    }
}

fn norm(v: [f64; 3]) -> f64 {
    libm::sqrt(v.iter().map(|c| c * c).sum())
}

fn rotation_vector(frame: &Frame) -> [f64; 3] {
    // The readers let no symbol stand in a frame's rotation.
    frame.rotation.each_ref().map(Angle::or_zero)
}

/// Columns of `I + first [v]× + second [v]×²`.
fn series(v: [f64; 3], first: f64, second: f64) -> [[Number; 3]; 3] {
    let square: f64 = v.iter().map(|c| c * c).sum();
    let [x, y, z] = v;
    let cross = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]];
    core::array::from_fn(|column| {
        core::array::from_fn(|row| {
            let identity = if row == column { 1.0 } else { 0.0 };
            let twice = v[row] * v[column] - square * identity;
            Number::cosine(identity + first * cross[column][row] + second * twice)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On both sides of the series' limit: from (1 − cos φ) = 2 sin²(φ/2), which does not cancel, and for
    /// the third from the first terms, each next one being below φ²/20 of the last.
    #[test]
    fn the_coefficients_of_a_rotation_keep_their_digits() {
        for angle in [1e-9, 1e-7, 1e-4, 0.01, 0.3, 0.999, 1.001, 2.0, 3.1] {
            let half = libm::sin(angle / 2.0) / (angle / 2.0);
            let expected = [libm::sin(angle) / angle, half * half / 2.0];
            for (m, expected) in [1, 2].into_iter().zip(expected) {
                let error = ratio(angle, m) / expected - 1.0;
                assert!(error.abs() < 1e-15, "{angle} {m}: {error:e}");
            }
            let third = ratio(angle, 3);
            if angle < 0.05 {
                let terms = 1.0 - angle * angle / 20.0 * (1.0 - angle * angle / 42.0);
                // Next term: φ⁶/60,480 relative to the first.
                assert!((third * 6.0 / terms - 1.0).abs() < 4e-13, "{angle}: {third}");
            } else {
                let expected = (angle - libm::sin(angle)) / angle.powi(3);
                // φ − sin φ has lost 6/φ² units of rounding.
                assert!((third / expected - 1.0).abs() < 1e-15 * (1.0 + 6.0 / angle.powi(2)));
            }
        }
        assert_eq!((ratio(0.0, 1), ratio(0.0, 2), ratio(0.0, 3)), (1.0, 0.5, 1.0 / 6.0));
    }
}
