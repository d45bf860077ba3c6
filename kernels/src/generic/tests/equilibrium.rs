//! The deflection of the joints against the equilibrium that it linearises.

use nalgebra::{DVector, Isometry3, Vector3, Vector6};

use super::support::{Random, cases};
use crate::generic::{Arm, Convention};
use crate::{Motion, Unstable};

/// The joints' displacement at which every spring holds the joint's load in the displaced posture,
/// `δ = c τ(q + δ)`, by repeated substitution: K_C does not enter.
fn equilibrium(arm: &Arm, q: &[f64], w: &Vector6<f64>, weights: bool) -> DVector<f64> {
    let compliance = DVector::from_iterator(q.len(), arm.joints.iter().map(|j| j.compliance));
    let start = DVector::from_column_slice(q);
    let mut displacement = DVector::zeros(q.len());
    // Each round gains a factor of |c K|, here below 0.01.
    for _ in 0..10 {
        let moved = &start + &displacement;
        let mut torque = arm.joint_torque(moved.as_slice(), w);
        if weights {
            torque += arm.weight_torque(moved.as_slice());
        }
        displacement = compliance.component_mul(&torque);
    }
    displacement
}

/// The arm without elastic links, its springs' compliances scaled by `softness`.
fn scaled(arm: &Arm, softness: f64) -> Arm {
    let mut arm = arm.clone();
    for joint in &mut arm.joints {
        joint.compliance *= softness;
        joint.beam = None;
    }
    arm
}

/// The errors at two softnesses of which one is half of the other.
fn errors(arm: &Arm, softness: f64, error: impl Fn(&Arm) -> f64) -> (f64, f64) {
    (error(&scaled(arm, softness)), error(&scaled(arm, softness / 2.0)))
}

/// To first order in the displacement K_C is the whole correction, so that what is left shrinks
/// with the third power of the softness: load × curvature of the torque × displacement². Without
/// K_C the second power is left.
#[test]
fn deflection_is_the_equilibrium_to_second_order() {
    let mut told = 0;
    for (arm, q, w) in cases() {
        for weights in [false, true] {
            let jacobian = arm.jacobian(&q);
            let of_equilibrium = |arm: &Arm| &jacobian * equilibrium(arm, &q, &w, weights);
            let error = |arm: &Arm| {
                let deflection = match weights {
                    false => arm.deflection(&q, &w),
                    true => arm.deflection_with_gravity(&q, &w),
                };
                (deflection.unwrap() - of_equilibrium(arm)).norm()
            };
            let (whole, half) = errors(&arm, 1.0, error);
            let size = of_equilibrium(&scaled(&arm, 1.0)).norm();
            // Where rounding does not blur it and the third-order term does not happen to vanish.
            if half > 1e-12 * size {
                let ratio = whole / half;
                assert!((7.9..8.1).contains(&ratio), "{ratio}");
                told += 1;
            }
            assert!(whole <= 1e-3 * size, "{whole} of {size}");
        }
        // Without K_C.
        let without = |arm: &Arm| {
            let first_order = arm.deflection_first_order(&q, &w);
            (first_order - arm.jacobian(&q) * equilibrium(arm, &q, &w, false)).norm()
        };
        let (whole, half) = errors(&arm, 1.0, without);
        let size = arm.deflection_first_order(&q, &w).norm();
        if half > 1e-9 * size {
            assert!((3.9..4.1).contains(&(whole / half)));
        }
    }
    assert!(told > 200, "{told}");
}

/// Joints and links one by one give what the compliance matrix gives.
#[test]
fn first_order_deflection_is_compliance_times_wrench() {
    for (arm, q, w) in cases() {
        let compliance = arm.compliance(&q);
        assert!((compliance - compliance.transpose()).amax() <= 1e-14 * compliance.amax());
        let deflection = arm.deflection_first_order(&q, &w);
        // Cancellation between the columns counts on the size of their products.
        let size = compliance.norm() * w.norm();
        assert!((deflection - compliance * w).norm() <= 1e-14 * size);
    }
}

/// Pushed along itself, a link on a spring buckles at k = f L.
#[test]
fn a_pushed_link_buckles() {
    let mut random = Random::new(0);
    let mut arm = scaled(&random.arm(), 1.0);
    arm.convention = Convention::Standard;
    arm.joints.truncate(1);
    arm.joints[0].motion = Motion::Revolute;
    (arm.joints[0].a, arm.joints[0].compliance) = (0.5, 1e-3);
    (arm.joints[0].theta, arm.joints[0].mass) = (0.0, 0.0);
    (arm.base, arm.tool) = (Isometry3::identity(), Isometry3::identity());
    let push = |force: f64| Vector6::new(-force, 1.0, 0.0, 0.0, 0.0, 0.0);
    // δ = τ / (k − f L), k = 1000 N·m/rad, τ = 0.5 N·m.
    let near = arm.deflection(&[0.0], &push(1900.0)).unwrap();
    assert!((near.y - 0.5 * 0.5 / (1000.0 - 950.0)).abs() < 1e-14);
    assert_eq!(arm.deflection(&[0.0], &push(2000.1)), Err(Unstable));
    assert_eq!(arm.deflection(&[0.0], &push(f64::NAN)), Err(Unstable));

    // The same by weight, standing on end.
    (arm.joints[0].mass, arm.joints[0].com) = (200.0, Vector3::zeros());
    arm.gravity = Vector3::new(-9.5, 0.0, 0.0);
    let weighed = arm.deflection_with_gravity(&[0.0], &push(0.0)).unwrap();
    assert!((weighed.y - near.y).abs() < 1e-14);
    arm.gravity = Vector3::new(-10.1, 0.0, 0.0);
    assert_eq!(arm.deflection_with_gravity(&[0.0], &push(0.0)), Err(Unstable));
}

/// Rigid joints hold still whatever the others do, and an arm of rigid joints does not move.
#[test]
fn rigid_joints_do_not_move() {
    for (arm, q, w) in cases() {
        let mut rigid = scaled(&arm, 0.0);
        assert_eq!(rigid.deflection(&q, &w), Ok(Vector6::zeros()));
        assert_eq!(rigid.deflection_with_gravity(&q, &w), Ok(Vector6::zeros()));

        rigid.joints[0].compliance = 1e-7;
        let column = rigid.jacobian(&q).column(0).into_owned();
        let stiffness = 1e7 - rigid.complementary_stiffness(&q, &w)[(0, 0)];
        let expected = column * (column.dot(&w) / stiffness);
        let deflection = rigid.deflection(&q, &w).unwrap();
        assert!((deflection - expected).norm() <= 1e-14 * expected.norm());
    }
}
