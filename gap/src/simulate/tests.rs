//! Equilibrium against the textbook and against itself.

use super::*;
use crate::fixture::{bent, springy};

#[test]
fn the_springs_balance_the_loads_in_the_loaded_geometry() {
    let arm = springy();
    let (q, w) = ([0.3, -0.7, 0.4], Vector6::new(300.0, -200.0, -800.0, 20.0, -30.0, 10.0));
    let state = equilibrium(&arm, &q, &w).unwrap();
    let torque = arm.joint_torque(&state.joints, &w) + arm.weight_torque(&state.joints);
    for j in 0..3 {
        let twist = state.joints[j] - q[j];
        assert!(twist.abs() > 1e-4);
        assert!((twist - arm.joints[j].compliance * torque[j]).abs() < 1e-15);
    }
}

#[test]
fn a_small_load_gives_the_textbook_deflection() {
    let arm = bent();
    let (q, w) = ([0.3, -0.7, 0.4], Vector6::new(3e-3, -2e-3, -8e-3, 2e-4, -3e-4, 1e-4));
    let mut light = arm.clone();
    light.gravity = Vector3::zeros();
    let state = equilibrium(&light, &q, &w).unwrap();
    let moved = state.tool.translation.vector - light.pose(&q).translation.vector;
    let want = translation(&light.deflection(&q, &w).unwrap());
    assert!((moved - want).norm() < 1e-6 * want.norm() + 1e-15, "{moved} {want}");
}

#[test]
fn a_buckling_load_is_refused() {
    let arm = springy();
    let push = Vector6::new(-1e9, 0.0, 0.0, 0.0, 0.0, 0.0);
    assert_eq!(equilibrium(&arm, &[0.0; 3], &push).unwrap_err(), Unstable);
    let nan = Vector6::repeat(f64::MAX);
    assert_eq!(equilibrium(&arm, &[0.0; 3], &nan).unwrap_err(), Unstable);
}

#[test]
fn an_arm_without_joints_stands_still() {
    let mut arm = springy();
    arm.joints.clear();
    let state = equilibrium(&arm, &[], &Vector6::repeat(10.0)).unwrap();
    assert_eq!(state.tool, arm.tool);
}

#[test]
fn a_marker_turns_with_the_tool() {
    let arm = springy();
    let mut row = crate::fixture::row(&[0.3, -0.7, 0.4], Vector6::zeros());
    row.offset = Some([0.0, 0.1, 0.2]);
    let kind = Kind::Pose { orientation: true };
    let sim = simulate(&arm, &row, kind).unwrap();
    let want = sim.loaded.tool * nalgebra::Point3::new(0.0, 0.1, 0.2);
    assert_eq!(sim.reading().position, want.coords);
}
