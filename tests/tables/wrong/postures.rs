//! A mistake in the table of an arm that a loop is written against, with one posture for its kernels.

use stiffarm::kernels::{Arm, Numeric, Scalar, has};

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    outputs: pose, jacobian, jacobian at camera;
    frame: camera on 1 translation [0, 100 mm, 0];
    joint | theta | d | a    | alpha
    a1    | q     | 0 | 0    | 0
    a2    | q     | 0 | 1 kg | 0
}

fn step<const N: usize, S: Scalar, A: has::Jacobian<N, S>>(arm: &A, q: &[S; N]) -> [[S; 6]; N] {
    arm.jacobian(&arm.posture(q))
}

fn reach<const N: usize>(_: &impl Numeric<N>) -> usize {
    N
}

struct Last {
    posture: arm::Posture<f64>,
}

fn main() {
    let q = [0.1; arm::N];
    let last = Last { posture: arm::Posture::new(&q) };
    let (pose, jacobian) = (arm::pose::given(&last.posture), arm::jacobian::given(&last.posture));
    let camera = arm::at::camera::jacobian::given(&last.posture);
    println!("{:?} {} {:?}", pose.position, jacobian[0][2], camera.first());
    println!("{:?} {}", step(&arm::Robot, &q), reach(&arm::Robot));
    println!("{:?} {:?}", arm::all(&q).pose, arm::all::given(&last.posture).jacobian);
    println!("{:?}", <arm::Robot as Arm<2>>::LIMITS);
}
