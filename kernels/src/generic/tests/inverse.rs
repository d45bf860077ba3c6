//! Of a planar arm what the search finds is what trigonometry says.

use std::vec::Vec;

use nalgebra::Vector3;

use super::support::Random;
use crate::Motion;
use crate::generic::{Arm, Convention};

/// Three links in a plane, 0.5, 0.4 and 0.2 m.
fn planar() -> Arm {
    let mut arm = Random::new(1).arm();
    arm.convention = Convention::Standard;
    arm.joints.resize(3, arm.joints[0].clone());
    arm.base = nalgebra::Isometry3::identity();
    arm.tool = nalgebra::Isometry3::identity();
    for (joint, a) in arm.joints.iter_mut().zip([0.5, 0.4, 0.2]) {
        joint.motion = Motion::Revolute;
        (joint.theta, joint.d, joint.a, joint.alpha, joint.beta) = (0.0, 0.0, a, 0.0, 0.0);
    }
    arm
}

#[test]
fn two_elbows_of_a_planar_arm_are_found() {
    let (arm, q) = (planar(), [0.3, -0.9, 0.4]);
    let mut found = arm.inverse_kinematics(&arm.pose(&q), 40);
    found.sort_by(|a, b| a[1].total_cmp(&b[1]));
    // The elbow turned over: the angle at the shoulder between the links' chord and the first.
    let (x, y) = (0.5 + 0.4 * f64::cos(q[1]), 0.4 * f64::sin(q[1]));
    let over = [q[0] + 2.0 * y.atan2(x), -q[1]];
    let over = [over[0], over[1], q.iter().sum::<f64>() - over[0] - over[1]];
    assert_eq!(found.len(), 2, "{found:?}");
    for (found, expected) in found.iter().zip([q, over]) {
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() < 1e-10, "{found:?} {expected:?}");
        }
    }
}

#[test]
fn a_pose_out_of_reach_has_none() {
    let arm = planar();
    let mut pose = arm.pose(&[0.3, -0.9, 0.4]);
    pose.translation.vector += Vector3::z();
    assert_eq!(arm.inverse_kinematics(&pose, 10), Vec::<Vec<f64>>::new());
}
