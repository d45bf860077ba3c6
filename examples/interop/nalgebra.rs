//! Poses as nalgebra's isometries, Jacobians as its matrices: joint values that bring the tool to a pose, by
//! damped least squares.
//!
//! ```text
//! cargo run -p stiffarm --example with_nalgebra --features nalgebra
//! ```

use nalgebra::{Isometry3, Matrix6, SMatrix, SVector, Vector6};
use stiffarm::kernels::has;

stiffarm::robot! {
    mod ur5 from "robots/arms/ur5.toml";
    outputs: pose, jacobian;
}

/// The twist from a pose to another: translation, then the rotation vector, base axes.
fn twist(from: &Isometry3<f64>, to: &Isometry3<f64>) -> Vector6<f64> {
    let moved = to.translation.vector - from.translation.vector;
    let turned = (to.rotation * from.rotation.inverse()).scaled_axis();
    Vector6::new(moved.x, moved.y, moved.z, turned.x, turned.y, turned.z)
}

/// One step towards `target`, and how far it is from there: m and rad together.
fn step<const N: usize, A>(arm: &A, q: &mut [f64; N], target: &Isometry3<f64>) -> f64
where
    A: has::Pose<N> + has::Jacobian<N>,
{
    let posture = arm.posture(q);
    let error = twist(&arm.pose(&posture).into(), target);
    // Column by column as it lies: the array is the matrix.
    let jacobian: SMatrix<f64, 6, N> = arm.jacobian(&posture).into();
    let damped: Matrix6<f64> = jacobian * jacobian.transpose() + 1e-8 * Matrix6::identity();
    if let Some(inverse) = damped.try_inverse() {
        *q = (SVector::from(*q) + jacobian.transpose() * inverse * error).into();
    }
    error.norm()
}

fn main() {
    let target = Isometry3::from(ur5::pose(&[0.4, -1.2, 1.3, -0.6, 0.9, 0.2]));
    let mut q = [0.3, -1.0, 1.1, -0.5, 1.0, 0.1];
    let left: Vec<f64> = (0..8).map(|_| step(&ur5::Robot, &mut q, &target)).collect();
    let told: Vec<String> = left.iter().map(|error| format!("{error:.1e}")).collect();
    println!("from step to step {}", told.join(", "));
    // Newton's steps double the digits until rounding is left, the damping's share of 1e-8 each.
    assert!(left[7] < 1e-12, "{left:?}");
}
