//! What a search does where no joint values reach the pose: the nearest posture.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3, Vector6};
use stiffarm_codegen::derive::{AsItIs, Given};
use stiffarm_draws::Draws;
use stiffarm_kernels::{Pose, Steps, generic};

use super::arms::{drawn, reference};
use super::difference;

/// Distance² + tilt², m and twice the sine of half the angle.
fn off(error: &Vector6<f64>) -> f64 {
    let tilt = 2.0 * (error.fixed_rows::<3>(3).norm() / 2.0).sin();
    error.fixed_rows::<3>(0).norm_squared() + tilt * tilt
}

/// Its least value near a posture by the method of Levenberg and Marquardt, which shares no code with the kernels.
fn least(arm: &generic::Arm, pose: &Isometry3<f64>, mut q: [f64; 6]) -> f64 {
    let (mut damping, mut last) = (1e-2, off(&difference(&arm.pose(&q), pose)));
    for _ in 0..200 {
        let mut error = difference(&arm.pose(&q), pose);
        // The slope of tilt²/2 is the sine of the angle.
        let angle = error.fixed_rows::<3>(3).norm();
        if angle > 1e-9 {
            error.fixed_rows_mut::<3>(3).scale_mut(angle.sin() / angle);
        }
        let jacobian = arm.jacobian(&q);
        let mut normal = jacobian.tr_mul(&jacobian);
        (0..6).for_each(|k| normal[(k, k)] += damping);
        let step = normal.lu().solve(&jacobian.tr_mul(&error)).expect("it is damped");
        let next: [f64; 6] = core::array::from_fn(|k| q[k] + step[k] / step.amax().max(1.0));
        let there = off(&difference(&arm.pose(&next), pose));
        match there < last {
            true => (q, last, damping) = (next, there, damping * 0.3),
            false => damping *= 4.0,
        }
        if step.amax() < 1e-9 {
            break;
        }
    }
    last
}

/// So many poses of as many random tables that they cannot have: how often another posture is nearer, of those that the
/// reference implementation's kinematics lead to from so many starts.
fn nearest_of(poses: usize, starts: usize) {
    let mut draws = Draws::new(38);
    let kinds = [["axa"; 6], ["ara"; 6], ["ara", "apa", "ara", "0ra", "ara", "ara"]];
    let (mut beyond, mut nearer, mut worst) = (0, 0, 1.0_f64);
    for k in 0.. {
        if beyond == poses {
            break;
        }
        let robot = drawn(("six axes", kinds[k % 3]), &mut draws);
        let Some(form) = robot.nearest_closed_form().ok().filter(|form| form.is_search()) else {
            continue;
        };
        let forward = reference(&robot);
        let arm = AsItIs::<6>::new(&robot, form, Given::default());
        // From what a turn of the tool puts out of reach to three times as far away as the arm is long.
        let mut toward = || Vector3::from(draws.array::<3>(-1.0, 1.0));
        let (to, turn) = (toward().normalize() * size(&forward), toward() * 3.0);
        let pose = Isometry3::from_parts(
            Translation3::from(to * [0.5, 1.0, 2.0, 3.0][k / 3 % 4]),
            UnitQuaternion::from_scaled_axis(turn),
        );
        let found = arm.solutions(&Pose::from(pose), &[0.0; 6], (None, Steps::MOST));
        let told = found.iter().filter(|branch| branch.distance.is_finite()).collect::<Vec<_>>();
        assert!(!told.is_empty() && told.iter().all(|b| b.q.iter().all(|q| q.is_finite())));
        if told[0].distance.max(told[0].tilt) < 1e-6 {
            continue;
        }
        assert_eq!(told.len(), 1, "{}", robot.to_toml());
        let error = difference(&forward.pose(&told[0].q), &pose);
        let own = off(&error);
        assert!((error.fixed_rows::<3>(0).norm() - told[0].distance).abs() < 1e-9);
        assert!((own - told[0].distance.powi(2) - told[0].tilt.powi(2)).abs() < 1e-9 * own);
        let least = (0..starts).map(|_| least(&forward, &pose, draws.array(-3.1, 3.1)));
        let least = least.fold(f64::INFINITY, f64::min);
        beyond += 1;
        nearer += usize::from(least < own * (1.0 - 1e-6));
        worst = worst.max((own / least).sqrt());
    }
    println!("{nearer} of {beyond} could be nearer, at most {worst:.3} times");
    assert!(nearer * 200 <= beyond, "{nearer} of {beyond}");
}

/// The lengths of all links together.
fn size(arm: &generic::Arm) -> f64 {
    arm.joints.iter().map(|joint| joint.a.hypot(joint.d)).sum::<f64>() / 2.0
}

#[test]
fn a_search_tells_the_nearest_posture_beyond_reach() {
    nearest_of(12, 60);
}

#[test]
#[ignore = "takes minutes"]
fn a_search_tells_the_nearest_posture_at_a_thousand_poses_beyond_reach() {
    nearest_of(1000, 150);
}
