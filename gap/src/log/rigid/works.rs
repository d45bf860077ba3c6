//! The regressor of the torques for logs of a million samples: what each moment of mass asks of each joint is the work
//! that its force and moment do on the joint's twist, all told in the link's own axes.
//!
//! The same numbers as [`Arm::torque_regressor`], with less to do: what a row does at zero is computed once, and no unit of
//! the ten numbers is turned into the base's axes.

use nalgebra::{Matrix3, Vector3};
use stiffarm_kernels::generic::Arm;
use stiffarm_kernels::{Convention, Motion};

/// An arm as its links move.
pub struct Works {
    convention: Convention,
    rows: Vec<Row>,
    /// What every link falls with, base axes, m/s².
    gravity: Vector3<f64>,
}

/// A row of the table with its joint at zero.
struct Row {
    motion: Motion,
    turn: Matrix3<f64>,
    shift: Vector3<f64>,
}

/// What a joint moves along or about, base axes.
struct Axis {
    motion: Motion,
    direction: Vector3<f64>,
    point: Vector3<f64>,
}

/// A frame in the base's axes, and how the link moves that it is fixed to.
struct Link {
    turn: Matrix3<f64>,
    origin: Vector3<f64>,
    spin: Vector3<f64>,
    spin_rate: Vector3<f64>,
    /// Of the frame's origin, with gravity in it: a base that is thrown upwards weighs its links down.
    acceleration: Vector3<f64>,
}

impl Works {
    /// Of an arm.
    pub fn of(arm: &Arm) -> Works {
        let frames = arm.frames(&vec![0.0; arm.dof()]);
        let row = |(pair, joint): (&[nalgebra::Isometry3<f64>], _)| {
            let step = pair[0].inv_mul(&pair[1]);
            let joint: &stiffarm_kernels::generic::Joint = joint;
            Row {
                motion: joint.motion,
                turn: step.rotation.to_rotation_matrix().into_inner(),
                shift: step.translation.vector,
            }
        };
        let rows = frames.windows(2).zip(&arm.joints).map(row).collect();
        Works { convention: arm.convention, rows, gravity: arm.gravity }
    }

    /// n×10n, column by column: `asks[10 n k + n c + j]` is what number c of link k asks of joint j, and 0 of a joint
    /// that does not move the link.
    pub fn regressor(&self, motion: [&[f64]; 3], asks: &mut [f64]) {
        let n = self.rows.len();
        let mut axes = Vec::with_capacity(n);
        let mut link = Link::base(&self.gravity);
        for (k, row) in self.rows.iter().enumerate() {
            axes.push(link.go(row, self.convention, motion.map(|of| of[k])));
            let own = &mut asks[10 * n * k..10 * n * (k + 1)];
            for (j, axis) in axes.iter().enumerate() {
                let works = link.works(axis);
                own[j..].iter_mut().step_by(n).zip(works).for_each(|(to, work)| *to = work);
            }
        }
    }
}

impl Works {
    /// What links of these numbers, ten each, ask of the joints in a motion.
    pub fn torques(&self, motion: [&[f64]; 3], numbers: &[f64]) -> Vec<f64> {
        let mut link = Link::base(&self.gravity);
        let mut axes = Vec::with_capacity(self.rows.len());
        let mut torques = vec![0.0; self.rows.len()];
        for (k, row) in self.rows.iter().enumerate() {
            axes.push(link.go(row, self.convention, motion.map(|of| of[k])));
            let (force, moment) = link.asks(&numbers[10 * k..10 * k + 10]);
            for (axis, torque) in axes.iter().zip(&mut torques) {
                *torque += match axis.motion {
                    Motion::Prismatic => axis.direction.dot(&force),
                    Motion::Revolute => {
                        let lever = link.origin - axis.point;
                        axis.direction.dot(&(moment + lever.cross(&force)))
                    }
                };
            }
        }
        torques
    }
}

impl Link {
    /// What does not move, and is thrown against gravity.
    fn base(gravity: &Vector3<f64>) -> Link {
        Link {
            turn: Matrix3::identity(),
            origin: Vector3::zeros(),
            spin: Vector3::zeros(),
            spin_rate: Vector3::zeros(),
            acceleration: -gravity,
        }
    }

    /// The force, and the moment about the frame's origin, that a body of such numbers asks for, base axes.
    fn asks(&self, numbers: &[f64]) -> (Vector3<f64>, Vector3<f64>) {
        let told = |x: &Vector3<f64>| self.turn.tr_mul(x);
        let [w, d, a] = [&self.spin, &self.spin_rate, &self.acceleration].map(told);
        let first = Vector3::new(numbers[1], numbers[2], numbers[3]);
        let tensor = super::tensor(numbers);
        let force = a * numbers[0] + d.cross(&first) + w.cross(&w.cross(&first));
        let moment = first.cross(&a) + tensor * d + w.cross(&(tensor * w));
        (self.turn * force, self.turn * moment)
    }

    /// Goes on to the next row's link, whose joint has this value, rate and acceleration; its axis.
    fn go(
        &mut self,
        row: &Row,
        convention: Convention,
        [value, rate, acceleration]: [f64; 3],
    ) -> Axis {
        let (sin, cos) = if row.motion == Motion::Revolute { value.sin_cos() } else { (0.0, 1.0) };
        let turned = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
        let slide = if row.motion == Motion::Revolute { 0.0 } else { value };
        let slid = Vector3::new(0.0, 0.0, slide);
        // The joint moves about z before the rest of a standard row, and behind the rest of a modified one.
        let (turn, shift, axis) = match convention {
            Convention::Standard => {
                (turned * row.turn, turned * row.shift + slid, (Vector3::z(), Vector3::zeros()))
            }
            Convention::Modified => {
                let z = row.turn.column(2).into_owned();
                let shift = row.shift + z * slide;
                (row.turn * turned, shift, (z, shift))
            }
        };
        let (direction, lever, shift) = (self.turn * axis.0, self.turn * axis.1, self.turn * shift);
        let here = self.acceleration_at(&lever);
        self.acceleration = match row.motion {
            Motion::Revolute => {
                self.spin_rate += self.spin.cross(&direction) * rate + direction * acceleration;
                self.spin += direction * rate;
                here
            }
            Motion::Prismatic => {
                here + 2.0 * self.spin.cross(&direction) * rate + direction * acceleration
            }
        };
        self.acceleration = self.acceleration_at(&(shift - lever));
        let point = self.origin + lever;
        self.origin += shift;
        self.turn *= turn;
        Axis { motion: row.motion, direction, point }
    }

    /// The acceleration of the point that is so far from the one that has the link's.
    fn acceleration_at(&self, lever: &Vector3<f64>) -> Vector3<f64> {
        let about = self.spin_rate.cross(lever) + self.spin.cross(&self.spin.cross(lever));
        self.acceleration + about
    }

    /// What a unit of mass, first moments and tensor asks of a joint that moves the link: the work of
    /// `m a + ω̇ × h + ω × (ω × h)` and `h × a + I ω̇ + ω × I ω` on its velocity `v` and spin `u`.
    fn works(&self, axis: &Axis) -> [f64; 10] {
        let told = |x: &Vector3<f64>| self.turn.tr_mul(x);
        let [w, d, a] = [&self.spin, &self.spin_rate, &self.acceleration].map(told);
        let (v, u) = match axis.motion {
            Motion::Revolute => {
                let lever = self.origin - axis.point;
                (told(&axis.direction.cross(&lever)), told(&axis.direction))
            }
            Motion::Prismatic => (told(&axis.direction), Vector3::zeros()),
        };
        // v · (ω̇ × h + ω × (ω × h)) + u · (h × a), in h.
        let first = v.cross(&d) + w * w.dot(&v) - v * w.norm_squared() + a.cross(&u);
        // u · (I ω̇ + ω × I ω) = u · I ω̇ + (u × ω) · I ω.
        let c = u.cross(&w);
        let twice = |i: usize, j: usize| u[i] * d[j] + c[i] * w[j];
        let both = |i: usize, j: usize| twice(i, j) + twice(j, i);
        [
            v.dot(&a),
            first.x,
            first.y,
            first.z,
            twice(0, 0),
            both(0, 1),
            twice(1, 1),
            both(0, 2),
            both(1, 2),
            twice(2, 2),
        ]
    }
}
