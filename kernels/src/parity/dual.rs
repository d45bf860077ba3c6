//! Derivatives of the forward kinematics by dual numbers: exact but for rounding, and from nothing
//! but the definition of a table's row.
//!
//! `J_j = [∂p/∂q_j; ω_j]` with `ω_j = vee(∂R/∂q_j Rᵀ)`, `K_C` is its derivative times the wrench,
//! and the weights' torques are the slope of `Σ m g · c`.

use std::vec::Vec;

use crate::generic::{Arm, Convention, Joint};
use crate::{Motion, Output};
use num_dual::{Dual64, DualNum, HyperDual64};

/// A number with derivatives.
pub(super) trait Number: DualNum<Primitive = f64> + Copy {}
impl<T: DualNum<Primitive = f64> + Copy> Number for T {}

/// Rows of a homogeneous matrix without the last: rotation, then the origin.
pub(super) type Frame<T> = [[T; 4]; 3];

/// The table's entries as numbers with derivatives.
pub(super) struct Table<T> {
    /// theta, d, a, alpha, joint values included.
    pub(super) rows: Vec<[T; 4]>,
    /// beta of each row.
    tilts: Vec<T>,
    /// The base in the world.
    base: Frame<T>,
    /// Translation and rotation vector.
    tool: [T; 6],
}

/// Everything that derivatives of the kinematics say of a posture under a wrench.
pub struct Derivatives {
    /// Column by column.
    jacobian: Vec<[f64; 6]>,
    /// The tool's axes as columns.
    rotation: [[f64; 3]; 3],
    /// Its origin.
    origin: [f64; 3],
    joint_torque: Vec<f64>,
    complementary_stiffness: Vec<f64>,
    weight_torque: Vec<f64>,
    weight_stiffness: Vec<f64>,
    parameter_jacobian: Vec<f64>,
    /// By the joint differentiated by, column by column.
    hessian: Vec<[f64; 6]>,
}

impl Derivatives {
    /// At a posture under a wrench.
    pub fn at(arm: &Arm, q: &[f64], w: &[f64; 6]) -> Derivatives {
        let n = q.len();
        let real = frames(arm.convention, &table(arm, q, f64::from))[n];
        let mut found = Derivatives {
            jacobian: vec![[0.0; 6]; n],
            rotation: std::array::from_fn(|c| std::array::from_fn(|r| real[r][c])),
            origin: origin(&real),
            joint_torque: vec![0.0; n],
            complementary_stiffness: vec![0.0; n * n],
            weight_torque: vec![0.0; n],
            weight_stiffness: vec![0.0; n * n],
            parameter_jacobian: parameter_jacobian(arm, q),
            hessian: vec![[0.0; 6]; n * n],
        };
        for i in 0..n {
            for j in 0..=i {
                found.second(arm, q, w, [j, i]);
            }
        }
        found
    }

    /// What an output must be; `None` where it is no derivative of the kinematics.
    pub fn of(&self, output: Output) -> Option<Vec<f64>> {
        Some(match output {
            Output::Jacobian => self.jacobian.concat(),
            Output::JacobianTool => {
                let along = |t: &[f64]| self.rotation.map(|axis| dot(&axis, t));
                let turned = |t: &[f64; 6]| [along(&t[..3]), along(&t[3..])].concat();
                self.jacobian.iter().flat_map(turned).collect()
            }
            Output::JacobianSpatial => {
                let [x, y, z] = self.origin;
                let moved = |t: &[f64; 6]| {
                    let [a, b, c] = [t[3], t[4], t[5]];
                    [t[0] + y * c - z * b, t[1] + z * a - x * c, t[2] + x * b - y * a, a, b, c]
                };
                self.jacobian.iter().flat_map(moved).collect()
            }
            Output::JointTorque => self.joint_torque.clone(),
            Output::ComplementaryStiffness => self.complementary_stiffness.clone(),
            Output::WeightTorque => self.weight_torque.clone(),
            Output::WeightStiffness => self.weight_stiffness.clone(),
            Output::ParameterJacobian => self.parameter_jacobian.clone(),
            Output::Hessian => self.hessian.concat(),
            _ => return None,
        })
    }

    /// Derivatives by the joints j and i, j ≤ i.
    fn second(&mut self, arm: &Arm, q: &[f64], w: &[f64; 6], [j, i]: [usize; 2]) {
        let n = q.len();
        let mut table = table(arm, q, HyperDual64::from);
        for (joint, first) in [(j, true), (i, false)] {
            let cell = &mut table.rows[joint][moving(&arm.joints[joint])];
            *(if first { &mut cell.eps1 } else { &mut cell.eps2 }) = 1.0;
        }
        let frames = frames(arm.convention, &table);
        let tool = &frames[n];
        let part = |of: fn(&HyperDual64) -> f64| tool.map(|row| row.map(|x| of(&x)));
        let (r, by_j, by_i) = (part(|x| x.re), part(|x| x.eps1), part(|x| x.eps2));
        let both = part(|x| x.eps1eps2);
        // How the column of joint `of` changes by joint `by`: ∂²p and vee(∂²R Rᵀ + ∂_of R (∂_by R)ᵀ). K_C is that
        // times the wrench, at row `of`, column `by`.
        let curved = origin(&both);
        for ([of, by], [of_slope, by_slope]) in [([j, i], [&by_j, &by_i]), ([i, j], [&by_i, &by_j])]
        {
            let (own, cross) = (vee(&both, &r), vee(of_slope, by_slope));
            let spin: [f64; 3] = std::array::from_fn(|k| own[k] + cross[k]);
            let column = [curved[0], curved[1], curved[2], spin[0], spin[1], spin[2]];
            self.hessian[by * n + of] = column;
            self.complementary_stiffness[by * n + of] = dot(&column, w);
        }
        let energy = energy(arm, &frames);
        self.weight_stiffness[i * n + j] = energy.eps1eps2;
        self.weight_stiffness[j * n + i] = energy.eps1eps2;
        if i == j {
            let (p, spin) = (origin(&by_j), vee(&by_j, &r));
            let twist = [p[0], p[1], p[2], spin[0], spin[1], spin[2]];
            self.joint_torque[j] = dot(&twist, w);
            self.jacobian[j] = twist;
            self.weight_torque[j] = energy.eps1;
        }
    }
}

fn parameter_jacobian(arm: &Arm, q: &[f64]) -> Vec<f64> {
    let n = q.len();
    let mut table = table(arm, q, Dual64::from);
    let mut columns = Vec::with_capacity(6 * (4 * n + 6));
    for k in 0..4 * n + 6 {
        let seed = |table: &mut Table<Dual64>, slope| match k.checked_sub(4 * n) {
            None => table.rows[k / 4][k % 4].eps = slope,
            Some(entry) => table.tool[entry].eps = slope,
        };
        seed(&mut table, 1.0);
        let tool = frames(arm.convention, &table)[n];
        seed(&mut table, 0.0);
        let (r, by) = (tool.map(|row| row.map(|x| x.re)), tool.map(|row| row.map(|x| x.eps)));
        columns.extend(origin(&by));
        columns.extend(vee(&by, &r));
    }
    columns
}

/// The table at joint values that `number` makes numbers of.
pub(super) fn table<Q: Copy, T: Number>(arm: &Arm, q: &[Q], number: impl Fn(Q) -> T) -> Table<T> {
    let rows = arm.joints.iter().zip(q).map(|(joint, q)| {
        let mut row = [joint.theta, joint.d, joint.a, joint.alpha].map(T::from);
        row[moving(joint)] += number(*q);
        row
    });
    let (shift, turn) = (arm.tool.translation.vector, arm.tool_rotation_vector);
    let tool = [shift.x, shift.y, shift.z, turn.x, turn.y, turn.z].map(T::from);
    let tilts = arm.joints.iter().map(|joint| T::from(joint.beta));
    let stands = arm.base.to_homogeneous();
    let base = std::array::from_fn(|r| std::array::from_fn(|c| T::from(stands[(r, c)])));
    Table { rows: rows.collect(), tilts: tilts.collect(), base, tool }
}

/// The cell of a row that its joint moves.
pub(super) fn moving(joint: &Joint) -> usize {
    match joint.motion {
        Motion::Revolute => 0,
        Motion::Prismatic => 1,
    }
}

/// Frames 1 to n, and the tool's frame after them.
pub(super) fn frames<T: Number>(convention: Convention, table: &Table<T>) -> Vec<Frame<T>> {
    let mut frames = Vec::with_capacity(table.rows.len() + 1);
    let mut frame = table.base;
    for ([theta, d, a, alpha], beta) in table.rows.iter().zip(&table.tilts) {
        let about_z = along(turn(*theta, [0, 1]), 2, *d);
        let inclined = product(&turn(*alpha, [1, 2]), &turn(*beta, [2, 0]));
        let slid = along(identity(), 0, *a);
        let (first, second) = match convention {
            Convention::Standard => (about_z, product(&slid, &inclined)),
            Convention::Modified => (product(&inclined, &slid), about_z),
        };
        frame = product(&product(&frame, &first), &second);
        frames.push(frame);
    }
    let [x, y, z, spin @ ..] = table.tool;
    let mut tool = exponential(spin);
    tool[0][3] = x;
    tool[1][3] = y;
    tool[2][3] = z;
    frames.push(product(&frame, &tool));
    frames
}

fn identity<T: Number>() -> Frame<T> {
    std::array::from_fn(|r| std::array::from_fn(|c| T::from(if r == c { 1.0 } else { 0.0 })))
}

/// A turn from one axis to another.
fn turn<T: Number>(angle: T, [from, to]: [usize; 2]) -> Frame<T> {
    let (s, c) = angle.sin_cos();
    let mut frame = identity();
    frame[from][from] = c;
    frame[to][to] = c;
    frame[from][to] = -s;
    frame[to][from] = s;
    frame
}

fn along<T: Number>(mut frame: Frame<T>, axis: usize, by: T) -> Frame<T> {
    frame[axis][3] = by;
    frame
}

fn product<T: Number>(a: &Frame<T>, b: &Frame<T>) -> Frame<T> {
    std::array::from_fn(|r| {
        std::array::from_fn(|c| {
            let own = if c == 3 { a[r][3] } else { T::from(0.0) };
            own + a[r][0] * b[0][c] + a[r][1] * b[1][c] + a[r][2] * b[2][c]
        })
    })
}

/// The rotation of a rotation vector, `exp [v]×`: the series of a sixteenth, squared four times.
fn exponential<T: Number>(v: [T; 3]) -> Frame<T> {
    let [x, y, z] = v.map(|x| x * (1.0 / 16.0));
    let zero = T::from(0.0);
    let skew = [[zero, -z, y, zero], [z, zero, -x, zero], [-y, x, zero, zero]];
    let mut sum = identity();
    let mut power = identity();
    for k in 1..16 {
        power = product(&power, &skew).map(|row| row.map(|x| x * (1.0 / f64::from(k))));
        sum = std::array::from_fn(|r| std::array::from_fn(|c| sum[r][c] + power[r][c]));
    }
    (0..4).fold(sum, |turn, _| product(&turn, &turn))
}

/// `Σ m g · c`: its slope by a joint value is what the weights do to the joint.
fn energy<T: Number>(arm: &Arm, frames: &[Frame<T>]) -> T {
    let g: [f64; 3] = (arm.base.rotation * arm.gravity).into();
    let mut energy = T::from(0.0);
    let mut last: [T; 3] = arm.base.translation.vector.map(T::from).into();
    for (joint, frame) in arm.joints.iter().zip(frames) {
        let here = origin(frame);
        let beam = joint.beam.as_ref().filter(|_| joint.motion == Motion::Revolute);
        let weight = beam.map_or(0.0, |b| b.density * b.area * joint.a.hypot(joint.d));
        for k in 0..3 {
            let com = (0..3).fold(here[k], |sum, c| sum + frame[k][c] * joint.com[c]);
            // A straight beam's centre is midway between the two origins.
            energy += com * (joint.mass * g[k]) + (here[k] + last[k]) * (weight * g[k] / 2.0);
        }
        last = here;
    }
    energy
}

pub(super) fn origin<T: Copy>(frame: &Frame<T>) -> [T; 3] {
    frame.map(|row| row[3])
}

/// The vector of the skew part of `a bᵀ`.
fn vee(a: &Frame<f64>, b: &Frame<f64>) -> [f64; 3] {
    let entry = |r: usize, c: usize| dot(&a[r][..3], &b[c][..3]);
    let skew = |r, c| (entry(r, c) - entry(c, r)) / 2.0;
    [skew(2, 1), skew(0, 2), skew(1, 0)]
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
