//! The paper's arms from their robot files.

use nalgebra::{Isometry3, Vector6};
use stiffarm_kernels::generic::Arm;
use stiffarm_papers::methods::bicchi::{Loaded, Task};

/// E = 210 GPa and the section's own second moment of area: EJ = 1649 N·m².
pub const STEEL: f64 = 210e9 * std::f64::consts::PI * 1e-8 / 4.0;

/// Half of what E = 205 GPa gives: the EJ that reproduces the printed wrench error.
pub const HALF: f64 = 205e9 * std::f64::consts::PI * 1e-8 / 8.0;

/// The arm of `n` = 3 or 5 joints with the bending stiffness `ej` in both planes, N·m².
pub fn arm(n: usize, ej: f64) -> Arm {
    let mut arm = stiffarm_papers::methods::arm(&format!("bicchi_{n}r")).unwrap();
    assert_eq!(arm.dof(), n);
    for joint in &mut arm.joints {
        let beam = joint.beam.as_mut().unwrap();
        beam.iy = ej / beam.youngs_modulus;
        beam.iz = beam.iy;
    }
    arm
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

/// The task of section 5: the straight arm's rigid wrench is wanted, P = 1.
pub fn straight_task(arm: &Arm) -> Task<'_> {
    Task {
        arm,
        load: planar(0.0, 10.0, 0.0),
        target: planar(0.0, 10.0, 10.0 * arm.dof() as f64),
        weights: Vector6::repeat(1.0),
    }
}

pub fn assert_close(found: &[f64], expected: &[f64], tolerance: f64) {
    for (f, e) in found.iter().zip(expected) {
        assert!((f - e).abs() <= tolerance, "found {found:?}, expected {expected:?}");
    }
}
