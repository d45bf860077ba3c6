use nalgebra::{DVector, Matrix3, UnitQuaternion};
use stiffarm_kernels::generic::Joint;

use super::*;

/// Links of random lengths, twists and inertias: of each its numbers about the frame's origin.
fn arm(convention: Convention, motions: &[Motion], dice: &mut Dice) -> (Arm, Vec<f64>) {
    let (mut joints, mut numbers) = (Vec::new(), Vec::new());
    for motion in motions {
        let mut draw = || dice.between(-1.0, 1.0);
        let mass = 2.0 + draw();
        let com = Vector3::new(draw(), draw(), draw());
        let root = Matrix3::from_fn(|_, _| draw());
        // About the origin: Steiner's part of the mass is in it.
        let inertia = root * root.transpose()
            + (Matrix3::identity() * com.norm_squared() - com * com.transpose()) * mass;
        numbers.extend([mass].into_iter().chain((mass * com).iter().copied()));
        numbers.extend(ENTRIES.map(|(row, column)| inertia[(row, column)]));
        joints.push(Joint {
            motion: *motion,
            theta: draw(),
            d: draw(),
            a: draw(),
            alpha: draw(),
            beta: draw(),
            compliance: 0.0,
            mass,
            com,
            limits: None,
            beam: None,
        });
    }
    let arm = Arm {
        name: "random".to_owned(),
        convention,
        joints,
        base: Isometry3::rotation(Vector3::new(0.3, -0.2, 0.5)),
        tool: Isometry3::identity(),
        tool_rotation_vector: Vector3::zeros(),
        gravity: Vector3::new(1.0, -2.0, -9.0),
    };
    (arm, numbers)
}

fn arms() -> Vec<(Arm, Vec<f64>)> {
    let mut dice = Dice::new(1, Stream::Arm);
    let (turns, slides) = (Motion::Revolute, Motion::Prismatic);
    [Convention::Standard, Convention::Modified]
        .into_iter()
        .flat_map(|c| [(c, vec![turns; 4]), (c, vec![turns, slides, turns, slides])])
        .map(|(convention, motions)| arm(convention, &motions, &mut dice))
        .collect()
}

fn torques(arm: &Arm, numbers: &[f64], q: &[f64], qd: &[f64], qdd: &[f64]) -> DVector<f64> {
    let n = arm.dof();
    let rows = regressor(arm, q, qd, qdd);
    DVector::from_fn(n, |j, _| (0..10 * n).map(|k| rows[j * 10 * n + k] * numbers[k]).sum())
}

/// At rest the drives hold the weights: the textbook of the statics.
#[test]
fn at_rest_it_holds_the_weights() {
    for (arm, numbers) in arms() {
        let (q, still) = ([0.4, -0.7, 1.1, 0.2], [0.0; 4]);
        let held = torques(&arm, &numbers, &q, &still, &still) + arm.weight_torque(&q);
        assert!(held.amax() < 1e-12, "{held}");
    }
}

/// The drives' power is the rate of the energy, which is told by frames alone: velocities by
/// differences of frames, energies by Steiner's parts.
#[test]
fn the_drives_power_is_the_rate_of_the_energy() {
    let path = |t: f64| [t.sin(), (1.3 * t).cos(), 0.5 * t * t, (0.7 * t).sin()];
    let rate = |t: f64| [t.cos(), -1.3 * (1.3 * t).sin(), t, 0.7 * (0.7 * t).cos()];
    let second = |t: f64| [-t.sin(), -1.69 * (1.3 * t).cos(), 1.0, -0.49 * (0.7 * t).sin()];
    for (arm, _) in arms() {
        let central = |joint: &Joint, numbers: &[f64]| {
            let whole = Matrix3::new(
                numbers[4], numbers[5], numbers[6], numbers[5], numbers[7], numbers[8], numbers[6],
                numbers[8], numbers[9],
            );
            let com = joint.com;
            whole - (Matrix3::identity() * com.norm_squared() - com * com.transpose()) * joint.mass
        };
        let numbers = &arms().into_iter().find(|(other, _)| *other == arm).unwrap().1;
        let energy = |t: f64| {
            let h = 1e-4;
            let at = |t: f64| arm.frames(&path(t));
            let [before, here, after] = [at(t - h), at(t), at(t + h)];
            let falling = arm.base.rotation * arm.gravity;
            let links = arm.joints.iter().enumerate().map(|(k, joint)| {
                let centre = |frames: &[Isometry3<f64>]| {
                    frames[k + 1].translation.vector + frames[k + 1].rotation * joint.com
                };
                let velocity = (centre(&after) - centre(&before)) / (2.0 * h);
                let turned = after[k + 1].rotation * before[k + 1].rotation.inverse();
                let spin = UnitQuaternion::scaled_axis(&turned) / (2.0 * h);
                let own = here[k + 1].rotation.inverse() * spin;
                let inertia = central(joint, &numbers[10 * k..10 * (k + 1)]);
                0.5 * joint.mass * velocity.norm_squared() + 0.5 * own.dot(&(inertia * own))
                    - joint.mass * falling.dot(&centre(&here))
            });
            links.sum::<f64>()
        };
        for t in [0.3, 1.1, 2.0] {
            let h = 1e-3;
            let power = (energy(t + h) - energy(t - h)) / (2.0 * h);
            let drives = torques(&arm, numbers, &path(t), &rate(t), &second(t));
            let found: f64 = drives.iter().zip(rate(t)).map(|(a, b)| a * b).sum();
            // Differences of second order, h² of derivatives up to a few hundred.
            assert!((found - power).abs() < 1e-3 * (1.0 + power.abs()), "{found} {power}");
        }
    }
}

/// Of a general arm whose base leans, so that gravity reaches the first joint too.
#[test]
fn the_base_is_what_can_be_seen() {
    let mut dice = Dice::new(2, Stream::Arm);
    let (one, _) = arm(Convention::Modified, &[Motion::Revolute], &mut dice);
    // A leaning axis: about it the inertia, and the two first moments across it.
    assert_eq!(Base::of(&one).columns, [1, 2, 9]);
    let (general, _) = arm(Convention::Modified, &[Motion::Revolute; 6], &mut dice);
    // Seven of each link beyond the first (Mayeda, Yoshida & Osuka 1990).
    assert_eq!(Base::of(&general).columns.len(), 3 + 5 * 7);
}
