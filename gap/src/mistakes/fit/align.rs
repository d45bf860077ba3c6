//! Frames in closed form, each exact where the others are; joints whose reading is not known, in their rows.

use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};
use stiffarm_kernels::Motion;

use super::{Fit, Posture, Row};
use crate::diagnose::rigid;

impl Fit {
    /// Frames, each exact where the others are; the arm in every row.
    pub(super) fn align(&mut self, turns: usize) -> Vec<Posture> {
        let mut postures = self.postures();
        let free = self.rows.iter().any(|row| row.free.is_some());
        for turn in 0..turns {
            for session in 0..self.at.bases.len() {
                // Rows whose joint is free come in when the others have told where the base is.
                let of = |(row, _): &(&Row, &Posture)| {
                    row.session == session && (turn > 0 || row.free.is_none())
                };
                let pairs = self.rows.iter().zip(&postures).filter(of);
                let (from, to): (Vec<_>, Vec<_>) = pairs
                    .map(|(row, posture)| {
                        ((posture.tool * Point3::from(self.at.points[row.point])).coords, row.at)
                    })
                    .unzip();
                if from.len() >= 3 {
                    self.at.bases[session] = rigid(&from, &to);
                }
            }
            let mut sums = vec![(Vector3::zeros(), 0.0); self.at.points.len()];
            for (row, posture) in self.rows.iter().zip(&postures) {
                let at = self.at.bases[row.session].inverse_transform_point(&Point3::from(row.at));
                let (sum, rows) = &mut sums[row.point];
                *sum += posture.tool.inverse_transform_point(&at).coords;
                *rows += 1.0;
            }
            for (point, (sum, rows)) in self.at.points.iter_mut().zip(sums) {
                if rows > 0.0 {
                    *point = sum / rows;
                }
            }
            if free {
                self.free_joints();
                postures = self.postures();
            }
        }
        if self.has_rotation {
            let mut sums = vec![Matrix3::zeros(); self.at.tools.len()];
            for (row, posture) in self.rows.iter().zip(&postures) {
                let turn = (self.at.bases[row.session].rotation * posture.tool.rotation).inverse()
                    * row.turn;
                sums[row.session] += turn.to_rotation_matrix().matrix();
            }
            for (tool, sum) in self.at.tools.iter_mut().zip(sums) {
                let mean = Rotation3::from_matrix_eps(&sum, 1e-9, 30, Rotation3::identity());
                *tool = UnitQuaternion::from_rotation_matrix(&mean);
            }
        }
        postures
    }

    /// Turns each free joint to where its row's point is nearest to what was measured: on a circle the
    /// nearest point lies in the same direction from the axis.
    pub(super) fn free_joints(&mut self) {
        for number in 0..self.rows.len() {
            let Some(joint) = self.rows[number].free else { continue };
            let row = &self.rows[number];
            let posture = self.posture(number);
            let [along, origin] = self.axis(&posture, joint);
            let is = (posture.tool * Point3::from(self.at.points[row.point])).coords - origin;
            let base = &self.at.bases[row.session];
            let to = base.inverse_transform_point(&Point3::from(row.at)).coords - origin;
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
