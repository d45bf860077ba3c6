//! The paper's arms from their robot files.

use nalgebra::{Isometry3, Vector6};
use stiffarm_kernels::generic::Arm;
use stiffarm_papers::methods::bicchi::Loaded;
use stiffarm_papers::methods::bicchi::case::bending;
pub use stiffarm_papers::methods::bicchi::case::{STATED as STEEL, task as straight_task};

/// Half of what E = 205 GPa gives: the EJ that reproduces the printed wrench error.
pub const HALF: f64 = 205e9 * std::f64::consts::PI * 1e-8 / 8.0;

pub fn arm(n: usize, ej: f64) -> Arm {
    bending(n, ej).unwrap()
}

pub fn degrees(values: &[f64]) -> Vec<f64> {
    values.iter().map(|value| value.to_radians()).collect()
}

/// A wrench in the plane.
pub fn planar(fx: f64, fy: f64, mz: f64) -> Vector6<f64> {
    Vector6::new(fx, fy, 0.0, 0.0, 0.0, mz)
}

/// The arm under the paper's load on the tip times `size`/10 N, turning with it.
pub fn loaded(arm: &Arm, q: &[f64], size: f64) -> Loaded {
    Loaded::new(arm, q, &planar(0.0, size, 0.0)).unwrap()
}

/// fx, fy, mz of a wrench and x, y, angle of a pose.
pub fn in_plane(loaded: &Loaded) -> ([f64; 3], [f64; 3]) {
    let w = loaded.base_wrench();
    ([w[0], w[1], w[5]], pose_in_plane(&loaded.pose()))
}

pub fn pose_in_plane(pose: &Isometry3<f64>) -> [f64; 3] {
    let at = pose.translation.vector;
    [at.x, at.y, pose.rotation.scaled_axis().z]
}

pub fn assert_close(found: &[f64], expected: &[f64], tolerance: f64) {
    for (f, e) in found.iter().zip(expected) {
        assert!((f - e).abs() <= tolerance, "found {found:?}, expected {expected:?}");
    }
}
