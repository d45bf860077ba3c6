//! How a displacement changes with its six numbers.

use nalgebra::{Matrix3, Matrix6, Vector3};
use stiffarm_gap::displacement::Displacement;

/// What a change of the six numbers makes of the frame: the matrix from `d[d; r]` to the twist
/// `dE E⁻¹`, at the origin of the undisplaced frame and in its axes.
pub fn rate(of: &Displacement) -> Matrix6<f64> {
    let turn = left_jacobian(&of.rotation);
    let mut rate = Matrix6::identity();
    rate.fixed_view_mut::<3, 3>(0, 3).copy_from(&(of.translation.cross_matrix() * turn));
    rate.fixed_view_mut::<3, 3>(3, 3).copy_from(&turn);
    rate
}

/// Left Jacobian of SO(3): a change `dr` of the rotation vector `r` turns the body by `J dr` in
/// the fixed axes. `J = 1 + (1 − cos φ)/φ² [r]× + (φ − sin φ)/φ³ [r]×²` with φ = |r|.
pub(crate) fn left_jacobian(r: &Vector3<f64>) -> Matrix3<f64> {
    let angle = r.norm();
    let square = angle * angle;
    let first = if angle == 0.0 { 0.5 } else { versine(angle) / square };
    let second = if angle == 0.0 { 1.0 / 6.0 } else { lag(angle) / (square * angle) };
    let cross = r.cross_matrix();
    Matrix3::identity() + cross * first + cross * cross * second
}

/// `1 − cos φ`, which does not cancel as `2 sin²(φ/2)`.
pub(crate) fn versine(angle: f64) -> f64 {
    2.0 * (angle / 2.0).sin().powi(2)
}

/// `φ − sin φ`, by its series where it would cancel: of the terms left out below 0.5 the first is
/// φ¹⁷/17!, less than 1e-18 of the whole.
pub(crate) fn lag(angle: f64) -> f64 {
    if angle.abs() >= 0.5 {
        return angle - angle.sin();
    }
    let square = angle * angle;
    let mut sum = 0.0;
    for k in [14.0, 12.0, 10.0, 8.0, 6.0, 4.0] {
        sum = square / (k * (k + 1.0)) * (1.0 - sum);
    }
    angle * square / 6.0 * (1.0 - sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector6;
    use proptest::prelude::*;

    fn displacement(size: f64) -> impl Strategy<Value = Displacement> {
        prop::array::uniform6(-size..size)
            .prop_map(|v| Displacement::new(&Vector6::from_column_slice(&v)))
    }

    #[test]
    fn lag_and_versine_keep_all_digits() {
        for angle in [1e-8_f64, 1e-3, 0.1, 0.3, 0.4999, -0.2] {
            // The series written out, from the small end.
            let mut term = angle.powi(3) / 6.0;
            let mut terms = vec![term];
            for k in 2..20 {
                let k = f64::from(2 * k);
                term *= -angle * angle / (k * (k + 1.0));
                terms.push(term);
            }
            let series: f64 = terms.iter().rev().sum();
            assert!((lag(angle) / series - 1.0).abs() < 1e-15, "{angle}");
        }
        assert!((lag(0.4999999) - lag(0.5000001) + 2e-7 * versine(0.5)).abs() < 1e-16);
        assert!((versine(1e-9) / 5e-19 - 1.0).abs() < 1e-15);
    }

    proptest! {
        #[test]
        fn the_rate_is_the_derivative(a in displacement(1.0), change in displacement(1.0)) {
            let step = 1e-5;
            let at = |h: f64| Displacement::new(&(a.vector() + change.vector() * h)).transform();
            let change_of_frame = at(step).to_homogeneous() - at(-step).to_homogeneous();
            let twist = change_of_frame * at(0.0).inverse().to_homogeneous() / (2.0 * step);
            let expected = rate(&a) * change.vector();
            prop_assert!((twist[(2, 1)] - expected[3]).abs() < 1e-8);
            prop_assert!((twist[(0, 2)] - expected[4]).abs() < 1e-8);
            prop_assert!((twist[(1, 0)] - expected[5]).abs() < 1e-8);
            let shift = twist.fixed_view::<3, 1>(0, 3);
            prop_assert!((shift - expected.fixed_rows::<3>(0)).amax() < 1e-8);
        }
    }
}
