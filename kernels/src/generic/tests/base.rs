//! Base parameters: how many there are, as the literature counts them, and that nothing else is felt.

use std::string::ToString;
use std::vec::Vec;

use nalgebra::{DVector, Vector3};

use super::support::Random;
use crate::Output;
use crate::generic::{Arm, BaseParameter, Convention, Drive, Joint};

const RIGHT: f64 = core::f64::consts::FRAC_PI_2;

/// Joints that turn, each with alpha, a and d.
fn arm(convention: Convention, rows: &[[f64; 3]]) -> Arm {
    let joint =
        |[alpha, a, d]: &[f64; 3]| Joint { d: *d, a: *a, alpha: *alpha, ..Joint::default() };
    Arm {
        name: "bare".to_string(),
        convention,
        joints: rows.iter().map(joint).collect(),
        gravity: Vector3::new(0.0, 0.0, -9.81),
        ..Arm::default()
    }
}

/// The PUMA 560 (Armstrong, Khatib & Burdick 1986).
fn puma() -> Arm {
    arm(
        Convention::Modified,
        &[
            [0.0, 0.0, 0.0],
            [-RIGHT, 0.0, 0.2435],
            [0.0, 0.4318, -0.0934],
            [RIGHT, -0.0203, 0.4331],
            [-RIGHT, 0.0, 0.0],
            [RIGHT, 0.0, 0.0],
        ],
    )
}

#[test]
fn there_are_as_many_as_pinocchio_s_regressor_has_ranks() {
    // tools/pinocchio_base.py, all counts here. Of any arm of n joints that turn 7n − 4 at most; about a vertical first
    // axis gravity does not tell the two first moments of its link.
    assert_eq!(puma().base_parameters().len(), 36);
    let mut leaning = puma();
    leaning.gravity = Vector3::new(1.0, 2.0, -9.0);
    assert_eq!(leaning.base_parameters().len(), 38);
    leaning.joints.truncate(1);
    // About a leaning axis: the first moments across it, and the inertia.
    let alone: Vec<usize> = leaning.base_parameters().iter().map(|sum| sum.moment).collect();
    assert_eq!(alone, [1, 2, 9]);
    let panda = arm(
        Convention::Modified,
        &[
            [0.0, 0.0, 0.333],
            [-RIGHT, 0.0, 0.0],
            [RIGHT, 0.0, 0.316],
            [RIGHT, 0.0825, 0.0],
            [-RIGHT, -0.0825, 0.384],
            [RIGHT, 0.0, 0.0],
            [RIGHT, 0.088, 0.0],
        ],
    );
    assert_eq!(panda.base_parameters().len(), 43);
    // Two links in a vertical plane: what the second weighs at its axis, the first carries.
    let planar = arm(Convention::Modified, &[[RIGHT, 0.0, 0.0], [0.0, 0.5, 0.0]]);
    let found: Vec<_> = planar.base_parameters().iter().map(BaseParameter::to_string).collect();
    assert_eq!(found, ["mx1 + 0.5 m2", "my1", "zz1 + 0.25 m2", "mx2", "my2", "zz2"]);
}

/// In closed form (Khalil & Kleinfinger 1987): m, mz and yy of a link that turns go to the link before, xx takes −yy.
#[test]
fn sums_are_those_of_the_closed_form() {
    let found: Vec<_> = puma().base_parameters().iter().map(BaseParameter::to_string).collect();
    let last = &found[29..];
    let expected = ["mx6", "my6", "xx6 - yy6", "xy6", "xz6", "yz6", "zz6"];
    assert_eq!(last, expected);
    assert_eq!(found[22..25], ["mx5", "my5 - mz6", "xx5 - yy5 + yy6"]);
}

/// Whatever the links: what is left out of the sums is below 1e-9 of what stands there.
#[test]
fn all_columns_are_felt_through_those_of_the_base() {
    for seed in 0..60 {
        let mut random = Random::new(seed);
        let mut arm = random.arm();
        arm.joints
            .iter_mut()
            .for_each(|joint| (joint.beam, joint.drive) = (None, Drive::default()));
        let base = arm.base_parameters();
        let moments = arm.moments();
        for _ in 0..5 {
            let q = random.posture(&arm);
            let state = super::support::state(Output::InverseDynamics, &q);
            let (q, motion) = state.split_at(arm.dof());
            let (rates, accelerations) = motion.split_at(arm.dof());
            let regressor = arm.torque_regressor(q, rates, accelerations);
            let torque = base.iter().fold(DVector::zeros(arm.dof()), |sum, parameter| {
                sum + regressor.column(parameter.moment) * parameter.of(&moments)
            });
            let expected = arm.inverse_dynamics(q, rates, accelerations);
            let scale = regressor.amax() * moments.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            assert!((torque - expected).amax() <= 1e-9 * scale, "{seed}");
        }
    }
}
