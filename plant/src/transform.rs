//! Homogeneous transforms, 4×4.

use nalgebra::{Isometry3, Matrix3, Matrix4, Rotation3, UnitQuaternion, Vector3, Vector6};

/// `exp([r]×)` after a translation: a displacement `[d; r]` as a transform.
pub(super) fn displaced(by: &Vector6<f64>) -> Matrix4<f64> {
    let turn = Rotation3::from_scaled_axis(Vector3::new(by[3], by[4], by[5]));
    from_parts(turn.matrix(), &Vector3::new(by[0], by[1], by[2]))
}

/// A rotation behind a translation.
pub(super) fn from_parts(rotation: &Matrix3<f64>, translation: &Vector3<f64>) -> Matrix4<f64> {
    let mut matrix = Matrix4::identity();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(rotation);
    matrix.fixed_view_mut::<3, 1>(0, 3).copy_from(translation);
    matrix
}

/// Of a rigid motion.
pub(super) fn of(motion: &Isometry3<f64>) -> Matrix4<f64> {
    motion.to_homogeneous()
}

/// `Rx`, `Ry` or `Rz`: axis 0, 1 or 2.
pub(super) fn turn(axis: usize, angle: f64) -> Matrix4<f64> {
    let (sin, cos) = angle.sin_cos();
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut matrix = Matrix4::identity();
    (matrix[(j, j)], matrix[(k, k)]) = (cos, cos);
    (matrix[(k, j)], matrix[(j, k)]) = (sin, -sin);
    matrix
}

/// `Tx`, `Ty` or `Tz`: axis 0, 1 or 2.
pub(super) fn slide(axis: usize, length: f64) -> Matrix4<f64> {
    let mut matrix = Matrix4::identity();
    matrix[(axis, 3)] = length;
    matrix
}

/// The rotation part.
pub(super) fn rotation(matrix: &Matrix4<f64>) -> Matrix3<f64> {
    matrix.fixed_view::<3, 3>(0, 0).into_owned()
}

/// The translation part.
pub(super) fn origin(matrix: &Matrix4<f64>) -> Vector3<f64> {
    matrix.fixed_view::<3, 1>(0, 3).into_owned()
}

/// Where a point of a frame is.
pub(super) fn carried(frame: &Matrix4<f64>, point: &Vector3<f64>) -> Vector3<f64> {
    rotation(frame) * point + origin(frame)
}

/// The inverse of a rigid motion.
pub(super) fn inverse(matrix: &Matrix4<f64>) -> Matrix4<f64> {
    let back = rotation(matrix).transpose();
    from_parts(&back, &-(back * origin(matrix)))
}

/// `[v]×`.
pub(super) fn cross(v: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0)
}

/// The rotation vector of a rotation, its angle at most π.
pub(super) fn rotation_vector(rotation: &Matrix3<f64>) -> Vector3<f64> {
    let rotation = Rotation3::from_matrix_unchecked(*rotation);
    UnitQuaternion::from_rotation_matrix(&rotation).scaled_axis()
}

pub(super) fn rotation_of(vector: &Vector3<f64>) -> Matrix3<f64> {
    Rotation3::from_scaled_axis(*vector).into_inner()
}

/// The left Jacobian of the rotation vector `r`: as `r` grows by `dr`, `exp([r]×)` is turned by
/// `J dr`, in the axes that it maps to.
pub(super) fn left_jacobian(r: &Vector3<f64>) -> Matrix3<f64> {
    let (square, k) = (r.norm_squared(), cross(r));
    // The series: an elastic rotation is a small fraction of a radian, and ten terms are exact to
    // the last digit up to one radian.
    let (mut first, mut second, mut term) = (0.0, 0.0, 1.0);
    for n in 0..10 {
        let n = f64::from(n);
        first += term / ((2.0 * n + 1.0) * (2.0 * n + 2.0));
        second += term / ((2.0 * n + 1.0) * (2.0 * n + 2.0) * (2.0 * n + 3.0));
        term *= -square / ((2.0 * n + 1.0) * (2.0 * n + 2.0));
    }
    Matrix3::identity() + k * first + k * k * second
}
