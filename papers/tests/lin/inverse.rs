//! All inverse solutions of elbow manipulators.

use crate::method::{InverseError, Missing, ParallelElbow};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use stiffarm_draws::Draws;
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention};

use crate::arms::{draws, elbow, printed_elbow};

/// The larger of the position's and the rotation's miss.
fn miss(arm: &Arm, q: &[f64], target: &Isometry3<f64>) -> f64 {
    (arm.pose(q).to_homogeneous() - target.to_homogeneous()).amax()
}

/// Any arm of the kind: offsets everywhere, right angles of either sense, offsets of the zero, a
/// turned tool, lengths of either sign.
fn any(random: &mut Draws) -> Arm {
    let mut arm = elbow(&printed_elbow(0.0));
    let quarter = std::f64::consts::FRAC_PI_2;
    let mut right = || if random.between(0.0, 1.0) < 0.5 { quarter } else { -quarter };
    let alphas = [right(), 0.0, 0.0, right(), right()];
    for (row, alpha) in arm.joints.iter_mut().zip(alphas) {
        row.alpha = alpha;
    }
    for row in &mut arm.joints {
        row.beam = None;
        (row.theta, row.d) = (random.between(-2.0, 2.0), random.between(-0.2, 0.2));
        row.a = random.between(-0.3, 0.3);
    }
    arm.joints[1].a = random.between(0.5, 1.0);
    arm.joints[2].a = -random.between(0.5, 1.0);
    arm.joints[4].a = 0.0;
    arm.joints[5].alpha = random.between(-1.0, 1.0);
    arm.tool = Isometry3::new(
        Vector3::from(random.array(-0.2, 0.2)),
        Vector3::from(random.array(-1.0, 1.0)),
    );
    arm
}

/// From joint values to the pose and back: the joint values are among the solutions, and every
/// solution has that pose to 1e-12.
#[test]
fn all_solutions_of_random_arms() {
    let mut random = draws(3);
    let mut eight = 0;
    for _ in 0..500 {
        let arm = any(&mut random);
        let q: [f64; 6] = random.array(-3.1, 3.1);
        let target = arm.pose(&q);
        let found = ParallelElbow::new(&arm).unwrap().solve(&target).unwrap();
        let turn = |a: f64, b: f64| ((a - b) / 2.0).sin().abs();
        let apart = |s: &[f64; 6]| (0..6).map(|k| turn(s[k], q[k])).fold(0.0, f64::max);
        let nearest = found.solutions.iter().map(|s| apart(&s.q)).fold(1.0, f64::min);
        assert!(nearest < 1e-7, "{nearest} {q:?}");
        for solution in &found.solutions {
            assert!(miss(&arm, &solution.q, &target) < 1e-12 && solution.residual < 1e-12);
            assert!(solution.q.iter().all(|angle| angle.abs() <= std::f64::consts::PI));
        }
        for (k, one) in found.solutions.iter().enumerate() {
            assert!(found.solutions[..k].iter().all(|other| other.branch != one.branch));
        }
        eight += usize::from(found.solutions.len() == 8);
    }
    assert!(eight > 200, "{eight}");
}

/// Near singular postures the joint values are uncertain, but not the pose.
#[test]
fn near_singular_postures() {
    let arm = elbow(&printed_elbow(0.0));
    for small in [1e-2, 1e-4, 1e-6, 1e-8] {
        for (joint, value) in [(4, small), (4, 3.0), (2, small), (2, -small)] {
            let mut q = [0.3, 0.5, 1.2, -0.2, 1.1, 0.4];
            q[joint] = value;
            let pose = arm.pose(&q);
            let found = ParallelElbow::new(&arm).unwrap().solve(&pose).unwrap();
            assert!(found.solutions.iter().all(|s| s.residual < 1e-12), "{joint} {value}");
        }
    }
}

/// The Universal Robots arms are of this kind: three parallel axes and offsets along them.
#[test]
fn the_collections_arms() {
    for id in ["lin_elbow", "ur5", "ur10"] {
        let arm = stiffarm_papers::methods::arm(id).unwrap();
        let pose = arm.pose(&[0.3, -1.1, 1.4, 0.5, 0.8, -0.6]);
        let found = ParallelElbow::new(&arm).unwrap().solve(&pose).unwrap();
        assert_eq!(found.solutions.len() + found.missing.len() * 2, 8, "{}", arm.name);
        assert!(found.solutions.iter().all(|s| miss(&arm, &s.q, &pose) < 1e-12));
    }
}

fn target(x: f64, y: f64, z: f64, turn: Vector3<f64>) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::new(x, y, z), UnitQuaternion::from_scaled_axis(turn))
}

#[test]
fn out_of_reach_is_said_with_numbers() {
    let arm = elbow(&printed_elbow(0.0));
    let solver = ParallelElbow::new(&arm).unwrap();
    let wrong = solver.solve(&target(80.0, 0.0, 0.0, Vector3::zeros())).unwrap_err();
    let InverseError::Unreachable { missing } = &wrong else { panic!("{wrong}") };
    assert!(missing.iter().all(|why| matches!(why, Missing::Reach { farthest: 48.0, .. })));
    let text = wrong.to_string();
    assert!(text.starts_with("the target has no inverse solution: axis 4 must stand "), "{text}");
    let mut offset = arm.clone();
    offset.joints[3].d = 5.0;
    let near = target(1.0, 2.0, 20.0, Vector3::new(0.3, 0.2, 0.1));
    let wrong = ParallelElbow::new(&offset).unwrap().solve(&near).unwrap_err().to_string();
    assert!(wrong.contains("nearer than the offset 5e0"), "{wrong}");
    let broken = target(f64::NAN, 0.0, 0.0, Vector3::zeros());
    assert_eq!(solver.solve(&broken), Err(InverseError::NotFinite));
}

#[test]
fn singular_branches_are_named() {
    let arm = elbow(&printed_elbow(0.0));
    let solver = ParallelElbow::new(&arm).unwrap();
    let why = |pose: &Isometry3<f64>| match solver.solve(pose) {
        Err(InverseError::Unreachable { missing }) => missing[0],
        other => panic!("{other:?}"),
    };
    assert_eq!(why(&target(0.0, 0.0, 33.5, Vector3::zeros())), Missing::Shoulder);
    // θ5 = 0: axis 6 along axes 2 to 4.
    assert_eq!(why(&arm.pose(&[0.3, 0.5, 0.9, -0.2, 0.0, 0.4])), Missing::Wrist);
    // Links 2 and 3 folded onto each other: only the branch with that elbow is lost.
    let folded = [0.3, 0.5, std::f64::consts::PI, -0.2, 1.1, 0.4];
    let found = solver.solve(&arm.pose(&folded)).unwrap();
    assert!(found.missing.contains(&Missing::Elbow) && found.solutions.len() < 8);
    // A stretched elbow is no obstacle: two branches meet.
    let stretched = [0.3, 0.5, 0.0, -0.2, 1.1, 0.4];
    let pose = arm.pose(&stretched);
    let found = solver.solve(&pose).unwrap();
    assert!(found.solutions.iter().all(|s| miss(&arm, &s.q, &pose) < 1e-10));
}

#[test]
fn other_arms_are_refused() {
    let arm = elbow(&printed_elbow(0.0));
    let text = |arm: &Arm| ParallelElbow::new(arm).unwrap_err().to_string();
    let change = |change: &dyn Fn(&mut Arm)| {
        let mut arm = arm.clone();
        change(&mut arm);
        text(&arm)
    };
    assert_eq!(
        change(&|arm| arm.joints[2].alpha = 0.1),
        "this is not an elbow manipulator: alpha of row 3 is not 0"
    );
    assert!(change(&|arm| arm.convention = Convention::Modified).contains("modified"));
    assert!(change(&|arm| arm.joints.truncate(5)).contains("5 joints, expected 6"));
    assert!(
        change(&|arm| arm.joints[1].motion = Motion::Prismatic).contains("joint 2 is prismatic")
    );
    assert!(change(&|arm| arm.joints[4].a = 0.1).contains("axes 5 and 6 do not meet"));
    assert!(change(&|arm| arm.joints[0].alpha = 0.0).contains("row 1 is not a right angle"));
    assert!(change(&|arm| arm.joints[1].a = 0.0).contains("a of row 2 is 0"));
    assert!(change(&|arm| arm.joints[3].a = f64::NAN).contains("row 4 has a number that"));
}
