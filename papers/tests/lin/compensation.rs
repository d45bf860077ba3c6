//! After compensation the loaded arm stands where it should.

use nalgebra::{Isometry3, Vector6};
use stiffarm_draws::Draws;
use stiffarm_papers::chain::elastic::Elasticity;
use stiffarm_papers::lin::{
    CompensateError, Damping, Ended, Forward, Options, PlanOptions, compensate, loaded_pose, plan,
};

use crate::arms::{elbow, near, planar, printed_elbow, two_link, weight};

/// Distance and angle between two poses.
fn apart(one: &Isometry3<f64>, other: &Isometry3<f64>) -> (f64, f64) {
    let distance = (one.translation.vector - other.translation.vector).norm();
    (distance, one.rotation.angle_to(&other.rotation))
}

/// Draws reachable targets and loads, with links, springs and weights; by the linear model and by
/// the chain at rest.
#[test]
fn there_and_back() {
    let mut random = Draws::new(5);
    let mut away: f64 = 0.0;
    for round in 0..40 {
        let mut arm = elbow(&printed_elbow(0.0597));
        for joint in &mut arm.joints {
            joint.compliance = random.between(0.0, 1e-5);
            joint.mass = random.between(0.0, 1.0);
        }
        let mut q: [f64; 6] = random.array(-3.0, 3.0);
        // Away from the singular postures.
        (q[2], q[4]) = (random.between(0.4, 2.6), random.between(0.4, 2.6));
        let target = arm.pose(&q);
        let load = Vector6::from(random.array::<6>(-20.0, 20.0));
        let forward = match round % 2 {
            0 => Forward::Linear,
            _ => Forward::Equilibrium(Elasticity::default()),
        };
        let compensation = Options { forward, ..Options::default() };
        let options = PlanOptions { compensation, ..PlanOptions::default() };
        let found = plan(&arm, &target, &load, &options).unwrap();
        let done = &found.compensation;
        assert_eq!(done.ended, Ended::Reached, "{round} {done:?}");
        assert!(done.iterations <= 12, "{}", done.iterations);
        let pose = loaded_pose(&arm, &done.q, &load, forward).unwrap();
        let (distance, angle) = apart(&pose, &target);
        assert!(distance <= 1.1e-9 && angle <= 1.1e-9, "{distance} {angle}");
        let nominal = arm.pose(&found.chosen.solution.q);
        assert!(apart(&nominal, &target).0 < 1e-10);
        for (k, correction) in done.corrections.iter().enumerate() {
            assert!((found.chosen.solution.q[k] + correction - done.q[k]).abs() < 1e-15);
        }
        away = away.max(done.initial_error.norm());
    }
    assert!(away > 0.1, "{away}");
}

/// One correction by J″⁻¹, as in the paper, leaves what is of second order: a quarter under half
/// the load.
#[test]
fn one_correction_leaves_the_second_order() {
    let arm = elbow(&printed_elbow(0.0));
    let q = [0.6, 0.9, -1.4, 2.1, 1.2, -0.4];
    let target = arm.pose(&q);
    let once = Options { iterations: 1, ..Options::default() };
    let left = |p: f64| {
        let done = compensate(&arm, &q, &target, &weight(2, p), &once).unwrap();
        (done.initial_error.fixed_rows::<3>(0).norm(), done.error.fixed_rows::<3>(0).norm())
    };
    let ((before, after), (half, quarter)) = (left(5.0), left(2.5));
    assert!(before > 0.01 && after < 3e-3 * before, "{before} {after}");
    near(before / half, 2.0, 1e-6);
    near(after / quarter, 4.0, 0.02);
}

/// Two joints correct what they can, and the rest is told.
#[test]
fn fewer_joints_leave_a_remainder() {
    let arm = planar(&two_link([0.1, 0.1], 3.05));
    let q = [0.3, 0.8];
    let done = compensate(&arm, &q, &arm.pose(&q), &weight(1, 3.05), &Options::default()).unwrap();
    assert_eq!(done.ended, Ended::Stationary);
    assert!(done.error.norm() > 1e-6 && done.error.norm() < done.initial_error.norm());
    // Out of the plane nothing moves.
    assert!(done.error[2].abs() < 1e-15 && done.error[3].abs() < 1e-15);
}

/// At a singular posture the inverse is damped: bounded corrections, and a remainder.
#[test]
fn a_stretched_arm_is_reported() {
    let arm = elbow(&printed_elbow(0.0597));
    let q = [0.3, 0.2, 0.0, -0.2, 0.9, 0.1];
    let load = Vector6::new(40.0, 10.0, -5.0, 0.0, 0.0, 0.0);
    let mut raised = arm.pose(&q);
    // Beyond the reach of the stretched arm.
    let radial = raised.translation.vector.normalize();
    raised.translation.vector += radial * 0.01;
    let done = compensate(&arm, &q, &raised, &load, &Options::default()).unwrap();
    assert!(done.damped > 0 && done.conditioning < 1e-4, "{done:?}");
    assert_ne!(done.ended, Ended::Reached);
    assert!(done.corrections.iter().all(|correction| correction.abs() < 1.0));
    assert!(done.error.norm() <= done.initial_error.norm());
}

#[test]
fn mistakes_are_errors() {
    let arm = elbow(&printed_elbow(0.0));
    let (q, target) = ([0.3; 6], Isometry3::identity());
    let broken = Vector6::new(0.0, 0.0, f64::NAN, 0.0, 0.0, 0.0);
    let text = compensate(&arm, &q, &target, &broken, &Options::default()).unwrap_err().to_string();
    assert_eq!(text, "a component of the load is not a finite number");
    let text = compensate(&arm, &[0.0; 5], &target, &weight(2, 1.0), &Options::default());
    assert!(text.unwrap_err().to_string().contains("found 5 joint values, expected 6"));
    let damping = Damping { threshold: 0.0, ..Damping::default() };
    let options = Options { damping, ..Options::default() };
    let wrong = compensate(&arm, &q, &target, &weight(2, 1.0), &options).unwrap_err();
    let what = "the threshold of damping";
    assert_eq!(wrong, CompensateError::NotPositive { what, found: 0.0 });
    let far = Isometry3::translation(100.0, 0.0, 0.0);
    let wrong = plan(&arm, &far, &weight(2, 1.0), &PlanOptions::default()).unwrap_err();
    assert!(matches!(wrong, CompensateError::Inverse(_)), "{wrong}");
    // A spring that the load buckles.
    let mut soft = arm.clone();
    soft.joints[1].compliance = 1.0;
    let up = [0.0, std::f64::consts::FRAC_PI_2, 0.0, 0.0, 0.0, 0.0];
    let wrong = loaded_pose(&soft, &up, &weight(2, 5.0), Forward::Linear).unwrap_err();
    assert_eq!(wrong, CompensateError::Unstable);
}
