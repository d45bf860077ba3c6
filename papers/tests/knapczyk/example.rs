//! Section 2.1: what the ledger does not compute of its numbers.

use nalgebra::{Matrix3, Vector6};

use super::{PUMA, fanuc, printed};
use crate::near;

/// (A.3) as printed, joints 2 and 3, misprints and all: still not 0.00183.
#[test]
fn nor_does_it_follow_from_the_misprints() {
    let [l1, l2, l3, l4, l6] = [0.27, 0.9, 0.27, 1.3, 0.26];
    let [q1, q2, q3, q4, q5, _] = printed();
    let ((s1, c1), (s2, c2), (s23, c23)) = (q1.sin_cos(), q2.sin_cos(), (q2 + q3).sin_cos());
    let ((s4, c4), (s5, c5)) = (q4.sin_cos(), q5.sin_cos());
    let wy = (s1 * c23 * c4 - c1 * s4) * s5 + s1 * s23 * c5;
    let wx = (c1 * c23 * c4 + s1 * s4) * s5 + c1 * s23 * c5;
    let wrong = (c1 * c23 * c4 - c1 * s4) * s5 + c1 * s23 * c5;
    let wz = s23 * c4 * s5 - c23 * c5;
    let root2 = s1 * (s1 * (l1 + l2 * c2 + l3 * c23 + s23 * l4) + l6 * wy)
        + c1 * (c1 * (l2 * s2 + l3 * c23 + s23 * l4) + wx * l6)
        + wz * l6;
    let root3 = s1 * (s1 * (l3 * c23 + s23 * l4) + l6 * wy)
        + c1 * (c1 * (l3 * c23 + s23 * l4) + wrong * l6);
    near(1e3 * (root2 * root2 / PUMA[1] + root3 * root3 / PUMA[2]), 0.23331, 5e-6);
}

/// Printed: k33 = 1/c33, 546.6 and 169.5 (N/mm, not mm/N). That is the stiffness against a single pull;
/// the element of the inverse, the other translations held, is 3.5 times larger.
#[test]
fn the_apparent_stiffness_is_not_the_element_of_the_inverse() {
    let arm = fanuc(&PUMA[..3]);
    let compliance = arm.compliance(&printed());
    near(1e-3 / compliance[(2, 2)], 4.449, 5e-4);
    let translations: Matrix3<f64> = compliance.fixed_view::<3, 3>(0, 0).into_owned();
    near(translations.try_inverse().unwrap()[(2, 2)] / 1e3, 15.77, 5e-3);
    // A single pull: the tool moves along it by c33, and elsewhere as it likes.
    let pull = Vector6::new(0.0, 0.0, 1.0, 0.0, 0.0, 0.0);
    near(arm.deflection_first_order(&printed(), &pull).z / compliance[(2, 2)], 1.0, 1e-12);
}
