//! Wrenches down the chain and twists up it, from frame to frame.

use nalgebra::{Isometry3, Matrix6, Vector3, Vector6};

/// Three translations (or forces) over three rotations (or moments).
pub(crate) fn stack(upper: &Vector3<f64>, lower: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(upper.x, upper.y, upper.z, lower.x, lower.y, lower.z)
}

/// Translations of a twist, force of a wrench.
pub(crate) fn upper(v: &Vector6<f64>) -> Vector3<f64> {
    v.fixed_rows::<3>(0).into_owned()
}

/// Rotations of a twist, moment of a wrench.
pub(crate) fn lower(v: &Vector6<f64>) -> Vector3<f64> {
    v.fixed_rows::<3>(3).into_owned()
}

/// The product of transforms along a chain.
pub(crate) fn along(transforms: impl IntoIterator<Item = Isometry3<f64>>) -> Isometry3<f64> {
    transforms.into_iter().fold(Isometry3::identity(), |frame, transform| frame * transform)
}

/// The wrench `w` of the frame `transform` in the frame that this is seen from: `f' = R f`, `m' =
/// R m + p × R f` (Bicchi & Melchiorri, eq. 6).
pub fn wrench_in(transform: &Isometry3<f64>, w: &Vector6<f64>) -> Vector6<f64> {
    let force = transform.rotation * upper(w);
    let moment = transform.rotation * lower(w) + transform.translation.vector.cross(&force);
    stack(&force, &moment)
}

/// The matrix of [`wrench_in`]: `K = [R 0; [p]× R R]` (Bicchi & Melchiorri, eqs. 6 and 16). The
/// product of transforms is the product of their K (eq. 18).
pub fn wrench_matrix(transform: &Isometry3<f64>) -> Matrix6<f64> {
    let turn = *transform.rotation.to_rotation_matrix().matrix();
    let mut k = Matrix6::zeros();
    k.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn);
    k.fixed_view_mut::<3, 3>(3, 3).copy_from(&turn);
    let lever = transform.translation.vector.cross_matrix() * turn;
    k.fixed_view_mut::<3, 3>(3, 0).copy_from(&lever);
    k
}

/// The matrix that takes a twist of the frame `transform` (its axes, the velocity of its origin)
/// to the frame that this is seen from: `[R [p]× R; 0 R]`. Its transpose takes wrenches the other
/// way: the virtual work is the same in every frame.
pub fn twist_matrix(transform: &Isometry3<f64>) -> Matrix6<f64> {
    let turn = *transform.rotation.to_rotation_matrix().matrix();
    let mut adjoint = Matrix6::zeros();
    adjoint.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn);
    adjoint.fixed_view_mut::<3, 3>(3, 3).copy_from(&turn);
    let lever = transform.translation.vector.cross_matrix() * turn;
    adjoint.fixed_view_mut::<3, 3>(0, 3).copy_from(&lever);
    adjoint
}

/// How the wrench `u`, carried along by a body, changes with a twist of that body, both in one
/// frame: `d(K w) = B(u) ξ` for `u = K w` and `dT T⁻¹ = ξ`: `df = ω × f`, `dm = ω × m + v × f`.
pub fn turning(u: &Vector6<f64>) -> Matrix6<f64> {
    let (force, moment) = (upper(u).cross_matrix(), lower(u).cross_matrix());
    let mut turning = Matrix6::zeros();
    turning.fixed_view_mut::<3, 3>(0, 3).copy_from(&-force);
    turning.fixed_view_mut::<3, 3>(3, 0).copy_from(&-force);
    turning.fixed_view_mut::<3, 3>(3, 3).copy_from(&-moment);
    turning
}

/// The wrench in each frame along a chain of transforms, from the base to the tip: entry 0 in the
/// frame that the first transform is seen from, entry i in the frame behind transform i, the last
/// one `tip` itself: `w_{i−1} = K_i w_i` (Bicchi & Melchiorri, eq. 17).
pub fn wrenches(transforms: &[Isometry3<f64>], tip: &Vector6<f64>) -> Vec<Vector6<f64>> {
    let mut down = vec![*tip];
    let mut wrench = *tip;
    for transform in transforms.iter().rev() {
        wrench = wrench_in(transform, &wrench);
        down.push(wrench);
    }
    down.reverse();
    down
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chain::Displacement;
    use proptest::prelude::*;

    fn six(size: f64) -> impl Strategy<Value = Vector6<f64>> {
        prop::array::uniform6(-size..size).prop_map(|v| Vector6::from_column_slice(&v))
    }

    proptest! {
        #[test]
        fn work_is_the_same_in_both_frames(t in six(1.5), twist in six(1.0), w in six(50.0)) {
            let transform = Displacement::new(&t).transform();
            let there = wrench_in(&transform, &w).dot(&(twist_matrix(&transform) * twist));
            prop_assert!((there - w.dot(&twist)).abs() < 1e-11);
            let apart = wrench_matrix(&transform) * w - wrench_in(&transform, &w);
            prop_assert!(apart.amax() < 1e-12);
        }

        #[test]
        fn the_tip_wrench_reaches_the_base_in_equilibrium(
            steps in prop::collection::vec(six(1.0), 1..6), w in six(50.0),
        ) {
            let chain: Vec<_> = steps.iter().map(|s| Displacement::new(s).transform()).collect();
            let down = wrenches(&chain, &w);
            prop_assert_eq!(down.len(), chain.len() + 1);
            // In base axes and about the base's origin, every section carries the same wrench.
            let mut frame = Isometry3::identity();
            for (transform, wrench) in chain.iter().zip(&down[1..]) {
                frame *= transform;
                prop_assert!((wrench_in(&frame, wrench) - down[0]).amax() < 1e-10);
            }
            // And moments sum to zero about the tip.
            let force = frame.rotation * upper(&w);
            let about_tip = lower(&down[0]) - frame.translation.vector.cross(&force);
            prop_assert!((about_tip - frame.rotation * lower(&w)).amax() < 1e-10);
        }

        #[test]
        fn turning_is_the_derivative(t in six(1.0), twist in six(1.0), w in six(1.0)) {
            let step = 1e-5;
            let at = |h: f64| {
                let moved = Displacement::new(&(twist * h)).transform();
                wrench_in(&(moved * Displacement::new(&t).transform()), &w)
            };
            let difference = (at(step) - at(-step)) / (2.0 * step);
            prop_assert!((turning(&at(0.0)) * twist - difference).amax() < 1e-8);
        }
    }
}
