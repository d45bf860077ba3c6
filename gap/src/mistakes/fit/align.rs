//! Frames in closed form, each exact where the others are; joints whose reading is not known, in their rows.

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};
use stiffarm_kernels::Motion;

use super::{Fit, Row};
use crate::diagnose::rigid;

impl Fit {
    /// Frames, each exact where the others are.
    pub(super) fn align(&mut self, turns: usize) {
        let mut poses = self.poses();
        let free = self.rows.iter().any(|row| row.free.is_some());
        for turn in 0..turns {
            for session in 0..self.at.bases.len() {
                // Rows whose joint is free come in when the others have told where the base is.
                let of = |(row, _): &(&Row, &Isometry3<f64>)| {
                    row.session == session && (turn > 0 || row.free.is_none())
                };
                let pairs = self.rows.iter().zip(&poses).filter(of);
                let (from, to): (Vec<_>, Vec<_>) = pairs
                    .map(|(row, pose)| {
                        ((pose * Point3::from(self.at.points[row.point])).coords, row.at)
                    })
                    .unzip();
                if from.len() >= 3 {
                    self.at.bases[session] = rigid(&from, &to);
                }
            }
            let mut sums = vec![(Vector3::zeros(), 0.0); self.at.points.len()];
            for (row, pose) in self.rows.iter().zip(&poses) {
                let at = self.at.bases[row.session].inverse() * Point3::from(row.at);
                let sum = &mut sums[row.point];
                *sum = (sum.0 + (pose.inverse() * at).coords, sum.1 + 1.0);
            }
            for (point, (sum, rows)) in self.at.points.iter_mut().zip(sums) {
                if rows > 0.0 {
                    *point = sum / rows;
                }
            }
            if free {
                self.free_joints();
                poses = self.poses();
            }
        }
        if self.has_rotation {
            let mut sums = vec![Matrix3::zeros(); self.at.tools.len()];
            for (row, pose) in self.rows.iter().zip(&poses) {
                let turn =
                    (self.at.bases[row.session].rotation * pose.rotation).inverse() * row.turn;
                sums[row.session] += turn.to_rotation_matrix().matrix();
            }
            for (tool, sum) in self.at.tools.iter_mut().zip(sums) {
                let mean = Rotation3::from_matrix_eps(&sum, 1e-9, 30, Rotation3::identity());
                *tool = UnitQuaternion::from_rotation_matrix(&mean);
            }
        }
    }

    /// Turns each free joint to where its row's point is nearest to what was measured: on a circle the
    /// nearest point lies in the same direction from the axis.
    pub(super) fn free_joints(&mut self) {
        for number in 0..self.rows.len() {
            let Some(joint) = self.rows[number].free else { continue };
            let row = &self.rows[number];
            let (axes, pose) = self.axes(&self.joints(number));
            let (along, origin) = axes[joint];
            let is = (pose * Point3::from(self.at.points[row.point])).coords - origin;
            let to = (self.at.bases[row.session].inverse() * Point3::from(row.at)).coords - origin;
            let by = match self.arm.joints[joint].motion {
                Motion::Revolute => {
                    let flat = |v: Vector3<f64>| v - along * along.dot(&v);
                    let (is, to) = (flat(is), flat(to));
                    along.dot(&is.cross(&to)).atan2(is.dot(&to))
                }
                Motion::Prismatic => along.dot(&(to - is)),
            };
            if by.is_finite() {
                self.at.turned[number] += by;
            }
        }
    }
}
