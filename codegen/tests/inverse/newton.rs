//! An independent solver: Newton's method from many postures, which knows nothing of branches.

use nalgebra::{Isometry3, Matrix6, Vector3, Vector6};
use stiffarm_draws::Draws;

use super::arms::Arm;

/// From the pose to another: translation and rotation vector, base axes.
pub fn difference(from: &Isometry3<f64>, to: &Isometry3<f64>) -> Vector6<f64> {
    let translation = to.translation.vector - from.translation.vector;
    let rotation: Vector3<f64> = (to.rotation * from.rotation.inverse()).scaled_axis();
    Vector6::new(translation.x, translation.y, translation.z, rotation.x, rotation.y, rotation.z)
}

/// How far two postures are apart, whole turns left out.
pub fn apart(a: &[f64], b: &[f64]) -> f64 {
    let whole = |x: f64| (x / core::f64::consts::TAU).round() * core::f64::consts::TAU;
    a.iter().zip(b).map(|(a, b)| (a - b - whole(a - b)).abs()).fold(0.0, f64::max)
}

/// The postures that reach a pose, as far as so many starts find them.
pub fn solutions(
    arm: &Arm,
    pose: &Isometry3<f64>,
    starts: usize,
    draws: &mut Draws,
) -> Vec<Vec<f64>> {
    let mut found: Vec<Vec<f64>> = Vec::new();
    for _ in 0..starts {
        let start: [f64; 6] = draws.array(-3.15, 3.15);
        let Some(q) = newton(arm, pose, start) else { continue };
        if found.iter().all(|known| apart(known, &q) > 1e-5) {
            found.push(q);
        }
    }
    found
}

fn newton(arm: &Arm, pose: &Isometry3<f64>, start: [f64; 6]) -> Option<Vec<f64>> {
    let mut q = start.to_vec();
    let mut error = difference(&arm.pose(&q), pose);
    for _ in 0..60 {
        if error.norm() < 1e-12 {
            return Some(q);
        }
        let jacobian = Matrix6::from_column_slice(arm.reference.jacobian(&q).as_slice());
        // Levenberg's damping, smaller with the error.
        let damped =
            jacobian.transpose() * jacobian + Matrix6::identity() * (1e-3 * error.norm_squared());
        let step = damped.lu().solve(&(jacobian.transpose() * error))?;
        let scale = (1.0 / step.amax()).min(1.0);
        q.iter_mut().zip(step.iter()).for_each(|(q, step)| *q += scale * step);
        error = difference(&arm.pose(&q), pose);
    }
    None
}
