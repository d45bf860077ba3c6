//! Plans against every exchange of one test.

use nalgebra::{DMatrix, Vector6};

use super::plans::{design, kr240, plan, separate};
use super::{Plan, Purpose};
use crate::whole::Whole;

/// No exchange of one test for another is better: by brute force, on determinants of matrices put
/// together here. The deviations that are expected are those of `(BᵀB)⁻¹` (Dumas et al., eqs. 21 to 26).
#[test]
fn no_single_exchange_is_better() {
    let arm = kr240();
    let plan = Plan { count: 4, ..plan(Purpose::Identify) };
    let found = design(&arm, &plan).unwrap();
    let pool = super::candidates::draw(Whole::from(&arm), &plan).unwrap();
    let blocks =
        super::candidates::blocks(Whole::from(&arm), &plan, &pool.postures, false).unwrap();
    let information = |tests: &[(&[f64], Vector6<f64>)]| {
        let mut sum = DMatrix::<f64>::zeros(6, 6);
        for (q, wrench) in tests {
            let b = arm.compliance_regressor(q, wrench).fixed_rows::<3>(0).into_owned();
            // Of the difference of two readings.
            sum += b.transpose() * &b / (2.0 * plan.noise_position.powi(2));
        }
        sum
    };
    let own: Vec<(&[f64], Vector6<f64>)> =
        found.tests.iter().map(|t| (t.q.as_slice(), t.wrench)).collect();
    let best = information(&own);
    let covariance = best.clone().try_inverse().unwrap();
    for (k, expected) in found.expected.iter().enumerate() {
        let deviation = covariance[(k, k)].sqrt();
        assert!((deviation / expected.compliance.unwrap() - 1.0).abs() < 1e-4, "{expected:?}");
    }
    assert!(found.efficiency > 1.5, "{}", found.efficiency);
    let best = best.determinant();
    for slot in 0..4 {
        for block in &blocks {
            let q = pool.postures[block.posture].q.as_slice();
            if own.iter().any(|(other, _)| *other == q) {
                continue;
            }
            let mut tests = own.clone();
            tests[slot] = (q, plan.loads[block.load]);
            // Gains of less than a millionth of the logarithm are not taken, and what is assumed
            // to be known before changes each pivot by a millionth.
            assert!(information(&tests).determinant() <= best * (1.0 + 1e-4));
        }
    }
}

/// No other test in the place of one is better, by brute force on the two that are left of each.
#[test]
fn no_single_exchange_tells_more() {
    let arm = kr240();
    let plan = Plan { count: 3, ..separate(&arm, ["joint_compliance@joint 2", "wrench_scale"]) };
    let found = design(&arm, &plan).unwrap();
    let Purpose::Separate(pair) = &plan.purpose else { unreachable!() };
    let pool = super::candidates::draw(Whole::from(&arm), &plan).unwrap();
    let apart = super::Apart::new(Whole::from(&arm), &plan, pair, &pool.postures).unwrap();
    let product = |tests: &[usize]| {
        let rows: Vec<_> = tests.iter().map(|&k| apart.blocks[k].rows.clone()).collect();
        let sum = rows.iter().fold(DMatrix::zeros(2, 2), |sum, b| sum + b.transpose() * b);
        let shared = sum[(0, 1)] * sum[(1, 0)];
        (sum[(0, 0)] - shared / sum[(1, 1)]) * (sum[(1, 1)] - shared / sum[(0, 0)])
    };
    let same = |k: &usize, test: &super::Planned| {
        let block = &apart.blocks[*k];
        pool.postures[block.posture].q == test.q && plan.loads[block.load] == test.wrench
    };
    let all = 0..apart.blocks.len();
    let own: Vec<usize> =
        found.tests.iter().map(|t| all.clone().find(|k| same(k, t)).unwrap()).collect();
    let best = product(&own);
    for slot in 0..3 {
        for k in all.clone() {
            let used =
                |slot_of: usize| apart.blocks[own[slot_of]].posture == apart.blocks[k].posture;
            if (0..3).any(|other| other != slot && used(other)) {
                continue;
            }
            let mut tests = own.clone();
            tests[slot] = k;
            assert!(product(&tests) <= best * (1.0 + 1e-4));
        }
    }
}
