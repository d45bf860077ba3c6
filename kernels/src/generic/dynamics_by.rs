//! Derivatives of the inverse dynamics in closed form.
//!
//! Singh, Russell, Wensing: *Efficient analytical derivatives of rigid-body dynamics using spatial vector algebra*,
//! IEEE Robotics and Automation Letters 7(2) (2022). All motions and forces are told at the world's origin, in base
//! axes: a joint's axis S, the rate `Ψ̇ = v × S` and the acceleration `Ψ̈ = a × S + v × Ψ̇` that it is carried with by the
//! link before, and of each joint's link and all beyond as one body the inertia, the force and the matrix B by which
//! the force changes with the velocity.

use std::vec::Vec;

use nalgebra::{DMatrix, Matrix3, Matrix6, Vector3, Vector6};

use super::arm::Arm;
use super::dynamics::parts;
use super::spatial::{blocks, lower, stack, upper, wrench_transport};
use super::textbook::{Textbook, block};
use crate::Output;

/// The outputs of this file.
pub(super) const TEXTBOOK: &[(Output, Textbook)] = &[
    (Output::InverseDynamicsByJoints, |arm, state, _| {
        let [q, rates, accelerations] = parts(arm, state);
        Ok(block(arm.inverse_dynamics_by_joints(q, rates, accelerations)))
    }),
    (Output::InverseDynamicsByRates, |arm, state, _| {
        let [q, rates] = parts(arm, state);
        Ok(block(arm.inverse_dynamics_by_rates(q, rates)))
    }),
];

/// A joint, and its link with all beyond it.
struct Carried {
    axis: Vector6<f64>,
    /// Ψ̇ and Ψ̈.
    rate: Vector6<f64>,
    acceleration: Vector6<f64>,
    inertia: Matrix6<f64>,
    /// B, summed like the inertias.
    by_velocity: Matrix6<f64>,
    force: Vector6<f64>,
}

impl Arm {
    /// `∂τ/∂q`, n×n, row j, column i, of `τ(q, q̇, q̈)`.
    pub fn inverse_dynamics_by_joints(
        &self,
        q: &[f64],
        rates: &[f64],
        accelerations: &[f64],
    ) -> DMatrix<f64> {
        let joints = self.carried(q, rates, accelerations);
        DMatrix::from_fn(self.dof(), self.dof(), |j, i| {
            let (by, outer) = (&joints[i], &joints[i.max(j)]);
            let mut moved = outer.by_velocity * by.rate * 2.0 + outer.inertia * by.acceleration;
            if j < i {
                moved += across_force(&by.axis) * outer.force;
            }
            joints[j].axis.dot(&moved)
        })
    }

    /// `∂τ/∂q̇`, n×n, row j, column i, which no acceleration enters.
    pub fn inverse_dynamics_by_rates(&self, q: &[f64], rates: &[f64]) -> DMatrix<f64> {
        let joints = self.carried(q, rates, &std::vec![0.0; self.dof()]);
        DMatrix::from_fn(self.dof(), self.dof(), |j, i| {
            let (by, outer) = (&joints[i], &joints[i.max(j)]);
            let moved = outer.by_velocity * by.axis + outer.inertia * by.rate;
            let held = if i == j { self.joints[j].drive.viscous } else { 0.0 };
            2.0 * joints[j].axis.dot(&moved) + held
        })
    }

    fn carried(&self, q: &[f64], rates: &[f64], accelerations: &[f64]) -> Vec<Carried> {
        let origin = Vector3::zeros();
        let mut velocity = Vector6::zeros();
        // A base that is thrown upwards weighs its links down.
        let mut acceleration = stack(-self.falling(), origin);
        let mut joints: Vec<Carried> = Vec::with_capacity(self.dof());
        for (k, axis) in self.axes(q).iter().enumerate() {
            let axis = stack(axis.velocity(&origin), axis.spin());
            let rate = across(&velocity) * axis;
            let carried = across(&acceleration) * axis + across(&velocity) * rate;
            velocity += axis * rates[k];
            acceleration += axis * accelerations[k] + rate * rates[k];
            joints.push(Carried {
                axis,
                rate,
                acceleration: carried,
                inertia: Matrix6::zeros(),
                by_velocity: Matrix6::zeros(),
                force: Vector6::zeros(),
            });
            for body in self.weights(q).iter().filter(|body| body.moved_by == k + 1) {
                let at_origin = wrench_transport(&body.centre, &origin);
                let mut own = blocks(&Matrix3::from_diagonal_element(body.mass));
                own.fixed_view_mut::<3, 3>(3, 3).copy_from(&body.inertia);
                let inertia = at_origin * own * at_origin.transpose();
                let momentum = inertia * velocity;
                let force = inertia * acceleration + across_force(&velocity) * momentum;
                let by_velocity = (across_force(&velocity) * inertia - inertia * across(&velocity)
                    + forced(&momentum))
                    / 2.0;
                for inner in &mut joints {
                    inner.inertia += inertia;
                    inner.by_velocity += by_velocity;
                    inner.force += force;
                }
            }
        }
        joints
    }
}

/// `m ×`: how what moves by `m` carries a motion along.
fn across(m: &Vector6<f64>) -> Matrix6<f64> {
    let mut matrix = blocks(&lower(m).cross_matrix());
    matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&upper(m).cross_matrix());
    matrix
}

/// `m ×*`: how it carries a force along.
fn across_force(m: &Vector6<f64>) -> Matrix6<f64> {
    -across(m).transpose()
}

/// `f ×̄*`: the same of a given force, for any motion, `(f ×̄*) m = m ×* f`.
fn forced(f: &Vector6<f64>) -> Matrix6<f64> {
    Matrix6::from_columns(&core::array::from_fn::<_, 6, _>(|k| {
        across_force(&Vector6::ith(k, 1.0)) * f
    }))
}
