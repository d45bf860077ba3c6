//! The equations of motion `M(q) q̈ + b(q, q̇) = τ`.
//!
//! * Luh, Walker, Paul: *On-line computational scheme for mechanical manipulators*, ASME J. Dynamic Systems,
//!   Measurement, and Control 102 (1980): the recursion of Newton and Euler; Craig, *Introduction to
//!   Robotics*, section 6.5, prints it link by link.
//! * Walker, Orin: *Efficient dynamic computer simulation of robotic mechanisms*, ibid. 104 (1982): what is
//!   not the mass matrix is the torque without acceleration.
//!
//! Vectors stand in base axes throughout. A motor's rotor turns `gear` times as fast as its joint, and of its
//! inertia only what that speed makes is counted, `gear² J q̈` (its gyroscopic moment is not). Friction is
//! `coulomb · sign(q̇) + viscous · q̇` at the joint, and none of the dry part at rest: sign(0) = 0. A beam counts
//! as a thin rod of its mass.

use std::vec::Vec;

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::arm::Arm;
use super::kinematics::{Axis, origin};
use super::textbook::{Textbook, block};
use super::weight::Weight;
use crate::{Motion, Output, Unstable};

/// The outputs of this file.
pub(super) const TEXTBOOK: &[(Output, Textbook)] = &[
    (Output::InverseDynamics, |arm, state, _| {
        let [q, rates, accelerations] = parts(arm, state);
        Ok(block(arm.inverse_dynamics(q, rates, accelerations)))
    }),
    (Output::Bias, |arm, state, _| {
        let [q, rates] = parts(arm, state);
        Ok(block(arm.bias(q, rates)))
    }),
    (Output::MassMatrix, |arm, q, _| Ok(block(arm.mass_matrix(q)))),
    (Output::ForwardDynamics, |arm, state, _| {
        let [q, rates, torques] = parts(arm, state);
        Ok(block(arm.forward_dynamics(q, rates, torques)?))
    }),
    (Output::TorqueRegressor, |arm, state, _| {
        let [q, rates, accelerations] = parts(arm, state);
        Ok(block(arm.torque_regressor(q, rates, accelerations)))
    }),
];

/// A state as the joint values and what stands behind them.
pub(super) fn parts<'s, const K: usize>(arm: &Arm, state: &'s [f64]) -> [&'s [f64]; K] {
    assert_eq!(state.len(), K * arm.dof(), "{K} numbers for each of the arm's joints");
    core::array::from_fn(|k| &state[k * arm.dof()..(k + 1) * arm.dof()])
}

/// Below this part of its largest an eigenvalue of the mass matrix is no more than what rounding has left of a zero.
const SINGULAR: f64 = 1e-13;

/// How a link moves.
#[derive(Clone, Copy)]
struct Moving {
    /// rad/s.
    spin: Vector3<f64>,
    /// rad/s².
    spin_rate: Vector3<f64>,
    /// A point of the link, m, and that point's acceleration, m/s².
    point: Vector3<f64>,
    acceleration: Vector3<f64>,
}

impl Moving {
    /// The acceleration of the link's point that is at `p`.
    fn acceleration_at(&self, p: &Vector3<f64>) -> Vector3<f64> {
        let arm = p - self.point;
        self.acceleration + self.spin_rate.cross(&arm) + self.spin.cross(&self.spin.cross(&arm))
    }

    /// The next link's, behind a joint (Luh et al., eqs. 6 to 12; Craig, eqs. 6.45 to 6.48).
    fn behind(&self, axis: &Axis, rate: f64, acceleration: f64) -> Moving {
        let z = axis.direction;
        let here =
            Moving { acceleration: self.acceleration_at(&axis.point), point: axis.point, ..*self };
        match axis.motion {
            Motion::Revolute => Moving {
                spin: self.spin + z * rate,
                spin_rate: self.spin_rate + self.spin.cross(&z) * rate + z * acceleration,
                ..here
            },
            Motion::Prismatic => Moving {
                acceleration: here.acceleration
                    + 2.0 * self.spin.cross(&z) * rate
                    + z * acceleration,
                ..here
            },
        }
    }
}

impl Arm {
    /// `τ(q, q̇, q̈)`, n, N·m (N if prismatic): what the motors give for a motion, at the joints.
    pub fn inverse_dynamics(
        &self,
        q: &[f64],
        rates: &[f64],
        accelerations: &[f64],
    ) -> DVector<f64> {
        let (axes, bodies) = (self.axes(q), self.weights(q));
        let links = self.moving(q, rates, accelerations);
        let load = |(k, link): (usize, &Moving)| {
            inertial(link, bodies.iter().filter(|body| body.moved_by == k + 1))
        };
        let loads: Vec<_> = links.iter().enumerate().map(load).collect();
        // Inwards: what a link and all beyond it need, as a force and the moment about the origin.
        let mut torque = DVector::zeros(self.dof());
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for (k, axis) in axes.iter().enumerate().rev() {
            force += loads[k].0;
            moment += loads[k].1;
            let drive = &self.joints[k].drive;
            let about_axis = moment - axis.point.cross(&force);
            let load = match axis.motion {
                Motion::Revolute => axis.direction.dot(&about_axis),
                Motion::Prismatic => axis.direction.dot(&force),
            };
            let rotor = drive.gear * drive.gear * drive.rotor_inertia * accelerations[k];
            let dry = if rates[k] == 0.0 { 0.0 } else { drive.coulomb * rates[k].signum() };
            torque[k] = load + rotor + dry + drive.viscous * rates[k];
        }
        torque
    }

    /// How links 1 to n move.
    fn moving(&self, q: &[f64], rates: &[f64], accelerations: &[f64]) -> Vec<Moving> {
        // A base that is thrown upwards weighs its links down.
        let mut link = Moving {
            spin: Vector3::zeros(),
            spin_rate: Vector3::zeros(),
            point: Vector3::zeros(),
            acceleration: -self.falling(),
        };
        let axes = self.axes(q);
        let each = axes.iter().zip(rates.iter().zip(accelerations));
        each.map(|(axis, (rate, acceleration))| {
            link = link.behind(axis, *rate, *acceleration);
            link
        })
        .collect()
    }

    /// `∂τ/∂π`, n×10n, of each link the mass, the first moments and the entries xx, xy, yy, xz, yz, zz of the tensor of
    /// inertia about the origin of its row's frame, in that frame's axes. What a link needs to move as it does
    /// is linear in them: `m a + ω̇ × h + ω × (ω × h)` and `h × a + I ω̇ + ω × I ω` about that origin.
    pub fn torque_regressor(
        &self,
        q: &[f64],
        rates: &[f64],
        accelerations: &[f64],
    ) -> DMatrix<f64> {
        let (axes, frames, n) = (self.axes(q), self.frames(q), self.dof());
        let mut regressor = DMatrix::zeros(n, 10 * n);
        for (k, link) in self.moving(q, rates, accelerations).iter().enumerate() {
            let (turn, origin) =
                (frames[k + 1].rotation.to_rotation_matrix(), origin(&frames[k + 1]));
            let here = link.acceleration_at(&origin);
            let none = Vector3::zeros();
            let first = |axis: usize| {
                let h = turn * Vector3::ith(axis, 1.0);
                let (w, wd) = (link.spin, link.spin_rate);
                (wd.cross(&h) + w.cross(&w.cross(&h)), h.cross(&here))
            };
            let second = |i: usize, j: usize| {
                let mut tensor = Matrix3::zeros();
                (tensor[(i, j)], tensor[(j, i)]) = (1.0, 1.0);
                let tensor = turn * tensor * turn.transpose();
                (none, tensor * link.spin_rate + link.spin.cross(&(tensor * link.spin)))
            };
            let loads = [(here, none), first(0), first(1), first(2)]
                .into_iter()
                .chain([(0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2)].map(|(i, j)| second(i, j)));
            for (column, (force, moment)) in loads.enumerate() {
                for (j, axis) in axes[..=k].iter().enumerate() {
                    let work = axis.velocity(&origin).dot(&force) + axis.spin().dot(&moment);
                    regressor[(j, 10 * k + column)] = work;
                }
            }
        }
        regressor
    }

    /// `q̈ = M⁻¹ (τ − b)`, n, rad/s² (m/s² if prismatic), by Cholesky's factors.
    ///
    /// # Errors
    /// [`Unstable`] where M is not positive definite, or so nearly that it cannot be told: a joint moves no mass.
    pub fn forward_dynamics(
        &self,
        q: &[f64],
        rates: &[f64],
        torques: &[f64],
    ) -> Result<DVector<f64>, Unstable> {
        let mass = self.mass_matrix(q);
        let moments = mass.symmetric_eigenvalues();
        let sound = moments.min() > SINGULAR * moments.max();
        let factors = mass.cholesky().filter(|_| sound).ok_or(Unstable)?;
        Ok(factors.solve(&(DVector::from_column_slice(torques) - self.bias(q, rates))))
    }

    /// `b(q, q̇)`, n: what the motors give where no joint accelerates. Centrifugal and Coriolis forces, the
    /// weights, which are `g(q)` by themselves at rest, and friction.
    pub fn bias(&self, q: &[f64], rates: &[f64]) -> DVector<f64> {
        self.inverse_dynamics(q, rates, &std::vec![0.0; self.dof()])
    }

    /// `M(q)`, n×n, by its definition: twice the kinetic energy is `q̇ᵀ M q̇`.
    pub fn mass_matrix(&self, q: &[f64]) -> DMatrix<f64> {
        let (axes, n) = (self.axes(q), self.dof());
        let rotor =
            |k: usize| self.joints[k].drive.gear.powi(2) * self.joints[k].drive.rotor_inertia;
        let mut mass = DMatrix::from_diagonal(&DVector::from_fn(n, |k, _| rotor(k)));
        for body in self.weights(q) {
            for (i, a) in axes[..body.moved_by].iter().enumerate() {
                for (j, b) in axes[..body.moved_by].iter().enumerate() {
                    let moved = a.velocity(&body.centre).dot(&b.velocity(&body.centre));
                    let turned = a.spin().dot(&(body.inertia * b.spin()));
                    mass[(i, j)] += body.mass * moved + turned;
                }
            }
        }
        mass
    }
}

/// What accelerates these bodies of a link: the force, and the moment about the origin (Newton and Euler:
/// Luh et al., eqs. 13 and 14; Craig, eqs. 6.49 to 6.52).
fn inertial<'w>(
    link: &Moving,
    bodies: impl Iterator<Item = &'w Weight>,
) -> (Vector3<f64>, Vector3<f64>) {
    bodies.fold((Vector3::zeros(), Vector3::zeros()), |(force, moment), body| {
        let newton = body.mass * link.acceleration_at(&body.centre);
        let momentum = body.inertia * link.spin;
        let euler = body.inertia * link.spin_rate + link.spin.cross(&momentum);
        (force + newton, moment + euler + body.centre.cross(&newton))
    })
}
