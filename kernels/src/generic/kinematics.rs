//! From joint values to frames (Dumas et al., Table 3; Lin et al., eqs. 13-14).

use std::vec::Vec;

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use super::arm::{Arm, Convention, Joint};
use super::textbook::Textbook;
use crate::{Motion, Output};

/// The axis of one joint at one posture, in base axes.
pub(super) struct Axis {
    pub(super) motion: Motion,
    /// Unit vector along the axis.
    pub(super) direction: Vector3<f64>,
    /// A point on the axis.
    pub(super) point: Vector3<f64>,
}

impl Axis {
    /// Velocity per unit of the joint's rate of the point `p` of a body that the joint moves.
    pub(super) fn velocity(&self, p: &Vector3<f64>) -> Vector3<f64> {
        match self.motion {
            Motion::Revolute => self.direction.cross(&(p - self.point)),
            Motion::Prismatic => self.direction,
        }
    }

    /// Angular velocity of that body per unit of the joint's rate.
    pub(super) fn spin(&self) -> Vector3<f64> {
        match self.motion {
            Motion::Revolute => self.direction,
            Motion::Prismatic => Vector3::zeros(),
        }
    }
}

/// The transform of one row at the joint value `q`.
fn row_transform(convention: Convention, joint: &Joint, q: f64) -> Isometry3<f64> {
    let (theta, d) = match joint.motion {
        Motion::Revolute => (joint.theta + q, joint.d),
        Motion::Prismatic => (joint.theta, joint.d + q),
    };
    let rz = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), theta);
    let tz = Translation3::new(0.0, 0.0, d);
    let tx = Translation3::new(joint.a, 0.0, 0.0);
    let mut inclined = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), joint.alpha);
    // Few tables have a beta, and every posture asks for each row.
    if joint.beta != 0.0 {
        inclined *= UnitQuaternion::from_axis_angle(&Vector3::y_axis(), joint.beta);
    }
    match convention {
        Convention::Standard => rz * tz * tx * inclined,
        Convention::Modified => inclined * tx * rz * tz,
    }
}

/// The outputs of this file.
pub(super) const TEXTBOOK: &[(Output, Textbook)] = &[
    (Output::Pose, |arm, q, _| Ok(columns(&arm.pose(q)))),
    (Output::Frames, |arm, q, _| Ok(arm.frames(q)[1..].iter().flat_map(columns).collect())),
];

impl Arm {
    /// Frames 0 to n in the world (n + 1 of them; frame 0 is the base), m.
    pub fn frames(&self, q: &[f64]) -> Vec<Isometry3<f64>> {
        assert_eq!(q.len(), self.dof(), "as many joint values as the arm has joints");
        let mut frames = Vec::with_capacity(self.dof() + 1);
        let mut frame = self.base;
        frames.push(frame);
        for (joint, &value) in self.joints.iter().zip(q) {
            frame *= row_transform(self.convention, joint, value);
            frames.push(frame);
        }
        frames
    }

    /// The tool frame in the world, m.
    pub fn pose(&self, q: &[f64]) -> Isometry3<f64> {
        self.frames(q)[self.dof()] * self.tool
    }

    /// The tool origin in the base frame, m.
    pub(super) fn tool_origin(&self, q: &[f64]) -> Vector3<f64> {
        origin(&self.pose(q))
    }

    /// The axes of joints 1 to n: z of frame i−1 (standard) or of frame i (modified).
    pub(super) fn axes(&self, q: &[f64]) -> Vec<Axis> {
        let frames = self.frames(q);
        let first = match self.convention {
            Convention::Standard => 0,
            Convention::Modified => 1,
        };
        self.joints
            .iter()
            .zip(&frames[first..])
            .map(|(joint, frame)| Axis {
                motion: joint.motion,
                direction: frame * Vector3::z(),
                point: origin(frame),
            })
            .collect()
    }
}

/// Where a frame stands.
pub(super) fn origin(frame: &Isometry3<f64>) -> Vector3<f64> {
    frame.translation.vector
}

/// The columns x, y, z and origin of a frame, one after the other.
fn columns(frame: &Isometry3<f64>) -> Vec<f64> {
    let rotation = frame.rotation.to_rotation_matrix();
    rotation.matrix().iter().chain(frame.translation.vector.iter()).copied().collect()
}
