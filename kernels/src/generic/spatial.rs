//! Wrenches and twists carried from one point of a rigid body to another (Lin et al., eqs. 1-7: the
//! virtual work stays the same). Axes are the base's throughout.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// A vector of three translations (or forces) and three rotations (or moments).
pub(super) fn stack(upper: Vector3<f64>, lower: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(upper.x, upper.y, upper.z, lower.x, lower.y, lower.z)
}

/// Translations of a twist, force of a wrench.
pub(super) fn upper(v: &Vector6<f64>) -> Vector3<f64> {
    v.fixed_rows::<3>(0).into_owned()
}

/// Rotations of a twist, moment of a wrench.
pub(super) fn lower(v: &Vector6<f64>) -> Vector3<f64> {
    v.fixed_rows::<3>(3).into_owned()
}

/// The same 3×3 block twice on the diagonal.
pub(super) fn blocks(block: &Matrix3<f64>) -> Matrix6<f64> {
    let mut all = Matrix6::zeros();
    all.fixed_view_mut::<3, 3>(0, 0).copy_from(block);
    all.fixed_view_mut::<3, 3>(3, 3).copy_from(block);
    all
}

/// The matrix that carries a wrench at `from` to `to`: `f' = f`, `m' = m + (from − to) × f`. Its
/// transpose carries a twist at `to` to `from`: `δ' = δ`, `d' = d + δ × (from − to)`.
pub(super) fn wrench_transport(from: &Vector3<f64>, to: &Vector3<f64>) -> Matrix6<f64> {
    let mut transport = Matrix6::identity();
    transport.fixed_view_mut::<3, 3>(3, 0).copy_from(&(from - to).cross_matrix());
    transport
}
