//! An arm from a URDF: the chain between two links, fixed joints folded.

use stiffarm::kernels::{Arm, Motion};

stiffarm::robot! {
    /// To the flange.
    mod elbow from "files/elbow.urdf", base "base_link", tip "tool0";
    outputs: pose, jacobian, jacobian_spatial;
}
stiffarm::robot! {
    /// To the camera, which the second joint does not move.
    mod eye from "files/elbow.urdf", tip "camera", base "shoulder_mount";
}

#[test]
fn a_urdf_is_an_arm() {
    assert_eq!((elbow::NAME, elbow::N, eye::N), ("elbow", 2, 1));
    assert_eq!(
        elbow::DH.map(|row| (row.joint, row.motion)),
        [("shoulder", Motion::Revolute), ("elbow", Motion::Revolute)]
    );
    assert_eq!(<elbow::Robot as Arm<2>>::LIMITS, [Some([-1.5, 1.25]), None]);
    let q = [0.4_f64, -1.1];
    let (sum, upper, fore) = (q[0] + q[1], 0.5, 0.4);
    let pose = elbow::pose(&q);
    let place = [upper * q[0].cos() + fore * sum.cos(), upper * q[0].sin() + fore * sum.sin(), 0.4];
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15);
    assert!(near(&pose.position, &place), "{pose:?}");
    assert!(near(&pose.rotation[0], &[sum.cos(), sum.sin(), 0.0]));
    assert!(near(&elbow::jacobian(&q)[0], &[-place[1], place[0], 0.0, 0.0, 0.0, 1.0]));
    // The second axis from the base's origin: p × z.
    let axis = [upper * q[0].sin(), -upper * q[0].cos(), 0.0, 0.0, 0.0, 1.0];
    assert!(near(&elbow::jacobian_spatial(&q)[1], &axis));
    assert!(near(&eye::pose(&[q[0]]).position, &[0.1 * q[0].cos(), 0.1 * q[0].sin(), 0.0]));
}
