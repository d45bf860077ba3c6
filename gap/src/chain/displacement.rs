//! A small displacement of one frame, and how it becomes a transform.

use nalgebra::{Isometry3, Matrix3, Matrix6, Translation3, UnitQuaternion, Vector3, Vector6};

use super::transport::stack;

/// `[dx dy dz drx dry drz]` in the axes of the undisplaced frame, m and rad: the frame's origin
/// moves by the translation, and the frame turns about its moved origin by the rotation vector
/// (axis times angle).
///
/// The transform is exact, `E = [exp([r]×) d; 0 1]`: Bicchi & Melchiorri's "rotation about an axis
/// parallel to Δθ of an angle given by the module of Δθ" (section 4). Jweeg & Al-Khafaji's reading
/// of the same six numbers as roll, pitch and yaw is [`rpy::transform`](super::rpy::transform); the
/// two agree in the plane and differ in space at the second order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Displacement {
    /// Of the origin, m.
    pub translation: Vector3<f64>,
    /// Rotation vector, rad.
    pub rotation: Vector3<f64>,
}

impl Displacement {
    /// No displacement.
    pub const ZERO: Self = {
        let zero = Vector3::new(0.0, 0.0, 0.0);
        Self { translation: zero, rotation: zero }
    };

    /// The displacement `[dx dy dz drx dry drz]`.
    pub fn new(vector: &Vector6<f64>) -> Self {
        let (translation, rotation) = (vector.fixed_rows::<3>(0), vector.fixed_rows::<3>(3));
        Self { translation: translation.into_owned(), rotation: rotation.into_owned() }
    }

    /// The displacement that a transform is; of two opposite rotation vectors the shorter.
    pub fn of(transform: &Isometry3<f64>) -> Self {
        Self {
            translation: transform.translation.vector,
            rotation: transform.rotation.scaled_axis(),
        }
    }

    /// `[dx dy dz drx dry drz]`.
    pub fn vector(&self) -> Vector6<f64> {
        stack(&self.translation, &self.rotation)
    }

    /// The exact transform E.
    pub fn transform(&self) -> Isometry3<f64> {
        Isometry3::from_parts(
            Translation3::from(self.translation),
            UnitQuaternion::from_scaled_axis(self.rotation),
        )
    }

    /// The displacement that undoes this one: `E⁻¹`.
    #[must_use]
    pub fn inverse(&self) -> Self {
        Self::of(&self.transform().inverse())
    }

    /// This displacement and then `next`, expressed in the frame that this one leads to: `E · E'`.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self::of(&(self.transform() * next.transform()))
    }

    /// What a change of the six numbers makes of the frame: the matrix from `d[d; r]` to the twist
    /// `dE E⁻¹`, at the origin of the undisplaced frame and in its axes.
    pub fn rate(&self) -> Matrix6<f64> {
        let turn = left_jacobian(&self.rotation);
        let mut rate = Matrix6::identity();
        rate.fixed_view_mut::<3, 3>(0, 3).copy_from(&(self.translation.cross_matrix() * turn));
        rate.fixed_view_mut::<3, 3>(3, 3).copy_from(&turn);
        rate
    }
}

impl Default for Displacement {
    fn default() -> Self {
        Self::ZERO
    }
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
        fn inverse_and_composition_are_consistent(
            a in displacement(1.0), b in displacement(1.0), c in displacement(0.9),
        ) {
            let nothing = a.then(&a.inverse()).vector();
            prop_assert!(nothing.amax() < 1e-14);
            let (left, right) = (a.then(&b).then(&c), a.then(&b.then(&c)));
            let difference = left.transform().to_homogeneous() - right.transform().to_homogeneous();
            prop_assert!(difference.amax() < 1e-14);
            let back = Displacement::of(&a.transform());
            prop_assert!((back.vector() - a.vector()).amax() < 1e-14);
        }

        #[test]
        fn the_rate_is_the_derivative(a in displacement(1.0), change in displacement(1.0)) {
            let step = 1e-5;
            let at = |h: f64| Displacement::new(&(a.vector() + change.vector() * h)).transform();
            let change_of_frame = at(step).to_homogeneous() - at(-step).to_homogeneous();
            let twist = change_of_frame * at(0.0).inverse().to_homogeneous() / (2.0 * step);
            let expected = a.rate() * change.vector();
            prop_assert!((twist[(2, 1)] - expected[3]).abs() < 1e-8);
            prop_assert!((twist[(0, 2)] - expected[4]).abs() < 1e-8);
            prop_assert!((twist[(1, 0)] - expected[5]).abs() < 1e-8);
            let slide = twist.fixed_view::<3, 1>(0, 3);
            prop_assert!((slide - expected.fixed_rows::<3>(0)).amax() < 1e-8);
        }
    }
}
