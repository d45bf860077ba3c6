use nalgebra::{DVector, Matrix3};
use stiffarm_kernels::generic::{Drive, Joint};

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
            inertia: root * root.transpose(),
            drive: Drive::default(),
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

/// In motion: the textbook, which takes each link's force and moment down the chain.
#[test]
fn in_motion_it_is_the_textbooks_inverse_dynamics() {
    let mut dice = Dice::new(3, Stream::Poses);
    for (arm, numbers) in arms() {
        for _ in 0..20 {
            let [q, qd, qdd] = [3.0, 5.0, 20.0]
                .map(|size| (0..4).map(|_| size * dice.between(-1.0, 1.0)).collect::<Vec<f64>>());
            let expected = arm.inverse_dynamics(&q, &qd, &qdd);
            let off = torques(&arm, &numbers, &q, &qd, &qdd) - &expected;
            // A few hundred sums of products up to a thousand.
            assert!(off.amax() < 1e-11 * (1.0 + expected.amax()), "{off}");
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
