//! The papers' arms from their robot files.

use crate::method::Test;
use crate::method::rig::{Errors, PoseFit, Rig, carry_out};
use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

/// L of the paper, m.
pub const LENGTH: f64 = 0.682;

/// The KR 240-2 with the stiffnesses of Table 2.
pub fn kr240() -> Arm {
    stiffarm_papers::methods::arm("kuka_kr240").unwrap()
}

/// θ1 = 0 and a wrist of 45° (section 3.1); θ2 and θ3 are the map's.
pub fn posture() -> [f64; 6] {
    [0.0, 0.0, 0.0, 45.0, 45.0, 45.0].map(f64::to_radians)
}

/// The wrench of Fig. 4.
pub fn wrench() -> Vector6<f64> {
    Vector6::new(0.0, 0.0, -2000.0, 200.0, 200.0, 0.0)
}

pub fn near(got: f64, want: f64, tolerance: f64) {
    assert!((got - want).abs() <= tolerance, "{got} is not {want} ± {tolerance}");
}

/// The same with the tool point 0.15 m beyond the flange, on axis 6.
pub fn with_tool() -> Arm {
    let mut arm = kr240();
    arm.tool = nalgebra::Isometry3::translation(0.0, 0.0, 0.15);
    arm
}

/// Tests of the paper's rig, carried out: how many of which plan, with which errors.
pub fn carried_out(
    arm: &Arm,
    (count, plan): (usize, u64),
    errors: Errors,
    fit: PoseFit,
) -> Vec<Test> {
    let rig = Rig::dumas();
    carry_out(arm, &rig, &rig.plan(arm, count, plan), errors, fit, 1).unwrap()
}
