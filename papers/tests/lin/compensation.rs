//! Corrections of the joints: what they leave, and what cannot be corrected.

use crate::method::{CompensateError, Measure, Model, correction, plan};
use nalgebra::{DVector, Isometry3, Vector6};
use stiffarm_gap::simulate::equilibrium;
use stiffarm_kernels::generic::Arm;

use crate::arms::{draws, elbow, near, planar, printed_elbow, two_link, weight};

/// One correction by J″⁻¹, as in the paper, leaves what is of second order: a quarter under half the
/// load, by the simulation.
#[test]
fn one_correction_leaves_the_second_order() {
    let mut random = draws(5);
    for round in 0..20 {
        let mut arm = elbow(&printed_elbow(0.0));
        for joint in &mut arm.joints {
            joint.compliance = random.between(0.0, 1e-6);
        }
        let mut q: [f64; 6] = random.array(-3.0, 3.0);
        // Away from the singular postures.
        (q[2], q[4]) = (random.between(0.4, 2.6), random.between(0.4, 2.6));
        let target = arm.pose(&q);
        let load = Vector6::from(random.array::<6>(-5.0, 5.0));
        let missed = |q: &[f64], load: &Vector6<f64>| {
            let tool = equilibrium(&arm, q, load).unwrap().tool;
            (tool.translation.vector - target.translation.vector).norm()
        };
        let left = |part: f64| {
            let load = load * part;
            let found = plan(&arm, &target, &load, Model::Whole, Measure::Translation).unwrap();
            let chosen = DVector::from_column_slice(&found.chosen.solution.q);
            let mended = &chosen - &found.add.joints;
            assert!(found.add.left.amax() < 1e-12);
            (missed(chosen.as_slice(), &load), missed(mended.as_slice(), &load))
        };
        let ((before, after), (half, quarter)) = (left(0.1), left(0.05));
        assert!(before > 1e-4 && after < 0.02 * before, "{round}: {before} {after}");
        near(before / half, 2.0, 0.01);
        near(after / quarter, 4.0, 0.05);
    }
}

/// Two joints correct what they can, and the rest is told; a stretched arm stays bounded.
#[test]
fn what_the_joints_can_do_is_done_and_the_rest_is_told() {
    let arm = planar(&two_link([0.1, 0.1], 3.05));
    let change = DVector::from_vec(vec![1e-3, -2e-3]);
    let displacement = arm.jacobian_tool(&[0.4, -0.9]) * &change;
    let found = correction(&arm, &[0.4, -0.9], &displacement);
    assert!((found.joints - change).amax() < 1e-15 && found.left.amax() < 1e-14);
    let out = Vector6::new(0.0, 0.0, 0.0, 1.0, 0.0, 0.0);
    near(correction(&arm, &[0.4, -0.9], &out).left.norm(), 1.0, 1e-12);
    let along = Vector6::new(1e-3, 0.0, 0.0, 0.0, 0.0, 0.0);
    let stretched = correction(&arm, &[0.2, 0.0], &along);
    assert!(stretched.joints.amax() < 1e-12);
    near(stretched.left.norm(), 1e-3, 1e-12);
}

#[test]
fn what_cannot_be_planned_is_an_error() {
    let arm = elbow(&printed_elbow(0.0));
    let of = |arm: &Arm, target: &Isometry3<f64>| {
        plan(arm, target, &weight(2, 5.0), Model::Whole, Measure::Translation).unwrap_err()
    };
    let wrong = of(&arm, &Isometry3::translation(100.0, 0.0, 0.0));
    assert!(matches!(wrong, CompensateError::Inverse(_)), "{wrong}");
    // A spring that the load buckles.
    let mut soft = arm.clone();
    soft.joints[1].compliance = 1.0;
    let up = soft.pose(&[0.0, std::f64::consts::FRAC_PI_2, 0.0, 0.3, 0.4, 0.0]);
    let wrong = of(&soft, &up);
    assert!(matches!(wrong, CompensateError::Unstable(_)), "{wrong}");
}
