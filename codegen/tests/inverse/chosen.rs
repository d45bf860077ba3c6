//! What of seven joints is given where the user chooses it, and what is searched for.

use nalgebra::{Isometry3, Vector3};
use stiffarm_codegen::derive::{AsItIs, Given};
use stiffarm_codegen::emit::latex;
use stiffarm_codegen::number::Number;
use stiffarm_codegen::robot::{ClosedForm, Family, Redundancy, Robot, Value};
use stiffarm_draws::{Draws, few_or_many};
use stiffarm_kernels::{Pose, Solution, Steps, generic};

use super::arms::{drawn, reference};
use super::steps::off;
use super::{apart, difference};

fn built_in(name: &str) -> Robot {
    let file = format!("{}/../robots/arms/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(file).expect("the file");
    Robot::from_toml(&text, "arm.toml").expect("valid").0
}

/// The robot with this given, and its closed form.
fn given(mut robot: Robot, what: &str) -> (Robot, ClosedForm) {
    robot.give(what).expect("it has one");
    let form = robot.nearest_closed_form().unwrap_or_else(|no| panic!("{what}: {no:?}"));
    (robot, form)
}

/// Arms between a spherical shoulder and a spherical wrist: at right angles, with an elbow beside both arms, and oblique.
const ELBOWS: [[&str; 7]; 4] = [
    ["0ra", "0r0", "0ra", "0r0", "0ra", "0r0", "ara"],
    ["0ra", "0r0", "ara", "ara", "0ra", "0r0", "ara"],
    ["0xa", "0x0", "0xa", "0xa", "0xa", "0x0", "axa"],
    ["0ra", "0r0", "axa", "apa", "0xa", "0r0", "ara"],
];

/// The angle by its definition, from where the axes stand.
fn elbow_angle(arm: &generic::Arm, q: &[f64]) -> f64 {
    let frames = arm.frames(q);
    let first = usize::from(arm.convention == stiffarm_kernels::Convention::Modified);
    let axis = |joint: usize| frames[joint - 1 + first] * Vector3::z();
    let origin = |joint: usize| frames[joint - 1 + first].translation.vector;
    // Axes 2 and 3 meet where axis 2 stands, 6 and 7 where axis 6 does.
    let [shoulder, wrist] = [2, 6].map(origin);
    let line = (wrist - shoulder).normalize();
    let across = |v: Vector3<f64>| (v - line * line.dot(&v)).normalize();
    let reference = across(axis(1));
    let elbow = across(axis(3) * arm.joints[2].d);
    line.cross(&reference).dot(&elbow).atan2(reference.dot(&elbow))
}

fn solutions<const N: usize>(
    arm: &AsItIs<N>,
    pose: &Isometry3<f64>,
    near: &[f64; N],
) -> Vec<Solution<f64, N>> {
    arm.closed_form(&Pose::from(*pose), near)
}

/// Every branch stands where it says. The branches that reach the pose.
fn reached<const N: usize>(
    forward: &generic::Arm,
    pose: &Isometry3<f64>,
    found: Vec<Solution<f64, N>>,
) -> Vec<[f64; N]> {
    let reaches = |solution: &Solution<f64, N>| {
        let error = difference(&forward.pose(&solution.q), pose);
        let distance = error.fixed_rows::<3>(0).norm();
        let told = solution.distance;
        assert!(solution.q.iter().all(|q| q.is_finite()));
        let turned = solution.tilt > 1e-9;
        assert!(
            told.is_infinite() || turned || (distance - told).abs() < 1e-7,
            "{distance:e} {told:e}"
        );
        let there = told < 1e-9 && solution.tilt < 1e-9;
        assert!(!there || error.norm() < 1e-8, "{:e}", error.norm());
        there
    };
    found.into_iter().filter(reaches).map(|solution| solution.q).collect()
}

/// Of the iiwa 14 and so many tables of each kind, at so many postures.
fn elbows(tables: usize, postures: usize) {
    let (mut draws, mut of_tables) = (Draws::new(31), Draws::new(37));
    let rows = ELBOWS.into_iter().flat_map(|rows| core::iter::repeat_n(rows, tables));
    let robots = rows.map(|rows| drawn(("an elbow", rows), &mut of_tables));
    let [mut all, mut missed] = [0, 0];
    for robot in core::iter::once(built_in("iiwa14")).chain(robots) {
        let (robot, form) = given(robot, "elbow_angle");
        assert_eq!((form.family, form.branches()), (Family::ElbowAngle, 8));
        let forward = reference(&robot);
        let arm = AsItIs::<7>::new(&robot, form, Given::default());
        for _ in 0..postures {
            let (q, near): ([f64; 7], [f64; 7]) = (draws.array(-3.1, 3.1), draws.array(-3.1, 3.1));
            let (pose, angle) = (forward.pose(&q), elbow_angle(&forward, &q));
            let at = Given { elbow_angle: Some(angle), ..Given::default() };
            // The same angle by itself, or as another posture has it.
            for found in [solutions(&arm.with(&at), &pose, &near), solutions(&arm, &pose, &q)] {
                let reached = reached(&forward, &pose, found);
                for other in &reached {
                    let off = (elbow_angle(&forward, other) - angle).sin().abs();
                    assert!(off < 1e-6, "{}: {off:e}", robot.name);
                }
                let nearest = reached.iter().map(|b| apart(b, &q)).fold(f64::INFINITY, f64::min);
                all += 1;
                missed += usize::from(nearest > 1e-5);
            }
        }
    }
    println!("{missed} of {all} postures are no branches of their own elbow angle");
    assert!(missed * 1000 < all, "{missed} of {all}");
}

#[test]
fn the_elbow_stands_at_the_angle_that_is_given() {
    elbows(8, 100);
}

#[test]
#[ignore = "takes minutes"]
fn elbows_of_a_thousand_tables_stand_at_the_angle_that_is_given() {
    elbows(1000, 10);
}

/// Stretched and folded arms, wrists on axis 1, wrists that are aligned, and poses out of reach.
#[test]
fn singular_elbows_have_numbers() {
    let mut draws = Draws::new(32);
    let (robot, form) = given(built_in("iiwa14"), "elbow_angle");
    let forward = reference(&robot);
    let arm = AsItIs::<7>::new(&robot, form, Given::default());
    for k in 0..4000 {
        let mut q: [f64; 7] = draws.array(-3.1, 3.1);
        let by = [0.0, 1e-15, 1e-12, 1e-9][k % 4];
        [1, 3, 5].into_iter().for_each(|joint| {
            if draws.chance(0.5) {
                q[joint] = by * draws.unit();
            }
        });
        let mut pose = forward.pose(&q);
        if k % 9 == 0 {
            pose.translation.vector *= 3.0;
        }
        let found = solutions(&arm, &pose, &q);
        let least = found.iter().map(|b| b.distance + b.tilt).fold(f64::INFINITY, f64::min);
        let reached = reached(&forward, &pose, found);
        assert!(k % 9 == 0 || !reached.is_empty(), "{q:?} {least:e}");
    }
}

/// Entries off by half a millimetre and milliradian: the nearest table's elbow angle, and steps.
#[test]
fn a_calibrated_elbow_is_near_its_angle() {
    let mut draws = Draws::new(36);
    let robot = off(&built_in("iiwa14"), 5e-4, &mut draws);
    let (robot, form) = given(robot, "elbow_angle");
    assert_eq!(form.family, Family::ElbowAngle);
    let (forward, designed) = (reference(&robot), reference(&built_in("iiwa14")));
    let arm = AsItIs::<7>::new(&robot, form, Given::default());
    let (mut all, mut missed, mut turned) = (0, 0, Vec::new());
    for _ in 0..200 {
        let q: [f64; 7] = draws.array(-3.1, 3.1);
        let pose = forward.pose(&q);
        let found = arm.solutions(&Pose::from(pose), &q, (None, Steps::MOST));
        for branch in reached(&forward, &pose, found.clone()) {
            let [own, asked] = [&branch, &q].map(|q| elbow_angle(&designed, q));
            turned.push((own - asked).sin().abs());
        }
        all += found.len();
        missed += found.iter().filter(|b| b.distance > 1e-9 || b.tilt > 1e-9).count();
    }
    turned.sort_by(f64::total_cmp);
    let [half, nearly] = [2, 10].map(|part| turned[turned.len() - 1 - turned.len() / part]);
    println!("{missed} of {all} branches are missed; the elbow is off by {half:.1e}, {nearly:.1e}");
    assert!(half < 4e-3 && nearly < 2e-2, "{half:e} {nearly:e}");
    assert!(missed * 20 < all, "{missed} of {all}");
}

#[test]
fn any_joint_of_seven_can_be_given() {
    let mut draws = Draws::new(33);
    for name in ["panda", "iiwa14"] {
        for joint in 0..7 {
            let mut robot = built_in(name);
            robot.give(&(joint + 1).to_string()).expect("a joint");
            let form = robot.nearest_closed_form();
            // A spherical wrist stands one way or the other at the same angles of the joints before it.
            let searched = name == "panda" && joint < 5;
            assert_eq!(
                form.is_ok(),
                searched || [0, 6].contains(&joint),
                "{name} {joint} {form:?}"
            );
            let Ok(form) = form else { continue };
            assert_eq!(form.given, Some(joint));
            let forward = reference(&robot);
            let arm = AsItIs::<7>::new(&robot, form, Given::default());
            let mut missed = 0;
            for _ in 0..few_or_many(25, 100) {
                let q: [f64; 7] = draws.array(-3.1, 3.1);
                let pose = forward.pose(&q);
                let reached = reached(&forward, &pose, solutions(&arm, &pose, &q));
                assert!(reached.iter().all(|b| b[joint] == q[joint]));
                let nearest = reached.iter().map(|b| apart(b, &q)).fold(f64::INFINITY, f64::min);
                missed += usize::from(nearest > 1e-5);
            }
            assert!(missed <= 1, "{}: {missed} are missed", form.sentence());
        }
    }
}

/// What cannot be given is refused, and what is given is written down again.
#[test]
fn what_is_given_is_said_and_kept() {
    let asked = |text: &str| {
        let file = format!("outputs = [\"{text}\"]\n");
        let toml = built_in("iiwa14").to_toml();
        Robot::from_toml(&(file + &toml), "arm.toml")
    };
    let (robot, _) = asked("inverse_kinematics given elbow_angle").expect("an elbow");
    assert_eq!(robot.redundancy, Some(Redundancy::ElbowAngle));
    let again = Robot::from_toml(&robot.to_toml(), "arm.toml").expect("the same").0;
    assert_eq!((again.redundancy, again.asked()), (robot.redundancy, robot.asked()));
    assert!(asked("inverse_kinematics given joint 8").is_err());
    let mut panda = built_in("panda");
    panda.give("elbow_angle").expect("seven joints");
    let told = panda.nearest_closed_form().expect_err("no spherical wrist").message;
    assert!(told.contains("axes 5, 6, 7 do not meet"), "{told}");
    let mut six = built_in("ur10");
    six.give("3").expect("a joint");
    assert!(six.nearest_closed_form().expect_err("six").message.contains("none of 6 joints free"));
}

/// So many random tables, each at one pose: the share of branches that are missed, which the reference implementation finds
/// by other means.
fn searched(tables: usize) {
    let mut draws = Draws::new(34);
    let kinds = [["axa"; 6], ["ara"; 6]];
    let [mut all, mut missed, mut not_by_newton, mut own] = [0; 4];
    for k in 0..tables {
        let robot = drawn(("six axes", kinds[k % 2]), &mut draws);
        let form = robot.nearest_closed_form().unwrap_or_else(|no| panic!("{no:?}"));
        assert!(form.is_search(), "{}", robot.name);
        let forward = reference(&robot);
        let arm = AsItIs::<6>::new(&robot, form, Given::default());
        let q: [f64; 6] = draws.array(-3.1, 3.1);
        let pose = forward.pose(&q);
        let found = reached(&forward, &pose, solutions(&arm, &pose, &[0.0; 6]));
        let known = forward.inverse_kinematics(&pose, 400);
        let has = |list: &[[f64; 6]], q: &[f64]| list.iter().any(|b| apart(b, q) < 1e-4);
        let other = known.iter().filter(|q| !has(&found, q)).count();
        not_by_newton +=
            found.iter().filter(|q| known.iter().all(|b| apart(b, &q[..]) > 1e-4)).count();
        own += usize::from(!has(&found, &q));
        (all, missed) = (all + found.len() + other, missed + other);
    }
    println!("{missed} of {all} are missed; {not_by_newton} by Newton's method; {own} postures");
    assert!(missed * 200 <= all, "{missed} of {all}");
}

#[test]
fn a_search_finds_every_solution() {
    searched(10);
}

#[test]
#[ignore = "takes minutes"]
fn a_search_finds_every_solution_of_a_thousand_tables() {
    searched(1000);
}

/// An arm that has no closed form near: the wrist of a Fanuc CRX.
#[test]
fn an_offset_wrist_is_searched() {
    let mut robot =
        drawn(("an offset wrist", ["ara", "apa", "ara", "0ra", "0ra", "ara"]), &mut Draws::new(35));
    robot.joints[4].d = Value::Number(Number::rounded(0.15));
    let form = robot.nearest_closed_form().expect("a search");
    assert!(form.is_search(), "{form:?}");
    robot.inverse_kinematics = Some(form);
    let no = "is a search, not a closed form, and is written as rust, c, cuda or python alone";
    let told = latex(&robot, &[]).expect_err("a search").to_string();
    assert!(told.ends_with(no), "{told}");
}

/// The formulas on paper: the same steps as in every other text.
#[test]
fn the_inverse_is_written_as_latex() {
    let mut robot = built_in("kuka_kr240");
    robot.inverse_kinematics = Some(robot.closed_form().expect("a closed form"));
    let text = latex(&robot, &[]).expect("a closed form");
    assert!(text.contains("\\subsection*{inverse kinematics}"), "{text}");
    assert!(text.contains("q_{6}^{(8)} &= "), "{text}");
    assert!(text.contains("\\mathit{distance}^{(8)} &= "), "{text}");
}
