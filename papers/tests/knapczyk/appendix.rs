//! Equations (A.1) to (A.3): the roots of the printed squares, eight as they are and six mended.

use stiffarm_papers::knapczyk::apparent;

use crate::{PUMA, fanuc, near};

/// l1, l2, l3, λ4, λ6, m.
const LENGTHS: [f64; 5] = [0.27, 0.9, 0.27, 1.3, 0.26];

const POSTURES: [[f64; 6]; 3] = [
    [0.3, 1.1, -0.7, 0.6, -0.9, 2.1],
    [-1.48, 1.13, -0.21, 0.0, 0.17, 0.0],
    [2.0, -0.4, 0.9, -1.7, 1.2, -0.5],
];

/// Roots of c11, c22, c33 for joints 1 to 5, mended.
fn roots(q: &[f64; 6]) -> [[f64; 5]; 3] {
    let [l1, l2, l3, l4, l6] = LENGTHS;
    let [q1, q2, q3, q4, q5, _] = *q;
    let ((s1, c1), (s2, c2), (s23, c23)) = (q1.sin_cos(), q2.sin_cos(), (q2 + q3).sin_cos());
    let ((s4, c4), (s5, c5)) = (q4.sin_cos(), q5.sin_cos());
    let s = l1 + l2 * c2 + l3 * c23 + s23 * l4;
    let wx = (c1 * c23 * c4 + s1 * s4) * s5 + c1 * s23 * c5;
    let wy = (s1 * c23 * c4 - c1 * s4) * s5 + s1 * s23 * c5;
    let wz = s23 * c4 * s5 - c23 * c5;
    [
        [
            -s1 * s - l6 * wy,
            // Printed l3 c23.
            c1 * (l2 * s2 + l3 * s23 - c23 * l4 + wz * l6),
            c1 * (l3 * s23 - c23 * l4 + wz * l6),
            l6 * (s1 * s23 * wz + c23 * wy),
            l6 * ((-s1 * c23 * s4 - c1 * c4) * wz + s23 * s4 * wy),
        ],
        [
            // Printed with a bracket too few, c1 s4 and s1 s23 c5.
            c1 * s + l6 * wx,
            s1 * (l2 * s2 + l3 * s23 - c23 * l4 + wz * l6),
            s1 * (l3 * s23 - c23 * l4 + wz * l6),
            l6 * (-c23 * wx - c1 * s23 * wz),
            l6 * (-s23 * s4 * wx + (c1 * c23 * s4 - s1 * c4) * wz),
        ],
        [
            0.0,
            // Printed with l1, l2 s2 and a last term too many.
            l2 * c2 + l3 * c23 + l4 * s23 + l6 * (c23 * c4 * s5 + s23 * c5),
            // Printed c1 c23 c4 − c1 s4.
            l3 * c23 + l4 * s23 + l6 * (c23 * c4 * s5 + s23 * c5),
            // Printed s1 s23 c5.
            -l6 * s4 * s5 * s23,
            // Printed with a bracket too few.
            l6 * (c23 * s5 + s23 * c4 * c5),
        ],
    ]
}

#[test]
fn the_elements_are_sums_of_the_mended_squares() {
    let arm = fanuc(&PUMA);
    for q in POSTURES {
        let got = apparent(&arm, &q).unwrap();
        for (i, row) in roots(&q).iter().enumerate() {
            let terms: Vec<f64> = row.iter().zip(PUMA).map(|(root, k)| root * root / k).collect();
            for (j, term) in terms.iter().enumerate() {
                near(got.by_joint[(i, j)], *term, 1e-13 * term + 1e-18);
            }
            // O6 lies on axis 6.
            near(got.by_joint[(i, 5)], 0.0, 1e-30);
            let sum: f64 = terms.iter().sum();
            near(got.compliance[i], sum, 1e-13 * sum);
        }
    }
}

/// Against the definition: a unit force, and how far the tool moves along it.
#[test]
fn one_over_c_is_what_a_single_pull_measures() {
    let arm = fanuc(&PUMA);
    for q in POSTURES {
        let got = apparent(&arm, &q).unwrap();
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
    let got = apparent(&fanuc(&[]), &POSTURES[0]).unwrap();
    assert_eq!(got.compliance.amax(), 0.0);
    assert_eq!((got.translations_held, got.all_held), (None, None));
    assert!(got.free.iter().all(|k| k.is_infinite()));
    assert!(apparent(&fanuc(&[]), &[0.0; 5]).is_err());
}
