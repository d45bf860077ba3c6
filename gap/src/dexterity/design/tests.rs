//! Plans against random ones, and what they promise against what an identification finds.

use nalgebra::{DMatrix, Vector6};
use stiffarm_codegen::robot::Robot;
use stiffarm_kernels::generic::Arm;

use super::{Design, Plan, Purpose};
use crate::dexterity::{DexterityError, inverse_condition};
use crate::identify::{Settings, Test, Weighting, identify};

fn kr240() -> Arm {
    let text = include_str!("../../../../robots/arms/kuka_kr240.toml");
    let robot = Robot::from_toml(text, "kuka_kr240.toml").unwrap().0;
    let mut arm = crate::robot::arm(&robot).unwrap();
    arm.tool = nalgebra::Isometry3::translation(0.1, 0.0, 0.15);
    arm
}

fn design(arm: &Arm, plan: &Plan) -> Result<Design, DexterityError> {
    super::design(arm, plan, &|part| assert!((0.0..=1.0).contains(&part)))
}

fn plan(purpose: Purpose) -> Plan {
    let pull = |x: f64, y: f64, z: f64| Vector6::new(x, y, z, 0.0, 0.0, 0.0);
    Plan {
        count: 8,
        purpose,
        loads: vec![pull(0.0, 0.0, -1000.0), pull(1000.0, 0.0, 0.0), pull(0.0, -1000.0, 0.0)],
        noise_position: 3e-5,
        noise_rotation: None,
        seed: 1,
    }
}

fn within_limits(arm: &Arm, design: &Design) {
    for (k, test) in design.tests.iter().enumerate() {
        for (q, joint) in test.q.iter().zip(&arm.joints) {
            let [low, high] = joint.limits.unwrap();
            assert!((low..=high).contains(q));
        }
        let own = inverse_condition(arm, &test.q, design.length).unwrap();
        assert_eq!(own, test.inverse_condition);
        assert!(design.tests[..k].iter().all(|other| other.q != test.q));
    }
}

/// The deviations promised are those of the least squares, and better than random ones.
#[test]
fn a_plan_says_what_the_identification_will() {
    let arm = kr240();
    let found = design(&arm, &plan(Purpose::Identify)).unwrap();
    assert_eq!(found.tests.len(), 8);
    within_limits(&arm, &found);
    assert!(found.efficiency > 1.5, "{}", found.efficiency);
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
    let identified = identify(&arm, &tests, &Settings::known_noise(weighting)).unwrap();
    for (estimate, expected) in identified.joints.iter().zip(&found.expected) {
        let promised = expected.compliance.unwrap();
        // What is assumed to be known before changes a part in a million.
        assert!((estimate.deviation / promised - 1.0).abs() < 1e-4, "{estimate:?} {promised}");
        assert_eq!(expected.zero, None);
    }
}

/// No exchange of one test for another is better: by brute force, on determinants of matrices put
/// together here.
#[test]
fn no_single_exchange_is_better() {
    let arm = kr240();
    let plan = Plan { count: 4, ..plan(Purpose::Identify) };
    let found = design(&arm, &plan).unwrap();
    let pool = super::candidates::draw(&arm, &plan).unwrap();
    let determinant = |tests: &[(&[f64], Vector6<f64>)]| {
        let mut sum = DMatrix::<f64>::zeros(6, 6);
        for (q, wrench) in tests {
            let b = arm.stiffness_regressor(q, wrench).fixed_rows::<3>(0).into_owned();
            sum += b.transpose() * &b * 1e12;
        }
        sum.determinant()
    };
    let own: Vec<(&[f64], Vector6<f64>)> =
        found.tests.iter().map(|t| (t.q.as_slice(), t.wrench)).collect();
    let best = determinant(&own);
    for slot in 0..4 {
        for block in &pool.blocks {
            let q = pool.postures[block.posture].q.as_slice();
            if own.iter().any(|(other, _)| *other == q) {
                continue;
            }
            let mut tests = own.clone();
            tests[slot] = (q, plan.loads[block.load]);
            // Gains of less than a millionth of the logarithm are not taken, and what is assumed
            // to be known before changes each pivot by a millionth.
            assert!(determinant(&tests) <= best * (1.0 + 1e-4));
        }
    }
}

#[test]
fn zeros_are_planned_for_too() {
    let arm = kr240();
    let found = design(&arm, &plan(Purpose::Diagnose)).unwrap();
    within_limits(&arm, &found);
    for expected in &found.expected {
        assert!(expected.compliance.is_some() && expected.zero.is_some(), "{expected:?}");
        // A zero shows by micrometres per microradian: 8 postures give it to microradians.
        assert!(expected.zero.unwrap() < 2e-3);
    }
}

/// A hanging weight does not show joint 1; the plan says so.
#[test]
fn what_no_test_shows_is_said() {
    let arm = kr240();
    let mut hanging = plan(Purpose::Identify);
    hanging.loads.truncate(1);
    let found = design(&arm, &hanging).unwrap();
    assert_eq!(found.expected[0].compliance, None);
    assert!(found.expected[1].compliance.is_some());
}

#[test]
fn the_same_seed_gives_the_same_plan() {
    let arm = kr240();
    let small = Plan { count: 3, ..plan(Purpose::Identify) };
    assert_eq!(design(&arm, &small), design(&arm, &small));
    let other = Plan { seed: 2, ..small.clone() };
    assert_ne!(design(&arm, &small), design(&arm, &other));
}

#[test]
fn plans_that_cannot_be_made_are_refused() {
    let mut arm = kr240();
    let good = plan(Purpose::Identify);
    for wrong in [
        Plan { count: 0, ..good.clone() },
        Plan { loads: vec![], ..good.clone() },
        Plan { loads: vec![Vector6::repeat(f64::NAN)], ..good.clone() },
        Plan { noise_position: 0.0, ..good.clone() },
    ] {
        assert!(matches!(design(&arm, &wrong), Err(DexterityError::Setting { .. })), "{wrong:?}");
    }
    let heavy = Plan { loads: vec![Vector6::new(0.0, 0.0, -1e12, 0.0, 0.0, 0.0)], ..good.clone() };
    assert!(matches!(design(&arm, &heavy), Err(DexterityError::Unstable(_))));
    arm.joints[1].motion = stiffarm_kernels::Motion::Prismatic;
    arm.joints[1].limits = None;
    assert_eq!(design(&arm, &good).unwrap_err(), DexterityError::Unlimited { joint: 2 });
}
