//! The three Jacobians of Lin, Chiang & Cui: for wrenches and displacements between frames, for
//! axes alone, and from joint changes to the change of the tool.

use nalgebra::{Isometry3, Matrix6, Matrix6xX, Vector3, Vector6};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention};

use stiffarm_papers::methods::transport::wrench_matrix;

/// The Pose Jacobian `⁰J_C` of the frame `frame` (eq. 5), 6×6: takes a small displacement of a body
/// as the reference frame sees it (about the reference's origin) to what the frame sees of it:
/// `ᶜD = ⁰J_C D` (eq. 4). Its transpose takes a wrench in the frame to the reference frame:
/// `F = (⁰J_C)ᵀ ᶜF` (eqs. 6 and 7), with the same virtual work (eqs. 1-3).
///
/// Rows: `n·d + (p × n)·δ`, and the same of o and a; `n·δ`, `o·δ`, `a·δ`.
pub fn pose_jacobian(frame: &Isometry3<f64>) -> Matrix6<f64> {
    wrench_matrix(frame).transpose()
}

/// The Orientation Jacobian `J'` of the frame `frame` (eq. 25), 6×6: takes a displacement (or a
/// wrench) from the frame's axes to the reference frame's and leaves it at its point.
pub fn orientation_jacobian(frame: &Isometry3<f64>) -> Matrix6<f64> {
    wrench_matrix(&Isometry3::from_parts(Default::default(), frame.rotation))
}

/// The Differential Jacobian `J''` (eqs. 37-41), 6×n: the displacement of the tool in tool axes, at
/// the tool origin, per unit of each joint's change.
///
/// Column i is made of the columns n, o, a, p of the tool as the frame of joint i's axis sees it
/// (i−1 of a standard table, i of a modified one). The last component of eq. 38 is printed with a
/// wrong sign; here it is `−a_x p_y + a_y p_x`.
pub fn differential_jacobian(arm: &Arm, q: &[f64]) -> Matrix6xX<f64> {
    let frames = arm.frames(q);
    let first = match arm.convention {
        Convention::Standard => 0,
        Convention::Modified => 1,
    };
    let tool = arm.pose(q);
    let column = |(frame, motion): (&Isometry3<f64>, Motion)| {
        let seen = frame.inverse() * tool;
        let p = seen.translation.vector;
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| seen.rotation * axis);
        let along = axes.map(|axis| axis.z);
        let across = axes.map(|axis| -axis.x * p.y + axis.y * p.x);
        match motion {
            Motion::Revolute => {
                let [x, y, z] = across;
                Vector6::new(x, y, z, along[0], along[1], along[2])
            }
            Motion::Prismatic => Vector6::new(along[0], along[1], along[2], 0.0, 0.0, 0.0),
        }
    };
    let motions = arm.joints.iter().map(|joint| joint.motion);
    let columns: Vec<_> = frames[first..].iter().zip(motions).map(column).collect();
    Matrix6xX::from_fn(columns.len(), |row, joint| columns[joint][row])
}
