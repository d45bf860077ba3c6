//! The two-link arm's printed equations against the general functions.

use nalgebra::{Isometry3, Vector6};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention};
use stiffarm_papers::lin::{
    TwoLink, deflections, differential_jacobian, generalized_forces, orientation_jacobian,
    pose_jacobian,
};

use crate::arms::{Links, draws, elbow, near, planar, weight};

fn cases() -> impl Iterator<Item = (TwoLink, [f64; 2])> {
    let mut random = draws(1);
    (0..200).map(move |_| (random.two_link(), random.array(-3.1, 3.1)))
}

/// Eqs. 9-12 and 15-17: the forces at both joints.
#[test]
fn generalized_forces_of_two_links() {
    for (links, q) in cases() {
        let forces = generalized_forces(&planar(&links), &q, &weight(1, links.load)).unwrap();
        let ([_, l2], [w1, w2], p) = (links.lengths, links.weights, links.load);
        let ((s1, c1), c12) = (q[0].sin_cos(), (q[0] + q[1]).cos());
        let down = p + w2 * l2;
        let moment = -p * l2 * c12 - 0.5 * w2 * l2 * l2 * c12;
        let second = Vector6::new(-down * s1, -down * c1, 0.0, 0.0, 0.0, moment);
        let all = down + w1 * links.lengths[0];
        let first = Vector6::new(0.0, -all, 0.0, 0.0, 0.0, links.base_moment(q));
        assert!((forces[1] - second).amax() < 1e-12 && (forces[0] - first).amax() < 1e-11);
    }
}

/// Eqs. 43-45, row 2 of eq. 45 with a plus.
#[test]
fn the_angles_move_the_tool() {
    for (links, q) in cases() {
        let arm = planar(&links);
        let jacobian = differential_jacobian(&arm, &q).unwrap();
        let [l1, l2] = links.lengths;
        let (s2, c2) = q[1].sin_cos();
        let first = Vector6::new(l1 * s2, l2 + l1 * c2, 0.0, 0.0, 0.0, 1.0);
        let second = Vector6::new(0.0, l2, 0.0, 0.0, 0.0, 1.0);
        assert!((jacobian.column(0) - first).amax() < 1e-13);
        assert!((jacobian.column(1) - second).amax() < 1e-13);
        let turned = orientation_jacobian(&arm.pose(&q)) * jacobian;
        let ((s1, c1), (s12, c12)) = (q[0].sin_cos(), (q[0] + q[1]).sin_cos());
        let (a, b) = (0.3, -0.7);
        let moved = &turned * nalgebra::DVector::from_vec(vec![a, b]);
        near(moved[0], -l1 * s1 * a - l2 * s12 * (a + b), 1e-13);
        near(moved[1], l1 * c1 * a + l2 * c12 * (a + b), 1e-13);
        near(moved[5], a + b, 1e-15);
        // The sign that eq. 45 prints is another displacement.
        assert!((moved[1] - (l1 * c1 * a - l2 * c12 * (a + b))).abs() > 1e-4);
    }
}

/// The last component of eq. 38 with the printed sign is not that of a rigid body's motion.
#[test]
fn equation_38_needs_a_minus() {
    let frame = Isometry3::new([0.3, -0.8, 0.5].into(), [0.2, 1.1, 0.1].into());
    let motion = pose_jacobian(&frame).column(5).into_owned();
    let p = frame.translation.vector;
    let a = frame.rotation * nalgebra::Vector3::z();
    near(motion[2], -a.x * p.y + a.y * p.x, 1e-15);
    assert!((motion[2] - (a.x * p.y + a.y * p.x)).abs() > 0.1);
}

/// Eqs. 22, 23, 26-29: each link's own deflection, vertically; eq. 28 with `C1²`.
#[test]
fn equation_28_is_the_oriented_deflection_of_link_1() {
    let mut apart: f64 = 0.0;
    for (links, q) in cases() {
        let all = deflections(&planar(&links), &q, &weight(1, links.load)).unwrap();
        let (first, second) = (all.links[0].twist.y, all.links[1].twist.y);
        near(first, links.link_1(q), 1e-12 * first.abs());
        near(second, links.link_2(q), 1e-12 * second.abs());
        near(all.timoshenko.y, links.timoshenko(q), 1e-12 * all.timoshenko.norm());
        // As printed, with C1³ in the third term.
        let ([l1, l2], w2, c1) = (links.lengths, links.weights[1], q[0].cos());
        let third = 8.0 * w2 * l1.powi(3) * l2 / (24.0 * links.rigidity[0]);
        let printed = links.link_1(q) + third * (c1.powi(2) - c1.powi(3));
        apart = apart.max((printed - first).abs() / first.abs());
    }
    assert!(apart > 0.1, "{apart}");
}

/// Eqs. 31, 32: Castigliano's theorem is the sum of carried deflections; eqs. 34-36 and 46.
#[test]
fn equations_32_35_36_and_46() {
    for (links, q) in cases() {
        let all = deflections(&planar(&links), &q, &weight(1, links.load)).unwrap();
        let size = all.castigliano.norm() + all.angular.norm();
        near(all.castigliano.y, links.castigliano(q), 1e-13 * size);
        near(all.angular.y, links.angular(q), 1e-13 * size);
        let angles = links.joint_angles(q);
        near(all.joint_angles[0], angles[0], 1e-12 * all.joint_angles.norm());
        near(all.joint_angles[1], angles[1], 1e-12 * all.joint_angles.norm());
        // dθ1 is how much the tip of the clamped chain turns.
        near(angles[0], all.castigliano[5], 1e-12 * all.joint_angles.norm());
    }
}

/// `YC = YT + A L2 C12/E1I1`, and what YTD has beyond YC.
#[test]
fn what_is_counted_again() {
    for (links, q) in cases() {
        let all = deflections(&planar(&links), &q, &weight(1, links.load)).unwrap();
        let size = all.castigliano.norm() + all.angular.norm();
        near(links.timoshenko(q) + links.carried(q), links.castigliano(q), 1e-14 * size);
        near(all.carried().y, links.carried(q), 1e-13 * size);
        let ytd = links.timoshenko(q) + links.angular(q);
        near(links.castigliano(q) + links.counted_again(q), ytd, 1e-14 * size);
        near(all.counted_again().y, links.counted_again(q), 1e-13 * size);
        let [a, b] = [0, 1].map(|k| links.moments(q)[k] / links.rigidity[k]);
        near(all.links[0].twist[5], -a, 1e-12 * a.abs());
        near(all.links[1].twist[5], -b, 1e-12 * b.abs());
    }
}

/// An elbow with weights, of either convention, of which one joint may be prismatic, joint values and
/// a load.
fn spatial() -> impl Iterator<Item = (Arm, [f64; 6], Vector6<f64>)> {
    let mut random = draws(6);
    (0..40).map(move |round| {
        let mut arm = elbow(&random.elbow());
        for joint in &mut arm.joints {
            (joint.mass, joint.com) = (random.between(0.0, 1.0), random.array(-1.0, 1.0).into());
        }
        arm.tool = Isometry3::new(random.array(-1.0, 1.0).into(), random.array(-2.0, 2.0).into());
        if round % 2 == 1 {
            arm.convention = Convention::Modified;
        }
        if round % 4 > 1 {
            arm.joints[2].motion = Motion::Prismatic;
        }
        (arm, random.array(-3.0, 3.0), random.array::<6>(-20.0, 20.0).into())
    })
}

/// YC is the textbook's deflection with rigid joints; the moments about the axes are its torques; J''
/// is its Jacobian in tool axes.
#[test]
fn the_papers_sums_are_the_textbook() {
    for (arm, q, load) in spatial() {
        let textbook = arm.deflection_with_gravity(&q, &load).unwrap();
        let sum = deflections(&arm, &q, &load).unwrap();
        assert!((sum.castigliano - textbook).amax() < 1e-12 * textbook.amax());
        assert!((sum.timoshenko + sum.carried() - textbook).amax() < 1e-12 * textbook.amax());
        let jacobian = differential_jacobian(&arm, &q).unwrap() - arm.jacobian_tool(&q);
        assert!(jacobian.amax() < 1e-13 * (1.0 + arm.jacobian(&q).amax()));
        if arm.convention == Convention::Standard {
            let torque = arm.joint_torque(&q, &load) + arm.weight_torque(&q);
            let forces = generalized_forces(&arm, &q, &load).unwrap();
            for ((force, torque), joint) in forces.iter().zip(&torque).zip(&arm.joints) {
                let axis = if joint.motion == Motion::Revolute { 5 } else { 2 };
                near(force[axis], *torque, 1e-11 * (1.0 + force.amax()));
            }
        }
    }
    let (arm, q, load) = spatial().next().unwrap();
    let wrong = generalized_forces(&arm, &q, &(load * f64::NAN)).unwrap_err();
    assert_eq!(wrong.to_string(), "a component of the load is not a finite number");
    assert!(generalized_forces(&arm, &q[..2], &load).is_err());
    assert!(differential_jacobian(&arm, &[0.0]).is_err());
}

/// Eq. 5 element by element; eq. 25 turns and moves nothing.
#[test]
fn the_jacobians_of_a_frame_are_as_printed() {
    let frame = Isometry3::new([0.3, -0.7, 0.4].into(), [1.1, -0.6, 0.9].into());
    let (jacobian, p) = (pose_jacobian(&frame), frame.translation.vector);
    for k in 0..3 {
        let axis = frame.rotation * nalgebra::Vector3::ith(k, 1.0);
        let lever = p.cross(&axis);
        for j in 0..3 {
            near(jacobian[(k, j)], axis[j], 1e-15);
            near(jacobian[(k, j + 3)], lever[j], 1e-15);
            assert_eq!(jacobian[(k + 3, j)], 0.0);
            near(jacobian[(k + 3, j + 3)], axis[j], 1e-15);
        }
    }
    let turn = orientation_jacobian(&frame);
    assert!((turn * turn.transpose() - nalgebra::Matrix6::identity()).amax() < 1e-15);
    assert_eq!(turn.fixed_view::<3, 3>(3, 0).amax() + turn.fixed_view::<3, 3>(0, 3).amax(), 0.0);
}
