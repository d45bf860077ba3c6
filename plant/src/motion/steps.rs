//! What steps make of a motion: how they converge, and what becomes of the energy.

use nalgebra::DVector;
use stiffarm_kernels::generic::Arm;

use super::machine::Machine;
use crate::fixture::geared;

/// Torques of the motors: joints go to and fro, and one stands for a while.
fn torques(t: f64) -> [f64; 3] {
    [9.0 * (5.0 * t).sin(), 20.0 + 12.0 * (4.0 * t).cos(), 6.0 * (7.0 * t).sin()]
}

/// Joint values at the end of a second of steps, and what the balance of energy is off by, J: the kinetic energy
/// less what motors gave and weights and friction took, by the textbook's masses and weights.
fn driven(arm: &Arm, steps: usize) -> (DVector<f64>, f64) {
    let step = 1.0 / steps as f64;
    let machine = Machine::new(arm, &[], step).unwrap();
    let mut now = machine.at(&[0.3, -0.4, 0.2], &[0.5, 0.0, -0.3]);
    let mut given = 0.0;
    let energy = |q: &[f64], v: &DVector<f64>| 0.5 * v.dot(&(arm.mass_matrix(q) * v));
    let mut between = Vec::new();
    for k in 0..steps {
        let torques = torques(k as f64 * step);
        let before = DVector::from_column_slice(&now.qd);
        let q = now.q.clone();
        let qdd = machine.driven(&mut now, &torques).unwrap();
        machine.step(&mut now, &qdd);
        // At the start they are told, later between the steps.
        let after = DVector::from_column_slice(&now.qd);
        let rates = if k == 0 { before } else { 0.5 * (before + after) };
        between.push(energy(&q, &rates));
        if k == 0 || k + 1 == steps {
            // Half of the first and last instants lies outside.
            given -= 0.5 * step * power(arm, &q, &rates, &torques);
        }
        given += step * power(arm, &q, &rates, &torques);
    }
    (DVector::from_vec(now.q), between[steps - 1] - between[0] - given)
}

fn power(arm: &Arm, q: &[f64], rates: &DVector<f64>, torques: &[f64]) -> f64 {
    let drives = arm.joints.iter().map(|joint| &joint.drive);
    let friction = drives.zip(rates).map(|(d, v)| d.coulomb * v.signum() + d.viscous * v);
    let weights = arm.weight_torque(q);
    let left = torques.iter().zip(&weights).zip(friction).map(|((t, w), f)| t + w - f);
    left.zip(rates).map(|(torque, v)| torque * v).sum()
}

/// Of the second order, though joints turn round, stand and are let go.
#[test]
fn errors_go_with_the_square_of_the_step() {
    let arm = geared();
    let (exact, _) = driven(&arm, stiffarm_draws::few_or_many(16_000, 64_000));
    let runs = [500, 1000, 2000, 4000].map(|steps| {
        let (q, balance) = driven(&arm, steps);
        ((q - &exact).amax(), balance.abs())
    });
    // An eighth of the step: an eighth of the error were it of the first order, a sixty-fourth of the second;
    // what turns round now falls early in a step, now late.
    assert!(runs[3].0 < runs[0].0 / 20.0 && runs[3].1 < runs[0].1 / 20.0, "{runs:?}");
}
