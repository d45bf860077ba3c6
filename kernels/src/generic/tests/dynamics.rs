//! The equations of motion against each other and against the energy of the arm.

use std::vec::Vec;

use nalgebra::DVector;

use super::support::{STEP, cases, difference_tolerance, state};
use crate::Output;
use crate::generic::{Arm, Drive};

/// Sums of some hundred terms of like size: 1e-12 of the largest.
fn near(a: &DVector<f64>, b: &DVector<f64>, scale: f64) {
    assert!((a - b).amax() <= 1e-12 * scale, "{a} {b}");
}

/// Joint values, rates and accelerations.
fn motions() -> impl Iterator<Item = (Arm, [Vec<f64>; 3])> {
    cases().map(|(arm, q, _)| {
        let all = state(Output::InverseDynamics, &q);
        let part = |k: usize| all[k * q.len()..(k + 1) * q.len()].to_vec();
        (arm, [part(0), part(1), part(2)])
    })
}

#[test]
fn the_torque_is_that_of_the_mass_matrix_and_the_bias() {
    for (arm, [q, rates, accelerations]) in motions() {
        let torque = arm.inverse_dynamics(&q, &rates, &accelerations);
        let (mass, bias) = (arm.mass_matrix(&q), arm.bias(&q, &rates));
        let moved = &mass * DVector::from_column_slice(&accelerations);
        near(&torque, &(&moved + &bias), torque.amax() + moved.amax() + bias.amax());
        assert!((&mass - mass.transpose()).amax() <= 1e-12 * mass.amax());
        // What is left of the solve is relative to the least moment.
        let back = arm.forward_dynamics(&q, &rates, torque.as_slice()).unwrap();
        let moments = mass.symmetric_eigenvalues();
        let scale = (torque.amax() + bias.amax() + moved.amax()) / moments.min();
        near(&back, &DVector::from_column_slice(&accelerations), scale);
    }
}

/// At rest the motors hold what the weights do.
#[test]
fn at_rest_the_bias_holds_the_weights() {
    for (arm, q, _) in cases() {
        let held = arm.bias(&q, &std::vec![0.0; q.len()]);
        let weights = arm.weight_torque(&q);
        near(&held, &-&weights, weights.amax().max(1.0) * 10.0);
    }
}

#[test]
fn the_regressor_times_the_moments_is_the_torque() {
    for (mut arm, [q, rates, accelerations]) in motions() {
        for joint in &mut arm.joints {
            (joint.drive, joint.beam) = (Drive::default(), None);
        }
        let moments = DVector::from_vec(arm.moments());
        let regressor = arm.torque_regressor(&q, &rates, &accelerations);
        let torque = arm.inverse_dynamics(&q, &rates, &accelerations);
        near(&(&regressor * &moments), &torque, regressor.amax() * moments.amax());
    }
}

/// Without friction what the motors do becomes energy: `d/dt (q̇ᵀ M q̇/2 + V) = τ · q̇`, with the weights'
/// torque for `−∂V/∂q`, by central differences along the motion.
#[test]
fn the_power_of_the_motors_becomes_energy() {
    for (mut arm, [q, rates, accelerations]) in motions() {
        for joint in &mut arm.joints {
            (joint.drive.coulomb, joint.drive.viscous) = (0.0, 0.0);
        }
        let along = |t: f64| -> (Vec<f64>, DVector<f64>) {
            let at = |k: usize| q[k] + rates[k] * t + accelerations[k] * t * t / 2.0;
            let rate = |k: usize| rates[k] + accelerations[k] * t;
            ((0..q.len()).map(at).collect(), DVector::from_fn(q.len(), |k, _| rate(k)))
        };
        let kinetic = |t: f64| {
            let (q, rates) = along(t);
            rates.dot(&(arm.mass_matrix(&q) * &rates)) / 2.0
        };
        let rates = DVector::from_column_slice(&rates);
        let gained = (kinetic(STEP) - kinetic(-STEP)) / (2.0 * STEP);
        let lifted = -arm.weight_torque(&q).dot(&rates);
        let torque = arm.inverse_dynamics(&q, rates.as_slice(), &accelerations);
        // The third derivative by time is that of the motion cubed.
        let fast = 1.0 + rates.amax() + accelerations.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let scale = (kinetic(0.0).abs() + torque.norm() * rates.norm() + 1.0) * fast.powi(3);
        assert!((gained + lifted - torque.dot(&rates)).abs() <= difference_tolerance(scale));
    }
}
