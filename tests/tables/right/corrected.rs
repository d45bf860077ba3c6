//! A file whose effects depend on the sides from which joints came, and on the temperature.

use stiffarm::kernels::{Arm as _, Kernels, Output, has};

stiffarm::robot! {
    pub mod arm from "files/corrected.toml";
    outputs: pose, jacobian, deflection;
}

#[test]
fn functions_take_sides_and_warming_behind_q() {
    let q = [0.3_f64, -0.5];
    let [one, two] = arm::joints(&q, &[1.0, 0.0], 8.0);
    // Half of the backlash, and 15 µrad for each of 8 K: sums of two numbers below 1.
    assert!((one - (0.3 - 1e-3)).abs() < 1e-15 && (two - (-0.5 + 8.0 * 15e-6)).abs() < 1e-15);
    let reach = 0.5 * one.cos() + 0.4 * (one + two).cos();
    let pose = arm::pose(&q, &[1.0, 0.0], 8.0);
    assert!((pose.position[0] - reach).abs() < 1e-15);
    let load = [0.0, 10.0, 0.0, 0.0, 0.0, 0.0];
    let loaded = arm::deflection(&q, &[1.0, 0.0], 8.0, &load).expect("it bears 10 N");
    assert!(loaded[1] > 0.0);
}

#[test]
fn its_robot_holds_them() {
    let robot = arm::Robot { sides: [1.0, 0.0], warming: 8.0 };
    let pose = has::Pose::pose(&robot, &robot.posture(&[0.3, -0.5]));
    assert_eq!(pose, arm::pose(&[0.3, -0.5], &[1.0, 0.0], 8.0));
    let mut out = [0.0; 12];
    let unknown = arm::Robot::<f64>::default();
    let found = Kernels::evaluate(&unknown, Output::Pose, &[0.3, -0.5], &[0.0; 6], &mut out);
    assert_eq!(found, Ok(()));
    assert_eq!(out[9..], arm::pose(&[0.3, -0.5], &[0.0; 2], 0.0).position);
}
