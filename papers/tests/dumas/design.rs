//! What a plan of tests promises against what an identification by them finds.

use crate::method::{System, Test, Weighting};
use nalgebra::Vector6;
use stiffarm_gap::dexterity::design::{Plan, Purpose, design};

use super::robot;

/// The deviations promised are those of the least squares, and better than random ones.
#[test]
fn a_plan_says_what_the_identification_will() {
    let mut arm = robot::kr240();
    arm.tool = nalgebra::Isometry3::translation(0.1, 0.0, 0.15);
    let pull = |x: f64, y: f64, z: f64| Vector6::new(x, y, z, 0.0, 0.0, 0.0);
    let plan = Plan {
        count: 8,
        purpose: Purpose::Identify,
        along: vec![],
        loads: vec![pull(0.0, 0.0, -1000.0), pull(1000.0, 0.0, 0.0), pull(0.0, -1000.0, 0.0)],
        noise_position: 3e-5,
        noise_rotation: None,
        seed: 1,
    };
    let found = design(&arm, &plan, &|_| {}).unwrap();
    assert_eq!(found.tests.len(), 8);
    assert!(found.efficiency > 1.5, "{}", found.efficiency);
    let limits: Vec<[f64; 2]> = arm.joints.iter().filter_map(|joint| joint.limits).collect();
    let within = |q: &f64, [low, high]: &[f64; 2]| (low..=high).contains(&q);
    assert!(found.tests.iter().all(|t| t.q.iter().zip(&limits).all(|(q, l)| within(q, l))));
    let tests: Vec<Test> = found
        .tests
        .iter()
        .map(|t| Test {
            q: t.q.clone(),
            wrench: t.wrench,
            displacement: arm.deflection_first_order(&t.q, &t.wrench),
        })
        .collect();
    let weighting = Weighting::Rows { translation: 1.0 / (3e-5 * 2f64.sqrt()), rotation: 0.0 };
    let system = System::stack(&arm, &tests, &weighting).unwrap();
    let covariance = system.b.tr_mul(&system.b).try_inverse().unwrap();
    for (k, expected) in found.expected.iter().enumerate() {
        let (found, promised) = (covariance[(k, k)].sqrt(), expected.compliance.unwrap());
        // What is assumed to be known before changes a part in a million.
        assert!((found / promised - 1.0).abs() < 1e-4, "{found} {promised}");
        assert_eq!(expected.zero, None);
    }
}
