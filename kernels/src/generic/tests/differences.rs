//! Every derivative against central differences of what it derives, on random arms.

use nalgebra::{Isometry3, Vector3, Vector6};

use super::support::{Random, STEP, cases, central, difference_tolerance, reach, twist_between};
use crate::Motion;
use crate::generic::{Arm, Convention};

/// The arm with an entry of its table a step smaller, and a step larger.
fn moved(arm: &Arm, change: impl Fn(&mut Arm, f64)) -> [Arm; 2] {
    [-STEP, STEP].map(|step| {
        let mut other = arm.clone();
        change(&mut other, step);
        other
    })
}

#[test]
fn jacobian_is_the_twist_of_the_pose() {
    for (arm, q, _) in cases() {
        let jacobian = arm.jacobian(&q);
        let in_tool = arm.jacobian_tool(&q);
        for i in 0..arm.dof() {
            let step = |s: f64| {
                let mut other = q.clone();
                other[i] += s;
                arm.pose(&other)
            };
            let (before, after) = (step(-STEP), step(STEP));
            let twist = twist_between(&before, &after);
            let tolerance = difference_tolerance(reach(&arm, &q));
            assert!((jacobian.column(i) - twist).amax() < tolerance);

            // The same, seen from the tool: T⁻¹ dT.
            let here = arm.pose(&q).inverse();
            let twist = twist_between(&(here * before), &(here * after));
            assert!((in_tool.column(i) - twist).amax() < tolerance);
        }
    }
}

#[test]
fn complementary_stiffness_is_the_derivative_of_the_joint_torque() {
    for (arm, q, w) in cases() {
        let stiffness = arm.complementary_stiffness(&q, &w);
        for i in 0..arm.dof() {
            let column = central(&q, i, |q| arm.joint_torque(q, &w));
            let tolerance = difference_tolerance(reach(&arm, &q) * w.norm());
            assert!((stiffness.column(i) - column).amax() < tolerance);
        }
    }
}

/// Of a moment only the part below the diagonal remains, `m · (z_i × z_j)`.
#[test]
fn complementary_stiffness_is_unsymmetric_by_the_moment_alone() {
    for (arm, q, w) in cases() {
        let stiffness = arm.complementary_stiffness(&q, &w);
        let moment = Vector3::new(w[3], w[4], w[5]);
        let frames = arm.frames(&q);
        let axis = |j: usize| match (arm.joints[j].motion, arm.convention) {
            (Motion::Prismatic, _) => Vector3::zeros(),
            (Motion::Revolute, Convention::Standard) => frames[j] * Vector3::z(),
            (Motion::Revolute, Convention::Modified) => frames[j + 1] * Vector3::z(),
        };
        for j in 0..arm.dof() {
            for i in 0..j {
                let skew = stiffness[(j, i)] - stiffness[(i, j)];
                let expected = moment.dot(&axis(i).cross(&axis(j)));
                // A few roundings of numbers below reach · |w|.
                assert!((skew - expected).abs() < 1e-14 * reach(&arm, &q) * w.norm());
            }
        }
    }
}

/// `−Σ m g · c`, beams with their whole mass in the middle of the chord.
fn potential_energy(arm: &Arm, q: &[f64]) -> f64 {
    let frames = arm.frames(q);
    let origin = |i: usize| frames[i].translation.vector;
    let gravity = arm.base.rotation * arm.gravity;
    let mut energy = 0.0;
    for (i, joint) in arm.joints.iter().enumerate() {
        let centre = frames[i + 1].transform_point(&joint.com.into()).coords;
        energy -= joint.mass * gravity.dot(&centre);
        if let Some(beam) = &joint.beam {
            let mass = beam.density * beam.area * (origin(i + 1) - origin(i)).norm();
            energy -= mass * gravity.dot(&((origin(i) + origin(i + 1)) / 2.0));
        }
    }
    energy
}

fn weight_scale(arm: &Arm, q: &[f64]) -> f64 {
    let beams = arm.joints.iter().filter_map(|joint| joint.beam.as_ref());
    let beams: f64 = beams.map(|beam| beam.density * beam.area * 1.5).sum();
    let masses: f64 = arm.joints.iter().map(|joint| joint.mass).sum();
    (beams + masses) * arm.gravity.norm() * reach(arm, q)
}

#[test]
fn weight_torque_is_the_slope_of_the_potential_energy() {
    for (arm, q, _) in cases() {
        let torque = arm.weight_torque(&q);
        for i in 0..arm.dof() {
            let slope = central(&q, i, |q| potential_energy(&arm, q));
            assert!((torque[i] + slope).abs() <= difference_tolerance(weight_scale(&arm, &q)));
        }
    }
}

#[test]
fn weight_stiffness_is_the_derivative_of_the_weight_torque() {
    for (arm, q, _) in cases() {
        let stiffness = arm.weight_stiffness(&q);
        assert_eq!(stiffness, stiffness.transpose());
        for i in 0..arm.dof() {
            let column = central(&q, i, |q| arm.weight_torque(q));
            let tolerance = difference_tolerance(weight_scale(&arm, &q));
            assert!((stiffness.column(i) - column).amax() <= tolerance);
        }
    }
}

fn set_tool(arm: &mut Arm, translation: Vector3<f64>, rotation: Vector3<f64>) {
    arm.tool = Isometry3::new(translation, rotation);
    arm.tool_rotation_vector = rotation;
}

#[test]
fn parameter_jacobian_is_the_twist_per_entry_of_the_table() {
    for (arm, q, _) in cases() {
        let n = arm.dof();
        let jacobian = arm.parameter_jacobian(&q);
        assert_eq!(jacobian.ncols(), 4 * n + 6);
        let check = |column: usize, change: &dyn Fn(&mut Arm, f64)| {
            let [before, after] = moved(&arm, change);
            let twist: Vector6<f64> = twist_between(&before.pose(&q), &after.pose(&q));
            let tolerance = difference_tolerance(reach(&arm, &q));
            assert!((jacobian.column(column) - twist).amax() < tolerance, "column {column}");
        };
        for i in 0..n {
            check(4 * i, &|arm, step| arm.joints[i].theta += step);
            check(4 * i + 1, &|arm, step| arm.joints[i].d += step);
            check(4 * i + 2, &|arm, step| arm.joints[i].a += step);
            check(4 * i + 3, &|arm, step| arm.joints[i].alpha += step);
        }
        let (t, r) = (arm.tool.translation.vector, arm.tool_rotation_vector);
        for k in 0..3 {
            check(4 * n + k, &|arm, step| set_tool(arm, t + Vector3::ith(k, step), r));
            check(4 * n + 3 + k, &|arm, step| set_tool(arm, t, r + Vector3::ith(k, step)));
        }
    }
}

/// The rotation vector's columns from no rotation to more than half a turn: both branches of the
/// left Jacobian, and vectors that the rotation alone does not give back.
#[test]
fn tool_rotation_columns_hold_at_any_angle() {
    let mut random = Random::new(1);
    let arm = random.arm();
    let q = random.posture(&arm);
    let n = arm.dof();
    for angle in [0.0, 1e-9, 1e-3, 0.0999, 0.1001, 1.0, 3.0, 5.0] {
        let r = random.vector(1.0).normalize() * angle;
        let with = |r: Vector3<f64>| {
            let mut arm = arm.clone();
            set_tool(&mut arm, Vector3::zeros(), r);
            arm
        };
        let jacobian = with(r).parameter_jacobian(&q);
        for k in 0..3 {
            let step = Vector3::ith(k, STEP);
            let twist = twist_between(&with(r - step).pose(&q), &with(r + step).pose(&q));
            let error = jacobian.column(4 * n + 3 + k) - twist;
            assert!(error.amax() < difference_tolerance(reach(&arm, &q)), "angle {angle}");
        }
    }
}
