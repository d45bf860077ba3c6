//! The links' weights: masses at their centres, beams' weights at the middle of their chords (Lin
//! et al., eq. 8: a distributed force acts at the link's centroid).

use std::vec::Vec;

use nalgebra::{DMatrix, DVector, Matrix3, Vector3, Vector6};

use super::arm::{Arm, Convention};
use super::kinematics::origin;
use super::links::Link;
use super::spatial::{stack, wrench_transport};
use super::stiffness::force_stiffness;
use super::textbook::{Textbook, block};
use crate::Output;

/// One weight at one posture.
pub(super) struct Weight {
    /// kg.
    pub(super) mass: f64,
    /// m·g in base axes, N.
    force: Vector3<f64>,
    /// Where it acts, in the base frame, m.
    pub(super) centre: Vector3<f64>,
    /// Its tensor of inertia about that place, base axes, kg·m².
    pub(super) inertia: Matrix3<f64>,
    /// Joints 1..=`moved_by` move it.
    pub(super) moved_by: usize,
    /// It hangs beyond the tips of the beams of rows 1..=`beyond`.
    pub(super) beyond: usize,
}

impl Weight {
    /// The wrench of this weight at a point, base axes.
    pub(super) fn wrench_at(&self, point: &Vector3<f64>) -> Vector6<f64> {
        wrench_transport(&self.centre, point) * stack(self.force, Vector3::zeros())
    }
}

/// The outputs of this file.
pub(super) const TEXTBOOK: &[(Output, Textbook)] = &[
    (Output::WeightTorque, |arm, q, _| Ok(block(arm.weight_torque(q)))),
    (Output::WeightStiffness, |arm, q, _| Ok(block(arm.weight_stiffness(q)))),
];

impl Arm {
    /// Gravity in the world's axes, m/s².
    pub(super) fn falling(&self) -> Vector3<f64> {
        self.base.rotation * self.gravity
    }

    /// Every weight of the arm: of link i its mass, fixed in frame i, and its beam.
    pub(super) fn weights(&self, q: &[f64]) -> Vec<Weight> {
        let frames = self.frames(q);
        let masses = self.joints.iter().zip(&frames[1..]).enumerate().map(|(k, (joint, frame))| {
            let turn = frame.rotation.to_rotation_matrix();
            Weight {
                mass: joint.mass,
                force: joint.mass * self.falling(),
                centre: origin(frame) + frame.rotation * joint.com,
                inertia: turn * joint.inertia * turn.transpose(),
                moved_by: k + 1,
                beyond: k + 1,
            }
        });
        let beams = self.links(q).into_iter().map(|link: Link<'_>| {
            let (mass, inertia) = link.rod();
            Weight {
                mass,
                force: mass * self.falling(),
                centre: link.middle(),
                inertia,
                moved_by: match self.convention {
                    Convention::Standard => link.row,
                    Convention::Modified => link.row - 1,
                },
                beyond: link.row - 1,
            }
        });
        masses.chain(beams).collect()
    }

    /// What the links' weights do to each joint, n, N·m (N if prismatic): the sum of `v_jᵀ m g`
    /// over the weights that joint j moves, `v_j` the velocity of the weight's centre. Positive
    /// like [`Arm::joint_torque`]: it is `−g(q)` of the equations of motion `M q̈ + C q̇ + g = τ`,
    /// and the motors hold the opposite.
    pub fn weight_torque(&self, q: &[f64]) -> DVector<f64> {
        let axes = self.axes(q);
        let mut torque = DVector::zeros(self.dof());
        for weight in self.weights(q) {
            for (j, axis) in axes[..weight.moved_by].iter().enumerate() {
                torque[j] += axis.velocity(&weight.centre).dot(&weight.force);
            }
        }
        torque
    }

    /// `∂(weight torque)/∂q`, n×n, row j, column i: the weights' part of K_C, each weight a force
    /// on a point that joints 1 to its own move. Symmetric.
    pub fn weight_stiffness(&self, q: &[f64]) -> DMatrix<f64> {
        let axes = self.axes(q);
        let mut stiffness = DMatrix::zeros(self.dof(), self.dof());
        for weight in self.weights(q) {
            let k = weight.moved_by;
            let own = force_stiffness(&axes[..k], &weight.centre, &weight.force);
            let mut block = stiffness.view_mut((0, 0), (k, k));
            block += own;
        }
        stiffness
    }
}
