//! The KUKA KR 240-2 of Dumas et al. (modified convention) against the printed equations.

use core::f64::consts::FRAC_PI_2;
use std::string::ToString;

use nalgebra::{DVector, Matrix6, Vector3, Vector6};

use crate::generic::{Arm, Convention, Joint};

/// d2, d3, d4, RL4, RL6, m.
const LENGTHS: [f64; 5] = [0.35, 1.25, 0.055, 1.1, 0.23];

/// Table 3, with the joint stiffnesses of Table 2.
fn kr240() -> Arm {
    let [d2, d3, d4, rl4, rl6] = LENGTHS;
    let rows = [
        (0.0, 0.0, 0.0, 3.8e6),
        (FRAC_PI_2, d2, 0.0, 6.6e6),
        (0.0, d3, 0.0, 3.9e6),
        (-FRAC_PI_2, d4, rl4, 5.6e5),
        (FRAC_PI_2, 0.0, 0.0, 6.6e5),
        (-FRAC_PI_2, 0.0, rl6, 4.7e5),
    ];
    let joint = |(alpha, a, d, stiffness): (f64, f64, f64, f64)| Joint {
        d,
        a,
        alpha,
        compliance: 1.0 / stiffness,
        ..Joint::default()
    };
    Arm {
        name: "KUKA KR 240-2".to_string(),
        convention: Convention::Modified,
        joints: rows.map(joint).into(),
        gravity: Vector3::new(0.0, 0.0, -9.80665),
        ..Arm::default()
    }
}

const POSTURE: [f64; 6] = [0.3, 1.1, -1.7, 0.6, -0.9, 2.1];

/// Eq. 31 as printed, but for J32 to J35, of which the printed lines have slipped: J32 and J33 run
/// together under J32, the label J33 stands before J34, and J35 is split over the last two.
#[test]
fn jacobian_is_the_printed_one() {
    let [d2, d3, d4, rl4, rl6] = LENGTHS;
    let [q1, q2, q3, q4, q5, _] = POSTURE;
    let ((s1, c1), (s2, c2)) = (q1.sin_cos(), q2.sin_cos());
    let ((s4, c4), (s5, c5)) = (q4.sin_cos(), q5.sin_cos());
    let (s23, c23) = (q2 + q3).sin_cos();
    #[rustfmt::skip]
    let printed = Matrix6::from_row_slice(&[
        // J11 to J16
        -d2 * s1 - d3 * c2 * s1 - d4 * c23 * s1 + rl4 * s1 * s23
            + rl6 * c5 * s1 * s23 + rl6 * c23 * c4 * s1 * s5 + rl6 * c1 * s4 * s5,
        -rl4 * c1 * c23 - rl6 * c1 * c23 * c5 - d3 * c1 * s2 - d4 * c1 * s23
            + rl6 * c1 * c4 * s23 * s5,
        -rl4 * c1 * c23 - rl6 * c1 * c23 * c5 - d4 * c1 * s23 + rl6 * c1 * c4 * s23 * s5,
        rl6 * c4 * s1 * s5 + rl6 * c1 * c23 * s4 * s5,
        -rl6 * c1 * c23 * c4 * c5 + rl6 * c5 * s1 * s4 + rl6 * c1 * s23 * s5,
        0.0,
        // J21 to J26
        d2 * c1 + d3 * c1 * c2 + d4 * c1 * c23 - rl4 * c1 * s23 - rl6 * c1 * c5 * s23
            - rl6 * c1 * c23 * c4 * s5 + rl6 * s1 * s4 * s5,
        -rl4 * c23 * s1 - rl6 * c23 * c5 * s1 - d3 * s1 * s2 - d4 * s1 * s23
            + rl6 * c4 * s1 * s23 * s5,
        -rl4 * c23 * s1 - rl6 * c23 * c5 * s1 - d4 * s1 * s23 + rl6 * c4 * s1 * s23 * s5,
        -rl6 * c1 * c4 * s5 + rl6 * c23 * s1 * s4 * s5,
        -rl6 * c23 * c4 * c5 * s1 - rl6 * c1 * c5 * s4 + rl6 * s1 * s23 * s5,
        0.0,
        // J31 to J36
        0.0,
        d3 * c2 + d4 * c23 - rl4 * s23 - rl6 * c5 * s23 - rl6 * c23 * c4 * s5,
        d4 * c23 - rl4 * s23 - rl6 * c5 * s23 - rl6 * c23 * c4 * s5,
        rl6 * s23 * s4 * s5,
        -rl6 * c4 * c5 * s23 - rl6 * c23 * s5,
        0.0,
        // J41 to J46
        0.0, s1, s1, -c1 * s23, c4 * s1 + c1 * c23 * s4,
        -c1 * c5 * s23 - c1 * c23 * c4 * s5 + s1 * s4 * s5,
        // J51 to J56
        0.0, -c1, -c1, -s1 * s23, -c1 * c4 + c23 * s1 * s4,
        -c5 * s1 * s23 - c23 * c4 * s1 * s5 - c1 * s4 * s5,
        // J61 to J66
        1.0, 0.0, 0.0, c23, s23 * s4, c23 * c5 - c4 * s23 * s5,
    ]);
    // Six products of rotations, numbers of a few metres.
    assert!((kr240().jacobian(&POSTURE) - printed).amax() < 1e-14);
}

/// `w = K_X δd` with `K_X = J⁻ᵀ (Kθ − K_C) J⁻¹` (eqs. 7 and 10), under 20 kN so that K_C counts.
#[test]
fn deflection_obeys_equations_7_and_10() {
    let arm = kr240();
    let w = Vector6::new(5e3, -8e3, -2e4, 3e3, -1e3, 4e3);
    let springs = arm.joints.iter().map(|joint| 1.0 / joint.compliance);
    let k_theta = Matrix6::from_diagonal(&Vector6::from_iterator(springs));
    let jacobian = arm.jacobian(&POSTURE).fixed_columns::<6>(0).into_owned();
    let inverse = jacobian.try_inverse().unwrap();
    let k_c = arm.complementary_stiffness(&POSTURE, &w).fixed_view::<6, 6>(0, 0).into_owned();
    assert!(k_c.amax() > 4.7e3);
    let k_x = inverse.transpose() * (k_theta - k_c) * inverse;
    let back = k_x * arm.deflection(&POSTURE, &w).unwrap();
    // The condition number of J, a few tens, twice, on ε.
    assert!((back - w).norm() < 1e-11 * w.norm());
}

/// Eqs. 20 and 21: with the joints' compliances the regressor gives back the deflection of eq. 17.
#[test]
fn regressor_times_compliances_is_the_deflection() {
    let arm = kr240();
    let w = Vector6::new(500.0, -800.0, -2000.0, 300.0, -100.0, 400.0);
    let compliances = DVector::from_iterator(6, arm.joints.iter().map(|joint| joint.compliance));
    let fitted = arm.compliance_regressor(&POSTURE, &w) * compliances;
    let deflection = arm.deflection_first_order(&POSTURE, &w);
    assert!((fitted - deflection).norm() < 1e-14 * deflection.norm());
}
