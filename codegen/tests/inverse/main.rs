//! The closed forms of the inverse kinematics, by evaluation of their graphs: against the reference implementation's forward
//! kinematics, and against a solver that knows nothing of branches.

mod arms;
mod steps;

use nalgebra::{Isometry3, Vector3, Vector6};

use arms::{Arm, Branch, FAMILIES, collection, random};
use stiffarm_codegen::robot::{FileError, Robot};
use stiffarm_draws::Draws;

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
fn check(arm: &Arm, pose: &Isometry3<f64>, near: &[f64; 6]) -> (usize, f64) {
    let (mut reached, mut worst) = (0, 0.0_f64);
    for branch in arm.branches(pose, near) {
        assert!(branch.q.iter().all(|x| x.is_finite()), "{}: {pose} {:?}", arm.name, branch.q);
        let error = difference(&arm.pose(&branch.q), pose);
        let (position, rotation) =
            (error.fixed_rows::<3>(0).norm(), error.fixed_rows::<3>(3).norm());
        // An orientation that is missed takes the position with it.
        if branch.tilt < 1e-10 {
            let off = (position - branch.distance).abs() / arm.size() + rotation;
            assert!(off < 1e-10, "{}: {pose}: {off:e} {}", arm.name, branch.distance);
        }
        if branch.distance < 1e-10 * arm.size() && branch.tilt < 1e-10 {
            reached += 1;
            worst = worst.max(position / arm.size() + rotation);
        }
    }
    (reached, worst)
}

/// How far a posture is from the nearest branch at its pose.
fn from_branches(arm: &Arm, q: &[f64; 6], near: &[f64; 6]) -> f64 {
    let branches = arm.branches(&arm.pose(q), near);
    branches.iter().map(|branch| apart(&branch.q, q)).fold(f64::INFINITY, f64::min)
}

/// All arms: those of the collection, and some of each family.
fn all(each: usize, draws: &mut Draws) -> Vec<Arm> {
    let mut arms = collection();
    for family in FAMILIES {
        arms.extend((0..each).map(|_| random(family, draws)));
    }
    arms
}

#[test]
fn the_collection_has_these_closed_forms() {
    let names: Vec<String> = collection().iter().map(|arm| arm.name.clone()).collect();
    let closed = [
        "FANUC S-420F",
        "ABB IRB 120",
        "KUKA KR 240-2",
        "Lin 1991 elbow manipulator",
        "PUMA 560",
        "Staubli TX2-90L",
        "UR10",
        "UR5",
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
    let beta = "a = 0.5, beta = 0.1";
    refused(with([plain[0], beta, plain[2]]), "the row of `joint 2` has a beta");
    let skew = "a = 0.5, alpha = 0.3";
    refused(with(["a = 0.2, alpha = \"pi/2\"", skew, plain[2]]), "none is parallel to the next");
    refused(with([plain[0], "alpha = \"pi/2\"", plain[2]]), "axes 1, 2, 3 meet in a point");
}

/// Errors: of the postures they have been below 2e-7 at most, near a double root, and of the poses 1e-11.
#[test]
fn postures_are_branches_of_their_poses() {
    let mut draws = Draws::new(1);
    for arm in all(40, &mut draws) {
        for _ in 0..if arm.name.contains('\n') { 50 } else { 2000 } {
            let (q, near) = (draws.array(-3.1, 3.1), draws.array(-3.1, 3.1));
            let (reached, _) = check(&arm, &arm.pose(&q), &near);
            assert!(reached > 0, "{}: {q:?}", arm.name);
            let off = from_branches(&arm, &q, &near);
            assert!(off < 1e-6, "{}: {q:?}: {off:e}", arm.name);
        }
    }
}

/// Joints at whole quarter turns, of which the axes are aligned in all ways, and within 1e-12 and 1e-9 of them.
#[test]
fn aligned_postures_are_reached_and_free_joints_stay() {
    let mut draws = Draws::new(4);
    let mut worst = 0.0_f64;
    for arm in all(6, &mut draws) {
        for k in 0..if arm.name.contains('\n') { 200 } else { 4096 } {
            let only = draws.chance(0.5).then(|| (6.0 * draws.part()) as usize);
            let exact: [f64; 6] = core::array::from_fn(|joint| {
                let quarters = (draws.part() * 5.0).floor() - 2.0;
                let aligned = only.map_or(draws.chance(0.6), |only| only == joint);
                let free = 3.0 * draws.unit();
                let turn = if aligned { quarters * core::f64::consts::FRAC_PI_2 } else { free };
                turn - arm.reference.joints[joint].theta
            });
            let by = [0.0, 1e-12, 1e-9, 1e-15][k % 4];
            let q = exact.map(|q| q + by * draws.unit());
            let pose = arm.pose(&q);
            check(&arm, &pose, &draws.array(-3.1, 3.1));
            let (reached, error) = check(&arm, &pose, &q);
            // Of two singularities the square root of the one's rounding is what the other is off by; of more, which leave the
            // Jacobian two directions short, an arm with three parallel axes can miss the pose, and says so.
            let mut values = arm.reference.jacobian(&q).singular_values();
            values.as_mut_slice().sort_by(f64::total_cmp);
            let missed = |branch: &Branch| branch.distance / arm.size() + branch.tilt;
            let least = arm.branches(&pose, &q).iter().map(missed).fold(f64::INFINITY, f64::min);
            if values[1] > 1e-6 {
                worst = worst.max(least);
            }
            // A double root is known to the square root of rounding.
            if by == 0.0 && only.is_some() {
                assert!(reached > 0 && error < 1e-10, "{}: {q:?}: {error:e}", arm.name);
                let off = from_branches(&arm, &q, &q);
                assert!(off < 1e-5, "{}: {q:?}: {off:e}", arm.name);
            }
        }
    }
    assert!(worst < 1e-5, "{worst:e}");
}

/// The point where the last axes meet on the first axis, far out, and at the shoulder.
#[test]
fn poses_that_are_not_reached_are_missed_by_what_is_told() {
    let mut draws = Draws::new(5);
    for arm in all(10, &mut draws) {
        for k in 0..60 {
            let (q, near): ([f64; 6], [f64; 6]) = (draws.array(-3.1, 3.1), draws.array(-3.1, 3.1));
            let frames = arm.reference.frames(&q);
            let point = frames[5].translation.vector;
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

/// What the reference implementation finds by search, and no other, is what the branches reach.
#[test]
fn there_are_no_other_solutions() {
    let mut draws = Draws::new(3);
    let mut arms = collection();
    arms.extend(FAMILIES.map(|family| random(family, &mut draws)));
    for arm in arms {
        for _ in 0..2 {
            let q: [f64; 6] = draws.array(-3.1, 3.1);
            let pose = arm.pose(&q);
            let found = arm.reference.inverse_kinematics(&pose, 400);
            let branches = arm.branches(&pose, &q);
            let reached: Vec<_> = branches
                .iter()
                .filter(|b| b.distance < 1e-9 * arm.size() && b.tilt < 1e-9)
                .collect();
            for q in &found {
                let nearest = reached.iter().map(|b| apart(&b.q, q)).fold(f64::INFINITY, f64::min);
                assert!(nearest < 1e-5, "{}: {q:?} is no branch: {nearest:e}", arm.name);
            }
            assert!(found.len() <= reached.len(), "{}", arm.name);
            // So many starts find nearly all.
            assert!(
                found.len() + 1 >= reached.len(),
                "{}: {} {}",
                arm.name,
                found.len(),
                reached.len()
            );
        }
    }
}
