//! Postures that random draws do not meet: all joints at zero, a stretched elbow, an aligned wrist,
//! joints at their limits, and all of it under no load.

use core::f64::consts::{FRAC_PI_2, PI};

use stiffarm::kernels::Motion;
use stiffarm::kernels::generic::{Arm, Convention};

use crate::compare::{CANCELLED, CANCELLED_F32, Draws, ForArm, collection, deviation, known};

/// Straight, right and opposite angles of every joint by itself, the others drawn: the elbow stretched or
/// folded, the wrist aligned, whichever joints they are and wherever the table has its zero.
fn aligned(arm: &Arm, draws: &mut Draws) -> Vec<Vec<f64>> {
    let mut postures = Vec::new();
    for (k, joint) in arm.joints.iter().enumerate() {
        if joint.motion == Motion::Prismatic {
            continue;
        }
        for angle in [0.0, FRAC_PI_2, PI, -FRAC_PI_2] {
            let mut q = draws.posture(arm);
            q[k] = angle - joint.theta;
            postures.push(q);
        }
    }
    postures
}

/// The posture in which the tool is farthest from an axis, found joint by joint: a stretched arm.
fn stretched(arm: &Arm, draws: &mut Draws) -> Vec<f64> {
    let mut q = draws.posture(arm);
    let shoulder = usize::from(arm.convention == Convention::Modified);
    let reach = |q: &[f64]| {
        let frames = arm.frames(q);
        let from = frames[shoulder.min(arm.dof())].translation.vector;
        (arm.pose(q).translation.vector - from).norm()
    };
    for _ in 0..50 {
        for k in (0..arm.dof()).filter(|k| arm.joints[*k].motion == Motion::Revolute) {
            let at = |angle: f64, q: &[f64]| {
                let mut q = q.to_vec();
                q[k] = angle;
                q
            };
            // reach² is a + b cos(q − c) in each angle.
            let [zero, right, left] =
                [0.0, FRAC_PI_2, -FRAC_PI_2].map(|angle| reach(&at(angle, &q)).powi(2));
            let mean = (right + left) / 2.0;
            let best = ((right - left) / 2.0).atan2(zero - mean);
            q = at(best, &q);
        }
    }
    q
}

fn postures(arm: &Arm) -> Vec<Vec<f64>> {
    let mut draws = Draws::new(12);
    let n = arm.dof();
    let limit = |side: usize| -> Vec<f64> {
        let fallback = |motion| if motion == Motion::Revolute { PI } else { 1.0 };
        let of = |j: &stiffarm::kernels::generic::Joint| {
            j.limits.unwrap_or([-fallback(j.motion), fallback(j.motion)])[side]
        };
        arm.joints.iter().map(of).collect()
    };
    let (low, high) = (limit(0), limit(1));
    let mut postures = vec![vec![0.0; n], low.clone(), high.clone(), stretched(arm, &mut draws)];
    // Each joint at one of its limits.
    postures.extend(
        (0..8).map(|_| (0..n).map(|k| if draws.unit() < 0.0 { low[k] } else { high[k] }).collect()),
    );
    // Every joint in line with the table's axes.
    postures.extend((0..8).map(|_| {
        let quarter = |joint: &stiffarm::kernels::generic::Joint, draw: f64| match joint.motion {
            Motion::Revolute => (2.0 * draw).round() * FRAC_PI_2 - joint.theta,
            Motion::Prismatic => 0.0,
        };
        arm.joints.iter().map(|joint| quarter(joint, draws.unit())).collect()
    }));
    postures.extend(aligned(arm, &mut draws));
    postures
}

#[test]
fn special_postures_agree_with_the_textbook() {
    for (entry, _, arm) in collection() {
        let mut draws = Draws::new(13);
        for posture in postures(&arm) {
            // As in single precision, so that both are asked the same.
            let mut posture = posture;
            posture.extend(draws.state(&arm).split_off(arm.dof()));
            let q: Vec<f64> = posture.iter().map(|x| f64::from(*x as f32)).collect();
            let drawn = draws.wrench(&arm).map(|x| f64::from(x as f32));
            for wrench in [drawn, [0.0; 6]] {
                for &output in entry.kernels.outputs() {
                    let at = |q: &[f64]| {
                        let cancelled = (CANCELLED, |x| x);
                        deviation(entry.kernels, &arm, output, (q, &wrench), cancelled)
                    };
                    let worst = at(&posture).max(at(&q));
                    let place = || format!("{} {} at {q:?} {wrench:?}", entry.id, output.name());
                    assert!(worst <= 1e-12, "{}: {worst:e}", place());
                    let cancelled = (CANCELLED_F32, f64::from);
                    let worst =
                        deviation(entry.kernels_f32, &arm, output, (&q, &wrench), cancelled);
                    assert!(worst <= 2e-6, "{} in single precision: {worst:e}", place());
                }
            }
        }
    }
}

/// The postures are what they are called.
#[test]
fn a_stretched_arm_is_stretched_and_an_aligned_wrist_is_singular() {
    let smallest = |arm: &Arm, q: &[f64]| arm.jacobian(q).singular_values().min();
    for id in ["kuka_kr240", "ur5", "ur10"] {
        let (_, arm) = known(id);
        let stretched = stretched(&arm, &mut Draws::new(14));
        assert!(smallest(&arm, &stretched) < 1e-6, "{id}: {}", smallest(&arm, &stretched));
    }
    let (_, kuka) = known("kuka_kr240");
    let aligned = aligned(&kuka, &mut Draws::new(15));
    assert!(aligned.iter().filter(|q| smallest(&kuka, q) < 1e-12).count() >= 2);
}

/// Every entry is written, whatever was there, and is what the function returns.
#[test]
fn a_large_result_is_written_over_what_was_there() {
    use stiffarm_robots::panda::{Posture, torque_regressor};
    let mut draws = Draws::new(17);
    let [q, qd, qdd]: [[f64; 7]; 3] = core::array::from_fn(|_| draws.array(-3.0, 3.0));
    let mut out = [[f64::NAN; 7]; 70];
    torque_regressor::write(&Posture::new(&q), &qd, &qdd, &mut out);
    assert_eq!(out, torque_regressor(&q, &qd, &qdd));
    let [q, qd, qdd] = [q, qd, qdd].map(|part| part.map(|x| x as f32));
    let mut out = [[f32::NAN; 7]; 70];
    torque_regressor::write(&Posture::new(&q), &qd, &qdd, &mut out);
    assert_eq!(out, torque_regressor(&q, &qd, &qdd));
}
