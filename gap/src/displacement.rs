//! A small displacement of one frame, and how it becomes a transform.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3, Vector6};

/// `[dx dy dz drx dry drz]` in the axes of the undisplaced frame, m and rad: the frame's origin
/// moves by the translation, and the frame turns about its moved origin by the rotation vector
/// (axis times angle).
///
/// The transform is exact, `E = [exp([r]×) d; 0 1]`: Bicchi & Melchiorri's "rotation about an axis
/// parallel to Δθ of an angle given by the module of Δθ" (section 4).
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
        let (d, r) = (self.translation, self.rotation);
        Vector6::new(d.x, d.y, d.z, r.x, r.y, r.z)
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
}

impl Default for Displacement {
    fn default() -> Self {
        Self::ZERO
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn displacement(size: f64) -> impl Strategy<Value = Displacement> {
        prop::array::uniform6(-size..size)
            .prop_map(|v| Displacement::new(&Vector6::from_column_slice(&v)))
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
    }
}
