//! The loop of computed torques against the textbook's arm, simulated likewise, and against the errors' own equation.

use nalgebra::DVector;
use stiffarm_firmware_arms::Real;
use stiffarm_firmware_arms::path::{self, N};
use stiffarm_firmware_arms::robots::ur10_moving::Robot;
use stiffarm_firmware_arms::swing::{ASIDE, FADING, Moved, PERIODS, run};
use stiffarm_kernels::generic::Arm;
use textbook::textbook;

mod textbook;

/// What the loop does, period by period.
fn swing<S: Real + Into<f64>>(periods: u32) -> Vec<Moved<f64>> {
    let mut found = Vec::new();
    run::<S>(periods, |moved| {
        found.push(moved.expect("every joint moves some mass").map(|row| row.map(Into::into)));
    });
    assert_eq!(found.len(), periods as usize);
    found
}

/// The same by the textbook: its inverse dynamics from the recursion in base axes, its accelerations by Cholesky.
fn by_the_textbook() -> Vec<Moved<f64>> {
    let arm = textbook(&Robot, include_str!("../../../../robots/arms/ur10.toml"));
    let period = 1.0 / f64::from(PERIODS);
    let rate = f64::from(FADING);
    let column = |x: [f64; N]| DVector::from_column_slice(&x);
    let mut q = column(path::at(0.0).q) + column(ASIDE.map(|milli| f64::from(milli) / 1e3));
    let mut qd = column(path::at(0.0).qd);
    let period_of = |k: u32| {
        let there = path::at(f64::from(k) * period);
        let wanted = column(there.qdd)
            + 2.0 * rate * (column(there.qd) - &qd)
            + rate * rate * (column(there.q) - &q);
        let torques = arm.inverse_dynamics(q.as_slice(), qd.as_slice(), wanted.as_slice());
        (q, qd) = moved(&arm, &q, &qd, &torques, period);
        [&q, &qd, &torques].map(|x| core::array::from_fn(|j| x[j]))
    };
    (0..PERIODS).map(period_of).collect()
}

/// One step of the classical Runge-Kutta method (Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*,
/// section II.1).
fn moved(
    arm: &Arm,
    q: &DVector<f64>,
    qd: &DVector<f64>,
    torques: &DVector<f64>,
    h: f64,
) -> (DVector<f64>, DVector<f64>) {
    let accelerations = |q: &DVector<f64>, qd: &DVector<f64>| {
        arm.forward_dynamics(q.as_slice(), qd.as_slice(), torques.as_slice()).expect("masses")
    };
    let mut slopes = vec![(qd.clone(), accelerations(q, qd))];
    for step in [h / 2.0, h / 2.0, h] {
        let (v, a) = &slopes[slopes.len() - 1];
        let (q, qd) = (q + step * v, qd + step * a);
        slopes.push((qd.clone(), accelerations(&q, &qd)));
    }
    let (mut q, mut qd) = (q.clone(), qd.clone());
    for ((v, a), weight) in slopes.iter().zip([1.0, 2.0, 2.0, 1.0]) {
        q += h * weight / 6.0 * v;
        qd += h * weight / 6.0 * a;
    }
    (q, qd)
}

/// The most by which joint values differ, rad.
fn apart(found: &[Moved<f64>], expected: &[Moved<f64>]) -> f64 {
    let values = |moved: &[Moved<f64>]| moved.iter().flat_map(|m| m[0]).collect::<Vec<_>>();
    let pairs = values(found).into_iter().zip(values(expected));
    pairs.map(|(a, b)| f64::abs(a - b)).fold(0.0, f64::max)
}

/// Angles below 4 rad round by 2^-52 at most each period, in double precision, and torques by some thousand times as
/// much of accelerations below 100 rad/s²; the loop forgets both within 1/10 s, a hundred periods. In single precision
/// the same with 2^-23, where the angle's own rounding leads.
#[test]
fn the_arm_moves_as_the_textbook_s_does() {
    let expected = by_the_textbook();
    let double = apart(&swing::<f64>(PERIODS), &expected);
    assert!(double < 100.0 * 2f64.powi(-52), "{double:e} rad");
    let single = apart(&swing::<f32>(PERIODS), &expected);
    assert!(single < 100.0 * 2f64.powi(-23), "{single:e} rad");
    assert!(single > 2f64.powi(-24), "{single:e} rad is too good for single precision");
}

/// The most by which the errors are off `ë + K_d ė + K_p e = 0`, whose solution from rest is `e_0 (1 + ω t) exp(−ω t)`.
fn off(periods: u32) -> f64 {
    let rate = f64::from(FADING);
    let mut most: f64 = 0.0;
    for (k, [q, ..]) in swing::<f64>(periods).iter().enumerate() {
        let t = (k + 1) as f64 / f64::from(periods);
        let there = path::at(t).q;
        for j in 0..N {
            let expected = f64::from(ASIDE[j]) / 1e3 * (1.0 + rate * t) * (-rate * t).exp();
            most = most.max((q[j] - there[j] - expected).abs());
        }
    }
    most
}

/// Motors that hold their torques for a period are half a period late: what the loop is off is of first order in the
/// period.
#[test]
fn errors_fade_as_the_gains_say() {
    let [coarse, fine] = [off(PERIODS), off(2 * PERIODS)];
    assert!(coarse < 5e-3, "{coarse:e} rad");
    assert!((1.9..2.1).contains(&(coarse / fine)), "{coarse:e} and {fine:e} rad");
}
