//! Poses as nalgebra's isometries and matrices, and back. Arrays need nothing from here: nalgebra makes a
//! `SMatrix` of `[[S; 6]; N]` and an `SVector` of `[S; 6]` by `from`, column by column as they lie.

use nalgebra::{Isometry3, Matrix3, Matrix3x4, RealField, Rotation3, Translation3, UnitQuaternion};

use crate::Pose;

/// The rotation becomes a quaternion: what of it is not orthonormal, a rounding, is lost.
impl<S: RealField + Copy> From<Pose<S>> for Isometry3<S> {
    fn from(Pose { rotation, position }: Pose<S>) -> Self {
        let rotation = Rotation3::from_matrix_unchecked(Matrix3::from(rotation));
        let turned = UnitQuaternion::from_rotation_matrix(&rotation);
        Isometry3::from_parts(Translation3::from(position), turned)
    }
}

impl<S: RealField + Copy> From<Isometry3<S>> for Pose<S> {
    fn from(isometry: Isometry3<S>) -> Self {
        let rotation = isometry.rotation.to_rotation_matrix().into_inner().into();
        Pose { rotation, position: isometry.translation.vector.into() }
    }
}

/// Columns x, y, z, origin, as they are.
impl<S: nalgebra::Scalar + Copy> From<Pose<S>> for Matrix3x4<S> {
    fn from(pose: Pose<S>) -> Self {
        Matrix3x4::from(pose.columns())
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use super::*;

    /// Any rotation, also one by nearly half a turn, comes back as it was to a few roundings; a matrix to the bit.
    #[test]
    fn a_pose_is_an_isometry_and_back() {
        for angle in [0.0, 1e-9, 0.3, 1.7, 3.1, PI - 1e-9] {
            let axis = nalgebra::Unit::new_normalize(nalgebra::Vector3::new(0.3, -0.5, 0.8));
            let turn = Rotation3::from_axis_angle(&axis, angle);
            let pose = Pose { rotation: turn.into_inner().into(), position: [0.1, -2.0, 3.5] };
            let isometry: Isometry3<f64> = pose.into();
            assert!(
                (isometry.rotation.to_rotation_matrix().matrix() - turn.matrix()).amax() < 1e-15
            );
            let back = Pose::from(isometry);
            assert_eq!(back.position, pose.position);
            let (a, b) = (back.columns(), pose.columns());
            let both = a.as_flattened().iter().zip(b.as_flattened());
            assert!(both.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < 1e-15);
            let matrix: Matrix3x4<f64> = pose.into();
            assert_eq!(matrix.as_slice(), pose.columns().as_flattened());
        }
    }
}
