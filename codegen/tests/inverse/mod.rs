//! The closed forms of the inverse kinematics, by evaluation of their graphs: against the reference implementation's forward
//! kinematics, and against a solver that knows nothing of branches.

mod arms;
mod beyond;
mod chosen;
mod short;
mod steps;

use std::collections::BTreeSet;

use nalgebra::{Isometry3, Vector3, Vector6};

use arms::{Arm, Branch, FAMILIES, OTHERS, collection, random};
use stiffarm_codegen::robot::{FileError, Motion, Robot};
use stiffarm_draws::{Draws, few_or_many};

/// From the pose to another: translation and rotation vector, base axes.
fn difference(from: &Isometry3<f64>, to: &Isometry3<f64>) -> Vector6<f64> {
    let translation = to.translation.vector - from.translation.vector;
    let rotation: Vector3<f64> = (to.rotation * from.rotation.inverse()).scaled_axis();
    Vector6::new(translation.x, translation.y, translation.z, rotation.x, rotation.y, rotation.z)
}

/// How far two postures are apart, whole turns left out.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let whole = |x: f64| (x / core::f64::consts::TAU).round() * core::f64::consts::TAU;
    a.iter().zip(b).map(|(a, b)| (a - b - whole(a - b)).abs()).fold(0.0, f64::max)
}

/// Every branch reaches the pose where it says so, and else misses it by the distance that it says. The number of those that
/// reach it, and the largest error of them relative to the arm's size, rad.
fn check(arm: &Arm, pose: &Isometry3<f64>, near: &[f64]) -> (usize, f64) {
    let (mut reached, mut worst) = (0, 0.0_f64);
    for branch in arm.branches(pose, near) {
        assert!(branch.q.iter().all(|x| x.is_finite()), "{}: {pose} {:?}", arm.name, branch.q);
        let error = difference(&arm.pose(&branch.q), pose);
        let (position, rotation) =
            (error.fixed_rows::<3>(0).norm(), error.fixed_rows::<3>(3).norm());
        if let Some(joint) = arm.form.given {
            assert_eq!(branch.q[joint].to_bits(), near[joint].to_bits(), "{}", arm.name);
        }
        let six = arm.robot.dof() >= 6;
        if !six {
            let off = (position - branch.distance).abs() / arm.size();
            let tilt = 2.0 * (rotation / 2.0).sin();
            let turned = (tilt - branch.tilt).abs();
            assert!(off < 1e-10 && turned < 1e-10, "{}: {off:e} {turned:e}", arm.name);
        }
        // An orientation that is missed takes the position with it.
        if six && branch.tilt < 1e-10 {
            let off = (position - branch.distance).abs() / arm.size() + rotation;
            assert!(off < 1e-10, "{}: {pose}: {off:e} {}", arm.name, branch.distance);
        }
        let within = within(arm);
        if branch.distance < within * arm.size() && branch.tilt < within {
            reached += 1;
            worst = worst.max(position / arm.size() + rotation);
        }
    }
    (reached, worst)
}

/// What a branch that reaches its pose may miss it by. Of six joints the last ones undo what an elbow near a double root is off by;
/// fewer miss the pose by the square root of rounding there.
fn within(arm: &Arm) -> f64 {
    if arm.robot.dof() < 6 { 1e-6 } else { 1e-10 }
}

/// How far a posture is from the nearest branch at its pose.
fn from_branches(arm: &Arm, q: &[f64], near: &[f64]) -> f64 {
    let branches = arm.branches(&arm.pose(q), near);
    branches.iter().map(|branch| apart(&branch.q, q)).fold(f64::INFINITY, f64::min)
}

/// All arms: those of the collection, and some of each family.
fn all(each: usize, seed: u64) -> impl Iterator<Item = Arm> {
    let mut draws = Draws::new(seed);
    let six = FAMILIES.map(|(name, rows)| (name, rows.to_vec()));
    let families = six.into_iter().chain(OTHERS.map(|(name, rows)| (name, rows.to_vec())));
    let families = families.flat_map(move |family| core::iter::repeat_n(family, each));
    collection().into_iter().chain(families.map(move |family| random(family, &mut draws)))
}

#[test]
fn the_collection_has_these_closed_forms() {
    let names: Vec<String> = collection().iter().map(|arm| arm.name.clone()).collect();
    let closed = [
        "Bicchi & Melchiorri planar 3R arm",
        "FANUC S-420F",
        "KUKA LBR iiwa 14 R820",
        "ABB IRB 120",
        "KUKA KR 240-2",
        "Lin 1991 elbow manipulator",
        "Lin 1991 two-link planar arm",
        "Franka Emika Panda",
        "PUMA 560",
        "Stanford arm",
        "Staubli TX2-90L",
        "UR10",
        "UR10e",
        "UR3e",
        "UR5",
        "UR5e",
    ];
    assert_eq!(names, closed);
}

/// What stands in the way is told where the inverse is asked for, and what is asked for is written down again.
#[test]
fn an_arm_without_a_closed_form_is_refused() {
    let file = |rows: &str| {
        let head = "name = \"arm\"\nconvention = \"standard\"\noutputs = [\"pose\", \"inverse_kinematics\"]\n";
        Robot::from_toml(&format!("{head}joint = [\n{rows}\n]\n"), "arm.toml")
    };
    let row = |cells: &str| format!("{{ type = \"revolute\", {cells} }}");
    let arm = |cells: [&str; 6]| file(&cells.map(row).join(",\n"));
    let wrist = ["alpha = \"pi/2\", d = 0.4", "alpha = \"-pi/2\"", "d = 0.1"];
    let with = |first: [&str; 3]| arm([first[0], first[1], first[2], wrist[0], wrist[1], wrist[2]]);
    let plain = ["alpha = \"pi/2\"", "a = 0.5", "a = 0.1, alpha = \"pi/2\""];
    let (robot, _) = with(plain).expect("a closed form");
    let again = Robot::from_toml(&robot.to_toml(), "arm.toml").expect("the same").0;
    assert_eq!(
        (again.inverse_kinematics, again.asked()),
        (robot.inverse_kinematics, robot.asked())
    );
    let refused = |text: Result<(Robot, _), FileError>, why: &str| {
        let told = format!("{:?}", text.expect_err("no closed form").errors);
        assert!(told.contains(why), "{told}");
    };
    refused(file(&row("a = 1")), "the arm has 1 joints");
    let plane = [row("a = 1"), row("a = 1"), row("a = 1"), row("a = 1")].join(",\n");
    refused(file(&plane), "axes 1, 2, 3 are parallel");
    let slide = "type = \"prismatic\", theta = 0.3";
    let slides = format!("{{ {slide} }},\n{{ {slide} }},\n{}", row("a = 1"));
    refused(file(&slides), "do not move the wrist's point in all directions");
    let (beta, length) = ("a = 0.5, beta = 0.1", "a = \"a1\", alpha = \"pi/2\"");
    refused(with([length, beta, plain[2]]), "the row of `joint 2` has a beta");
    let searched = with([plain[0], beta, plain[2]]).expect("a search").0;
    assert!(searched.inverse_kinematics.is_some_and(|form| form.is_search()));
    let skew = "a = 0.5, alpha = 0.3";
    refused(with(["a = \"a1\", alpha = \"pi/2\"", skew, plain[2]]), "none is parallel to the next");
    refused(with([plain[0], "alpha = \"pi/2\"", plain[2]]), "axes 1, 2, 3 meet in a point");
}

/// Postures of every arm are branches of their poses: so many of each of the collection, and so many of so many tables of
/// each kind.
///
/// Errors: of nearly all postures they are below 2e-7, and of the poses 1e-11. Within some 1e-6 of a double root, such as the stretched
/// elbow of an iiwa, where joints 3 and 5 turn about one line, postures are known to less.
fn postures_of(count: usize, (kinds, each): (usize, usize)) {
    let mut draws = Draws::new(1);
    let [mut short, mut off_by_roots, mut postures, mut blurred] = [0; 4];
    for arm in all(kinds, 11) {
        for _ in 0..if arm.name.contains('\n') { each } else { count } {
            let q = arm.posture(&mut draws);
            let near = arm.near(&q, &mut draws);
            let (reached, _) = check(&arm, &arm.pose(&q), &near);
            assert!(reached > 0, "{}: {q:?}", arm.name);
            if arm.robot.dof() < 6 {
                let branches = arm.branches(&arm.pose(&q), &near);
                let least = branches.iter().map(|b| b.distance.max(b.tilt));
                short += 1;
                off_by_roots += usize::from(least.fold(f64::INFINITY, f64::min) > 1e-10);
            }
            let off = from_branches(&arm, &q, &near);
            postures += 1;
            blurred += usize::from(off > 1e-6);
        }
    }
    println!("{blurred} of {postures} postures are off by more than 1e-6");
    assert!(blurred * 10_000 < postures, "{blurred} of {postures}");
    // Near a double root, and nowhere else.
    println!("{off_by_roots} of {short} poses of fewer joints are missed by more than 1e-10");
    assert!(off_by_roots * 1000 < short, "{off_by_roots} of {short}");
}

#[test]
fn postures_are_branches_of_their_poses() {
    postures_of(few_or_many(500, 2000), (few_or_many(10, 40), 50));
}

#[test]
#[ignore = "takes minutes"]
fn a_hundred_thousand_postures_are_branches_of_their_poses() {
    postures_of(100_000, (40, 50));
}

#[test]
#[ignore = "takes minutes"]
fn postures_of_a_thousand_tables_of_each_kind_are_branches() {
    postures_of(1000, (1000, 10));
}

/// Joints at whole quarter turns, of which the axes are aligned in all ways, and within 1e-12 and 1e-9 of them.
#[test]
fn aligned_postures_are_reached_and_free_joints_stay() {
    let mut draws = Draws::new(4);
    let (mut worst, mut all_of_them, mut beside) = (0.0_f64, 0, 0);
    let (mut singular, mut turned) = (0, 0);
    for arm in all(6, 14) {
        for k in 0..if arm.name.contains('\n') { 200 } else { few_or_many(600, 4096) } {
            let n = arm.robot.dof();
            let only = draws.chance(0.5).then(|| (n as f64 * draws.part()) as usize);
            let mut exact = |joint: usize| {
                let quarters = (draws.part() * 5.0).floor() - 2.0;
                let aligned = only.map_or(draws.chance(0.6), |only| only == joint);
                let free = 3.0 * draws.unit();
                let turn = if aligned { quarters * core::f64::consts::FRAC_PI_2 } else { free };
                match arm.reference.joints[joint].motion {
                    Motion::Revolute => turn - arm.reference.joints[joint].theta,
                    Motion::Prismatic if aligned => 0.0,
                    Motion::Prismatic => free / 3.0,
                }
            };
            let exact: Vec<f64> = (0..n).map(&mut exact).collect();
            let by = [0.0, 1e-12, 1e-9, 1e-15][k % 4];
            let q: Vec<f64> = exact.iter().map(|q| q + by * draws.unit()).collect();
            let pose = arm.pose(&q);
            let near = arm.near(&q, &mut draws);
            check(&arm, &pose, &near);
            let (reached, error) = check(&arm, &pose, &q);
            // Of two singularities the square root of the one's rounding is what the other is off by; of more, which leave the
            // Jacobian two directions short, an arm with three parallel axes can miss the pose, and says so.
            let (inner, rest) = arm.inner(&q);
            let mut values = inner.jacobian(&rest).singular_values();
            values.as_mut_slice().sort_by(f64::total_cmp);
            let missed = |branch: &Branch| branch.distance / arm.size() + branch.tilt;
            let least = arm.branches(&pose, &q).iter().map(missed).fold(f64::INFINITY, f64::min);
            if values[1] > 1e-6 {
                all_of_them += 1;
                beside += usize::from(least > 1e-5);
                worst = worst.max(least);
            }
            // A double root is known to the square root of rounding.
            if by == 0.0 && only.is_some() {
                assert!(reached > 0 && error < within(&arm), "{}: {q:?}: {error:e}", arm.name);
                // Next to a second singularity, such as an elbow within a milliradian of stretched, a joint that is free but for
                // rounding is found, and not left.
                let [second, most] = [values[1], values.max()];
                let off = from_branches(&arm, &q, &q);
                singular += 1;
                turned += usize::from(off > 1e-5 && n > 1 && second > 0.03 * most);
                assert!(off < 1e-5 || n > 1 && second < 0.3 * most, "{}: {q:?}: {off:e}", arm.name);
            }
        }
    }
    println!("{turned} of {singular} free joints turn");
    assert!(turned * 1000 < singular, "{turned} of {singular}");
    // Of three parallel axes within 1e-12 of two singularities, a few in a hundred thousand: 2e-4 at most.
    println!("{beside} of {all_of_them} are missed by more than 1e-5, at most by {worst:.1e}");
    assert!(worst < 1e-3 && beside * 10_000 < all_of_them, "{worst:e} {beside} of {all_of_them}");
}

/// The point where the last axes meet on the first axis, far out, and at the shoulder.
#[test]
fn poses_that_are_not_reached_are_missed_by_what_is_told() {
    let mut draws = Draws::new(5);
    for arm in all(10, 15) {
        for k in 0..60 {
            let (q, near) = (arm.posture(&mut draws), arm.posture(&mut draws));
            let frames = arm.reference.frames(&q);
            let point = frames[q.len() - 1].translation.vector;
            let (origin, axis) = (frames[0].translation.vector, frames[0] * Vector3::z());
            let along = axis * (point - origin).dot(&axis);
            let to = match k % 4 {
                0 => origin + along,
                1 => point + (point - origin) * 10.0,
                2 => origin + axis * arm.reference.joints[0].d,
                _ => origin + along + (point - origin - along) * 1e-12,
            };
            let mut pose = arm.pose(&q);
            pose.translation.vector += to - point;
            check(&arm, &pose, &near);
        }
    }
}

/// What the reference implementation finds by search, and no other, is what the branches reach, at so many poses of each arm
/// of the collection, and of so many tables of each kind.
fn solutions_at(poses: usize, tables: usize) {
    let mut draws = Draws::new(3);
    let [mut all_of_them, mut missing] = [0, 0];
    for arm in all(tables, 13) {
        for _ in 0..poses {
            let q = arm.posture(&mut draws);
            let pose = arm.pose(&q);
            let (inner, _) = arm.inner(&q);
            let starts = if arm.form.given.is_some() { 1600 } else { 400 };
            let mut found = inner.inverse_kinematics(&pose, starts);
            if let Some(joint) = arm.form.given {
                found.iter_mut().for_each(|solution| solution.insert(joint, q[joint]));
            }
            let branches = arm.branches(&pose, &q);
            let reached: Vec<_> = branches
                .iter()
                .filter(|b| b.distance < 1e-9 * arm.size() && b.tilt < 1e-9)
                .collect();
            // Each solution is a branch. Next to a double root the search misses its posture by what it misses the pose
            // by, over the least singular value; twice, for what is not linear.
            let branch_of = |q: &Vec<f64>| {
                let off = reached.iter().map(|b| apart(&b.q, q)).enumerate();
                let (branch, nearest) = off.min_by(|a, b| a.1.total_cmp(&b.1)).expect("a branch");
                let (inner, rest) = arm.inner(q);
                let missed = difference(&arm.pose(q), &pose).norm();
                let known_to = 2.0 * missed / inner.jacobian(&rest).singular_values().min();
                assert!(
                    nearest < known_to.max(1e-5),
                    "{}: {q:?} is no branch: {nearest:e}",
                    arm.name
                );
                branch
            };
            let found: BTreeSet<usize> = found.iter().map(branch_of).collect();
            // So many starts find nearly all, and no two branches are one.
            missing += reached.len() - found.len();
            assert!(
                found.len() + 2 >= reached.len(),
                "{}: {} {}",
                arm.name,
                found.len(),
                reached.len()
            );
            all_of_them += reached.len();
        }
    }
    println!("{missing} of {all_of_them} solutions were not found by search");
    assert!(missing * 50 < all_of_them, "{missing} of {all_of_them}");
}

#[test]
fn there_are_no_other_solutions() {
    solutions_at(few_or_many(1, 2), 1);
}

#[test]
#[ignore = "takes minutes"]
fn there_are_no_other_solutions_at_fifty_poses() {
    solutions_at(50, 1);
}

#[test]
#[ignore = "takes minutes"]
fn there_are_no_other_solutions_of_thirty_tables_of_each_kind() {
    solutions_at(1, 30);
}
