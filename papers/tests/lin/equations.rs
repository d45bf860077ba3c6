//! The paper's equations against the general functions.

use std::collections::HashMap;

use crate::method::{
    deflections, differential_jacobian, generalized_forces, orientation_jacobian, pose_jacobian,
};
use nalgebra::{Isometry3, Vector6};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention};

use crate::arms::{Links, draws, elbow, near, planar, weight};
use crate::printed::Printed;

/// What an equation should say is what the functions find; both are of the size `size`.
fn same(printed: &Printed, number: &str, values: &HashMap<String, f64>, found: &[f64], size: f64) {
    let wanted = printed.entries(number, values);
    assert_eq!(wanted.len(), found.len(), "{number}");
    for (wanted, found) in wanted.iter().zip(found) {
        assert!((wanted - found).abs() <= 1e-11 * size, "{number}: {found} is not {wanted}");
    }
}

/// Eqs. 15-17: the forces at both joints; 27, 28: each link's own deflection; 32: Castigliano's
/// theorem; 35, 36: the joints' angles; 43-46: what they do to the tool. And what YTD counts again:
/// `YC = YT + A L2 C12/E1I1`, `YT + YD = YC + A L1 C1/E1I1 + B (L1 C1 + 2 L2 C12)/E2I2`.
#[test]
fn the_two_link_arm() {
    let (printed, mut random) = (Printed::of("lin1991/equations.toml"), draws(1));
    for _ in 0..20 {
        let (links, q) = (Links::<2>::drawn(&mut random), random.array::<2>(-3.1, 3.1));
        let (arm, load) = (planar(&links), weight(1, links.load));
        let mut values = links.values([("L1", 1), ("L2", 2)], &q);
        let all = deflections(&arm, &q, &load).unwrap();
        let forces = generalized_forces(&arm, &q, &load);
        let jacobian = differential_jacobian(&arm, &q);
        let moved = |turned: nalgebra::Matrix6<f64>| turned * &jacobian * &all.joint_angles;
        let in_tool = moved(nalgebra::Matrix6::identity());
        let in_base = moved(orientation_jacobian(&arm.pose(&q)));
        for name in ["A", "B"] {
            let value = printed.entries(&format!("(35) {name}"), &values)[0];
            values.insert(name.into(), value);
        }
        values.insert("dtheta1".into(), all.joint_angles[0]);
        values.insert("dtheta2".into(), all.joint_angles[1]);
        values.insert("mz".into(), forces[0][5]);
        let rows: Vec<f64> = jacobian.transpose().iter().copied().collect();
        let size = all.castigliano.norm() + all.angular.norm();
        for (number, found, size) in [
            ("(15)", forces[1].as_slice(), forces[1].norm()),
            ("(16)", forces[0].as_slice(), forces[0].norm()),
            ("(17)", &[forces[0][5]], forces[0].norm()),
            ("(27)", &[all.links[1].twist.y], size),
            ("(28)", &[all.links[0].twist.y], size),
            ("(32)", &[all.castigliano.y], size),
            ("(35)", &[all.joint_angles[0]], all.joint_angles.norm()),
            ("(36)", &[all.joint_angles[1]], all.joint_angles.norm()),
            ("(43)", &rows, jacobian.norm()),
            ("(44)", in_tool.as_slice(), in_tool.norm()),
            ("(45)", in_base.as_slice(), in_base.norm()),
            ("(46)", &[all.angular.y], size),
        ] {
            same(&printed, number, &values, found, size);
        }
        let [a, b] = [0, 1].map(|k| values[["A", "B"][k]] / links.rigidity[k]);
        let (r1, r2) = (links.lengths[0] * q[0].cos(), links.lengths[1] * (q[0] + q[1]).cos());
        near(all.carried().y, -a * r2, 1e-11 * size);
        near(all.counted_again().y, -a * r1 - b * (r1 + 2.0 * r2), 1e-11 * size);
    }
}

/// The appendix term by term: dy2, each link's own deflection, and dy1, what the turn of one link's
/// tip does through the joints before it.
#[test]
fn the_elbow() {
    let (printed, mut random) = (Printed::of("lin1991/equations.toml"), draws(2));
    for _ in 0..5 {
        let (links, q) = (Links::<4>::drawn(&mut random), random.array::<6>(-3.1, 3.1));
        let (arm, load) = (elbow(&links), weight(2, links.load));
        let names = [("a2", 2), ("a3", 3), ("a4", 4), ("d6", 6)];
        let mut values = links.values(names, &q);
        for name in ["B", "C", "D"] {
            let value = printed.entries(&format!("App. {name}"), &values)[0];
            values.insert(name.into(), value);
        }
        let all = deflections(&arm, &q, &load).unwrap();
        for (link, (_, row)) in all.links.iter().zip(names) {
            assert_eq!(link.row, row);
            let own = format!("App. dy_2, E_{row}I_{row} term");
            same(&printed, &own, &values, &[link.twist.z], link.twist.norm());
            let mut alone = arm.clone();
            for joint in &mut alone.joints {
                if let Some(beam) = &mut joint.beam {
                    (beam.iy, beam.iz, beam.j) = (1e20, 1e20, 1e20);
                }
            }
            alone.joints[row - 1].beam = arm.joints[row - 1].beam.clone();
            let yd = deflections(&alone, &q, &load).unwrap().angular;
            let angular = format!("App. dy_1, E_{row}I_{row} term");
            same(&printed, &angular, &values, &[yd.z], yd.norm());
        }
    }
}

/// Eq. 38: the motion about an axis, its last component with a minus.
#[test]
fn equation_38() {
    let printed = Printed::of("lin1991/equations.toml");
    let frame = Isometry3::new([0.3, -0.8, 0.5].into(), [0.2, 1.1, 0.1].into());
    let turn = frame.rotation.to_rotation_matrix();
    let mut values = HashMap::new();
    for (c, letter) in "noa".chars().enumerate() {
        for (r, axis) in "xyz".chars().enumerate() {
            values.insert(format!("{letter}{axis}"), turn[(r, c)]);
            values.insert(format!("p{axis}"), frame.translation.vector[r]);
        }
    }
    let motion = pose_jacobian(&frame).column(5).into_owned();
    for (k, unit) in ["i", "j", "k"].into_iter().enumerate() {
        values.extend(["i", "j", "k"].map(|other| (other.into(), f64::from(other == unit))));
        same(&printed, "(38)", &values, &[motion[k]], 1.0);
        same(&printed, "(39)", &values, &[motion[k + 3]], 1.0);
    }
}

/// An elbow with weights, of either convention, of which one joint may be prismatic, joint values and
/// a load.
fn spatial() -> impl Iterator<Item = (Arm, [f64; 6], Vector6<f64>)> {
    let mut random = draws(6);
    (0..40).map(move |round| {
        let mut arm = elbow(&Links::drawn(&mut random));
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
        let jacobian = differential_jacobian(&arm, &q) - arm.jacobian_tool(&q);
        assert!(jacobian.amax() < 1e-13 * (1.0 + arm.jacobian(&q).amax()));
        if arm.convention == Convention::Standard {
            let torque = arm.joint_torque(&q, &load) + arm.weight_torque(&q);
            let forces = generalized_forces(&arm, &q, &load);
            for ((force, torque), joint) in forces.iter().zip(&torque).zip(&arm.joints) {
                let axis = if joint.motion == Motion::Revolute { 5 } else { 2 };
                near(force[axis], *torque, 1e-11 * (1.0 + force.amax()));
            }
        }
    }
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
