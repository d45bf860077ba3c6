//! Wrenches from frame to frame.

use nalgebra::{Isometry3, Matrix6};

/// The matrix that takes a wrench of the frame `transform` (its axes, about its origin) to the frame
/// that this is seen from: `K = [R 0; [p]× R R]` (Bicchi & Melchiorri, eqs. 6 and 16). The product of
/// transforms is the product of their K (eq. 18); the transpose takes twists the other way, with the
/// same work.
pub fn wrench_matrix(transform: &Isometry3<f64>) -> Matrix6<f64> {
    let turn = *transform.rotation.to_rotation_matrix().matrix();
    let mut k = Matrix6::zeros();
    k.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn);
    k.fixed_view_mut::<3, 3>(3, 3).copy_from(&turn);
    let lever = transform.translation.vector.cross_matrix() * turn;
    k.fixed_view_mut::<3, 3>(3, 0).copy_from(&lever);
    k
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Vector3, Vector6};
    use proptest::prelude::*;

    fn transform() -> impl Strategy<Value = Isometry3<f64>> {
        let vector = || prop::array::uniform3(-1.5..1.5f64).prop_map(Vector3::from);
        (vector(), vector()).prop_map(|(at, turn)| Isometry3::new(at, turn))
    }

    proptest! {
        /// The force turns, the moment is about the origin that it is seen from.
        #[test]
        fn force_and_moment_are_carried(
            t in transform(), next in transform(), w in prop::array::uniform6(-50.0..50.0f64),
        ) {
            let (f, m) = (Vector3::new(w[0], w[1], w[2]), Vector3::new(w[3], w[4], w[5]));
            let (force, turned) = (t.rotation * f, t.rotation * m);
            let moment = turned + t.translation.vector.cross(&force);
            let found = wrench_matrix(&t) * Vector6::from(w);
            prop_assert!((found.fixed_rows::<3>(0) - force).amax() < 1e-12);
            prop_assert!((found.fixed_rows::<3>(3) - moment).amax() < 1e-12);
            let apart = wrench_matrix(&(t * next)) - wrench_matrix(&t) * wrench_matrix(&next);
            prop_assert!(apart.amax() < 1e-14);
        }
    }
}
