//! A step of least squares of all unknowns: bases, points, tools, zeros, springs, open amounts.

use nalgebra::{DMatrix, DVector, Point3, UnitQuaternion, Vector3, Vector6};
use stiffarm_kernels::Motion;

use super::{FLAT, Fit, Gap, NO_SPRING, Posture, ZERO};

/// Prior scale of an amount, rad, m or 1: as good as none.
const ANY: f64 = 10.0;

impl Fit {
    /// Number of unknowns of frames and points.
    fn frames(&self) -> [usize; 3] {
        let bases = 6 * self.at.bases.len();
        let points = bases + 3 * self.at.points.len();
        [bases, points, points + if self.has_rotation { 3 * self.at.tools.len() } else { 0 }]
    }

    /// Where the amounts begin.
    fn first_amount(&self) -> usize {
        self.frames()[2] + self.arm.dof() * if self.is_loaded { 2 } else { 1 }
    }

    /// A step of least squares.
    pub(super) fn step(
        &self,
        postures: &[Posture],
        gaps: &[Gap],
        scale: f64,
        damping: f64,
    ) -> Option<DVector<f64>> {
        let (dof, [bases, points, tools]) = (self.arm.dof(), self.frames());
        let (first, steps) = (self.first_amount(), self.steps_of_entries());
        let count = first + steps.len();
        let (mut normal, mut right) = (DMatrix::zeros(count, count), DVector::zeros(count));
        let mut columns: Vec<(usize, Vector6<f64>)> = Vec::new();
        let mut turns: Vec<Vector6<f64>> = Vec::new();
        for ((row, gap), posture) in self.rows.iter().zip(gaps).zip(postures) {
            let base = &self.at.bases[row.session];
            let turn = base.rotation * posture.tool.rotation;
            let at = (posture.tool * Point3::from(self.at.points[row.point])).coords;
            let out = base.rotation * at;
            columns.clear();
            turns.clear();
            for k in 0..3 {
                let axis = Vector3::ith(k, 1.0);
                columns.push((6 * row.session + k, stacked(axis, Vector3::zeros())));
                columns.push((6 * row.session + 3 + k, stacked(axis.cross(&out), axis)));
                columns.push((bases + 3 * row.point + k, stacked(turn * axis, Vector3::zeros())));
                if self.has_rotation {
                    let about = turn * (self.at.tools[row.session] * axis);
                    columns.push((points + 3 * row.session + k, stacked(Vector3::zeros(), about)));
                }
            }
            for j in 0..dof {
                let [along, origin] = self.axis(posture, j);
                let twist = match self.arm.joints[j].motion {
                    Motion::Revolute => stacked(along.cross(&(at - origin)), along),
                    Motion::Prismatic => stacked(along, Vector3::zeros()),
                };
                let twist = rotated(&base.rotation, &twist);
                turns.push(twist);
                columns.push((tools + j, twist));
                if self.is_loaded {
                    let (soft, scale) = self.soft[j];
                    let gives = if scale == NO_SPRING { soft } else { self.compliance(j) };
                    columns.push((tools + dof + j, twist * (gives * row.torque[j])));
                }
            }
            let amounts = self.by_amounts(row, &posture.q, &steps, &turns);
            columns.extend(amounts.enumerate().map(|(k, column)| (first + k, column)));
            let mut gap = stacked(gap.0, gap.1);
            let weight =
                1.0 / (1.0 + (self.size(&(head(&gap), tail(&gap))) / scale).powi(2) / FLAT);
            for (_, column) in &mut columns {
                weighted(column, self.lever);
            }
            weighted(&mut gap, self.lever);
            if let Some(joint) = row.free {
                // What the free joint can take up tells nothing.
                let own = columns.iter().find(|(k, _)| *k == tools + joint).map(|(_, c)| *c);
                if let Some(own) = own.and_then(|own| own.try_normalize(1e-12)) {
                    columns.iter_mut().for_each(|(_, c)| *c -= own * own.dot(c));
                    gap -= own * own.dot(&gap);
                }
            }
            let weight = weight / (scale * scale);
            for (a, (i, one)) in columns.iter().enumerate() {
                right[*i] += weight * one.dot(&gap);
                // Cholesky reads the lower half.
                for (j, other) in &columns[a..] {
                    normal[(*i.max(j), *i.min(j))] += weight * one.dot(other);
                }
            }
        }
        for j in 0..dof {
            held(&mut normal, &mut right, tools + j, self.at.zeros[j], ZERO * self.tight);
            if self.is_loaded {
                let scale = self.soft[j].1 * self.tight;
                held(&mut normal, &mut right, tools + dof + j, self.at.springs[j], scale);
            }
        }
        for at in first..count {
            held(&mut normal, &mut right, at, 0.0, ANY);
        }
        for k in 0..count {
            normal[(k, k)] += damping * normal[(k, k)] + 1e-9 * normal[(0, 0)].max(1.0);
        }
        normal.cholesky().map(|factor| factor.solve(&right))
    }

    /// Takes a step.
    pub(super) fn advance(&mut self, step: &DVector<f64>) {
        let (dof, [bases, points, tools]) = (self.arm.dof(), self.frames());
        let three = |at: usize| Vector3::new(step[at], step[at + 1], step[at + 2]);
        for (s, base) in self.at.bases.iter_mut().enumerate() {
            base.translation.vector += three(6 * s);
            base.rotation = UnitQuaternion::from_scaled_axis(three(6 * s + 3)) * base.rotation;
        }
        for (m, point) in self.at.points.iter_mut().enumerate() {
            *point += three(bases + 3 * m);
        }
        if self.has_rotation {
            for (s, tool) in self.at.tools.iter_mut().enumerate() {
                *tool *= UnitQuaternion::from_scaled_axis(three(points + 3 * s));
            }
        }
        for j in 0..dof {
            self.at.zeros[j] += step[tools + j];
            if self.is_loaded {
                let (now, by) = (&mut self.at.springs[j], step[tools + dof + j]);
                // A spring that the file has not is no stiffer than rigid; another one is told by its logarithm.
                *now = match self.soft[j].1 == NO_SPRING {
                    true => (*now + by).max(0.0),
                    false => *now + by.clamp(-1.5, 1.5),
                };
            }
        }
        let first = self.first_amount();
        self.at.amounts.iter_mut().enumerate().for_each(|(k, more)| *more += step[first + k]);
        self.put_amounts();
    }
}

pub(super) fn stacked(shift: Vector3<f64>, turn: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z)
}

fn head(six: &Vector6<f64>) -> Vector3<f64> {
    six.fixed_rows::<3>(0).into_owned()
}

fn tail(six: &Vector6<f64>) -> Vector3<f64> {
    six.fixed_rows::<3>(3).into_owned()
}

pub(super) fn rotated(by: &UnitQuaternion<f64>, twist: &Vector6<f64>) -> Vector6<f64> {
    stacked(by * head(twist), by * tail(twist))
}

/// Rotations by the lever that they count.
fn weighted(twist: &mut Vector6<f64>, lever: f64) {
    let mut turn = twist.fixed_rows_mut::<3>(3);
    turn *= lever;
}

/// Holds an unknown that is `now` to zero by its prior scale.
fn held(normal: &mut DMatrix<f64>, right: &mut DVector<f64>, at: usize, now: f64, scale: f64) {
    normal[(at, at)] += 1.0 / (scale * scale);
    right[at] -= now / (scale * scale);
}
