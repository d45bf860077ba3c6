//! Equations (A.1) to (A.3).

use std::collections::HashMap;

use crate::apparent::apparent;

use crate::printed::Printed;
use crate::{PUMA, fanuc, near};

/// l1, l2, l3, λ4, λ6, m.
const LENGTHS: [f64; 5] = [0.27, 0.9, 0.27, 1.3, 0.26];

const POSTURES: [[f64; 6]; 3] = [
    [0.3, 1.1, -0.7, 0.6, -0.9, 2.1],
    [-1.48, 1.13, -0.21, 0.0, 0.17, 0.0],
    [2.0, -0.4, 0.9, -1.7, 1.2, -0.5],
];

/// Each printed term, as it should read, is what its joint adds.
#[test]
fn the_elements_are_sums_of_the_mended_squares() {
    let (arm, printed) = (fanuc(&PUMA), Printed::of("knapczyk/equations.toml"));
    let names = ["l1", "l2", "l3", "lambda4", "lambda6"];
    for q in POSTURES {
        let got = apparent(&arm, &q);
        let mut values: HashMap<String, f64> =
            names.into_iter().zip(LENGTHS).map(|(name, value)| (name.into(), value)).collect();
        for j in 0..6 {
            values.insert(format!("kappa{}", j + 1), PUMA[j]);
            values.insert(format!("theta{}", j + 1), q[j]);
        }
        // Joint 1 does not lift; O6 lies on axis 6.
        near(got.by_joint[(2, 0)], 0.0, 1e-30);
        for i in 0..3 {
            near(got.by_joint[(i, 5)], 0.0, 1e-30);
            let mut sum = 0.0;
            for j in usize::from(i == 2)..5 {
                let number = format!("(A.{0}) c_{{{0}{0}}}, joint {1}", i + 1, j + 1);
                let term = printed.entries(&number, &values)[0];
                near(got.by_joint[(i, j)], term, 1e-13 * term + 1e-18);
                sum += term;
            }
            near(got.compliance[i], sum, 1e-13 * sum);
        }
    }
}

/// Against the definition: a unit force, and how far the tool moves along it.
#[test]
fn one_over_c_is_what_a_single_pull_measures() {
    let arm = fanuc(&PUMA);
    for q in POSTURES {
        let got = apparent(&arm, &q);
        for k in 0..6 {
            let mut pull = nalgebra::Vector6::zeros();
            pull[k] = 1.0;
            let moved = arm.deflection_first_order(&q, &pull)[k];
            near(got.free[k] * moved, 1.0, 1e-12);
        }
        // All five other motions held: the wrench of a unit motion along one axis.
        let held = got.all_held.unwrap();
        let lu = arm.compliance(&q).lu();
        for k in 0..6 {
            let mut motion = nalgebra::Vector6::zeros();
            motion[k] = 1.0;
            near(lu.solve(&motion).unwrap()[k] / held[k], 1.0, 1e-9);
        }
        let three = got.translations_held.unwrap();
        for k in 0..3 {
            assert!(got.free[k] < three[k] && three[k] < held[k]);
        }
    }
}

#[test]
fn a_rigid_arm_has_no_compliance() {
    let got = apparent(&fanuc(&[]), &POSTURES[0]);
    assert_eq!(got.compliance.amax(), 0.0);
    assert_eq!((got.translations_held, got.all_held), (None, None));
    assert!(got.free.iter().all(|k| k.is_infinite()));
}
