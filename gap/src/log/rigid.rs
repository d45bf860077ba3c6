//! What rigid links ask of the joints' drives, in proportion to their inertias.
//!
//! The equations of motion are linear in ten numbers of each link: mass, first moments and second
//! moments about the origin of its row's frame, in that frame's axes (Atkeson, An & Hollerbach 1986;
//! Khalil & Dombre, *Modeling, Identification and Control of Robots*, ch. 9). Velocities and
//! accelerations go up the chain, each link's force and moment come down it (Luh, Walker & Paul 1980);
//! all in base axes. Not all of the numbers are seen, whatever the motion: the [`Base`] is a set of
//! columns that the others depend on.

use nalgebra::{Isometry3, Matrix3, Vector3};
use stiffarm_kernels::generic::Arm;
use stiffarm_kernels::{Convention, Motion};

use crate::dice::{Dice, Stream};

/// Numbers of one link, in this order.
pub const NAMES: [&str; 10] = ["m", "mx", "my", "mz", "Ixx", "Ixy", "Ixz", "Iyy", "Iyz", "Izz"];

/// Random states in which the columns are held against each other.
const STATES: usize = 60;

/// A column of which less than this part of the largest stands apart from those before it depends on
/// them: rounding leaves about 1e-14.
const APART: f64 = 1e-9;

/// Entries of a symmetric matrix in the order of the names.
const ENTRIES: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// How one link moves: base axes.
struct Moving {
    frame: Isometry3<f64>,
    spin: Vector3<f64>,
    spin_rate: Vector3<f64>,
    /// Of the frame's origin, without gravity's.
    acceleration: Vector3<f64>,
}

/// Torque of each joint per unit of each number, row by row: `n × 10 n`, N·m (N if prismatic).
pub fn regressor(arm: &Arm, q: &[f64], qd: &[f64], qdd: &[f64]) -> Vec<f64> {
    let n = arm.dof();
    let frames = arm.frames(q);
    let axes = match arm.convention {
        Convention::Standard => &frames[..n],
        Convention::Modified => &frames[1..],
    };
    let origin = |frame: &Isometry3<f64>| frame.translation.vector;
    let mut rows = vec![0.0; n * 10 * n];
    let mut link = Moving {
        frame: frames[0],
        spin: Vector3::zeros(),
        spin_rate: Vector3::zeros(),
        acceleration: -(arm.base.rotation * arm.gravity),
    };
    for i in 0..n {
        let (axis, foot) = (axes[i].rotation * Vector3::z(), origin(&axes[i]));
        link = link.next(frames[i + 1], arm.joints[i].motion, axis, foot, qd[i], qdd[i]);
        let at = origin(&link.frame);
        for (k, (force, moment)) in link.wrenches().into_iter().enumerate() {
            for j in 0..=i {
                let (axis, foot) = (axes[j].rotation * Vector3::z(), origin(&axes[j]));
                rows[j * 10 * n + 10 * i + k] = match arm.joints[j].motion {
                    Motion::Revolute => axis.dot(&(moment + (at - foot).cross(&force))),
                    Motion::Prismatic => axis.dot(&force),
                };
            }
        }
    }
    rows
}

impl Moving {
    /// Acceleration of a point that this link carries.
    fn carried(&self, point: Vector3<f64>) -> Vector3<f64> {
        let arm = point - self.frame.translation.vector;
        self.acceleration + self.spin_rate.cross(&arm) + self.spin.cross(&self.spin.cross(&arm))
    }

    /// The link beyond a joint whose axis goes through `foot`.
    fn next(
        &self,
        frame: Isometry3<f64>,
        motion: Motion,
        axis: Vector3<f64>,
        foot: Vector3<f64>,
        rate: f64,
        acceleration: f64,
    ) -> Moving {
        let origin = frame.translation.vector;
        match motion {
            Motion::Revolute => {
                let turned = Moving {
                    frame: Isometry3::from_parts(foot.into(), frame.rotation),
                    spin: self.spin + axis * rate,
                    spin_rate: self.spin_rate + axis * acceleration + self.spin.cross(&axis) * rate,
                    acceleration: self.carried(foot),
                };
                Moving { acceleration: turned.carried(origin), frame, ..turned }
            }
            Motion::Prismatic => Moving {
                frame,
                spin: self.spin,
                spin_rate: self.spin_rate,
                acceleration: self.carried(origin)
                    + axis * acceleration
                    + 2.0 * self.spin.cross(&axis) * rate,
            },
        }
    }

    /// Force and moment about the frame's origin that a unit of each number asks for.
    fn wrenches(&self) -> [(Vector3<f64>, Vector3<f64>); 10] {
        let turn = self.frame.rotation.to_rotation_matrix().into_inner();
        let (spin, spin_rate) = (self.spin, self.spin_rate);
        let mut wrenches = [(Vector3::zeros(), Vector3::zeros()); 10];
        wrenches[0].0 = self.acceleration;
        for k in 0..3 {
            let first = turn.column(k).into_owned();
            let force = spin_rate.cross(&first) + spin.cross(&spin.cross(&first));
            wrenches[1 + k] = (force, first.cross(&self.acceleration));
        }
        for (k, (row, column)) in ENTRIES.into_iter().enumerate() {
            let mut unit = Matrix3::zeros();
            (unit[(row, column)], unit[(column, row)]) = (1.0, 1.0);
            let inertia = turn * unit * turn.transpose();
            wrenches[4 + k].1 = inertia * spin_rate + spin.cross(&(inertia * spin));
        }
        wrenches
    }
}

/// Columns of the regressor that do not depend on each other, whatever the motion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Base {
    /// Their indices, rising.
    pub columns: Vec<usize>,
}

impl Base {
    /// Of an arm, by numerical rank over random states (Gautier 1991).
    pub fn of(arm: &Arm) -> Base {
        let n = arm.dof();
        let mut dice = Dice::new(0, Stream::Poses);
        let mut columns = vec![Vec::with_capacity(STATES * n); 10 * n];
        for _ in 0..STATES {
            let mut draw = |size: f64| -> Vec<f64> {
                (0..n).map(|_| size * dice.between(-1.0, 1.0)).collect()
            };
            let (q, qd, qdd) = (draw(3.0), draw(3.0), draw(10.0));
            let rows = regressor(arm, &q, &qd, &qdd);
            for (at, value) in rows.into_iter().enumerate() {
                columns[at % (10 * n)].push(value);
            }
        }
        let size = |c: &[f64]| c.iter().map(|x| x * x).sum::<f64>().sqrt();
        // Against the largest of all: a column that is nothing but rounding is apart from all others.
        let largest = columns.iter().map(|c| size(c)).fold(0.0, f64::max);
        let mut kept: Vec<Vec<f64>> = Vec::new();
        let mut base = Vec::new();
        for (index, mut column) in columns.into_iter().enumerate() {
            // Twice: once leaves rounding behind that is as large as what is looked for.
            for _ in 0..2 {
                for other in &kept {
                    let along: f64 = column.iter().zip(other).map(|(a, b)| a * b).sum();
                    column.iter_mut().zip(other).for_each(|(a, b)| *a -= along * b);
                }
            }
            let left = size(&column);
            if left > APART * largest {
                column.iter_mut().for_each(|x| *x /= left);
                kept.push(column);
                base.push(index);
            }
        }
        Base { columns: base }
    }
}

#[cfg(test)]
mod tests;
