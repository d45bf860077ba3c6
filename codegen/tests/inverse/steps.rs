//! Tables near one with a closed form: which one that is, and that steps lead from it to the arm.

use stiffarm_codegen::derive::{AsItIs, Given, steps};
use stiffarm_codegen::number::Number;
use stiffarm_codegen::robot::{Angle, Robot, Value};
use stiffarm_draws::{Draws, few_or_many};
use stiffarm_kernels::{Pose, Steps, nearest_branch};

use super::arms::{Arm, FAMILIES, random, reference};

/// Every length and angle of the table off by up to so much, m and rad.
pub fn off(robot: &Robot, by: f64, draws: &mut Draws) -> Robot {
    let mut robot = robot.clone();
    let mut drawn = |at: f64| Number::rounded(at + by * draws.unit());
    for joint in &mut robot.joints {
        for length in [&mut joint.a, &mut joint.d] {
            *length = Value::Number(drawn(length.number().expect("a number").to_f64()));
        }
        for angle in [&mut joint.theta, &mut joint.alpha, &mut joint.beta] {
            *angle = Angle::Radians(drawn(angle.radians().expect("a number")));
        }
    }
    robot
}

/// Of so many postures of arms of every family: how many of their poses are not reached to 1e-9 by the branch next to them.
fn missed(by: f64, draws: &mut Draws) -> (usize, usize) {
    let (mut all, mut missed) = (0, 0);
    for family in FAMILIES {
        for _ in 0..few_or_many(2, 6) {
            let exact: Arm = random(family, draws);
            let robot = off(&exact.robot, by, draws);
            let form =
                robot.nearest_closed_form().unwrap_or_else(|no| panic!("{no:?} {}", exact.name));
            assert!(robot.closed_form().is_err());
            let (arm, forward) =
                (AsItIs::<6>::new(&robot, form, Given::default()), reference(&robot));
            for _ in 0..40 {
                let q: [f64; 6] = draws.array(-3.1, 3.1);
                let at = forward.pose(&q);
                let pose = Pose::from(at);
                let begin = nearest_branch(arm.closed_form(&pose, &q), &q, &[None; 6]);
                let begin = begin.expect("a branch").q;
                let (found, [distance, tilt]) =
                    arm.follow(begin, &pose, (None, Steps::MOST)).expect("numbers");
                let reached = forward.pose(&found);
                let apart = (reached.translation.vector - at.translation.vector).norm();
                assert!((apart - distance).abs() < 1e-12, "{apart:e} {distance:e}");
                all += 1;
                missed += usize::from(distance.max(tilt) > 1e-9);
            }
        }
    }
    (missed, all)
}

/// Measured: of half a millimetre and milliradian 0.8 %, of ten times that 1.5 %; near singular postures all.
#[test]
fn steps_lead_from_the_nearest_table_to_the_arm() {
    let mut draws = Draws::new(21);
    for (by, part) in [(5e-4, 0.03), (5e-3, 0.1)] {
        let (missed, all) = missed(by, &mut draws);
        println!("off by {by}: {missed} of {all}");
        assert!((missed as f64) < part * all as f64, "{by}: {missed} of {all}");
    }
}

/// For what makers tolerate arms as they are built take three steps (`tests/inverse`), tables of random lengths up to five.
#[test]
fn random_tables_take_three_steps_to_five() {
    let mut draws = Draws::new(22);
    let mut counts = [0; 9];
    for family in FAMILIES {
        let robot = off(&random(family, &mut draws).robot, 5e-4, &mut draws);
        let form = robot.nearest_closed_form().expect("a closed form is near");
        counts[steps(&robot, form).unloaded] += 1;
    }
    assert_eq!(counts[3..=5].iter().sum::<usize>(), FAMILIES.len(), "{counts:?}");
}

/// An arm that grows when it is warm is another than its table, also where that is searched.
#[test]
fn an_arm_that_grows_takes_steps() {
    let growth = "[[effect]]\nid = 'thermal_growth'\nplace = 'arm'\nexpansion = '12 ppm/K'\n";
    for file in ["robots/arms/kuka_kr240.toml", "tests/data/offset_wrist.toml"] {
        let path = format!("{}/../{file}", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).expect("the file") + growth;
        let robot = Robot::from_toml(&text, "arm.toml").expect("valid").0;
        let form = robot.nearest_closed_form().expect("a closed form or a search");
        assert_eq!(steps(&robot, form).unloaded, 0);
        let grown = robot.with_effects().expect("an effect of kernels");
        assert!((2..=3).contains(&steps(&grown, form).unloaded), "{:?}", steps(&grown, form));
        let arm = AsItIs::<6>::new(&grown, form, Given { warming: 20.0, ..Given::default() });
        let (q, pose) = ([0.3, 1.0, -0.4, 0.2, 0.6, -0.5], reference(&robot));
        let mut at = pose.pose(&q);
        at.translation.vector *= 1.0 + 20.0 * 12e-6;
        let pose = Pose::from(at);
        let found = arm.solutions(&pose, &q, (None, Steps::MOST)).into_iter();
        let found = found.filter(|branch| branch.distance < 1e-9 && branch.tilt < 1e-9);
        let nearest = nearest_branch(found, &q, &[None; 6]).expect("the posture").q;
        assert!(nearest.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-9), "{nearest:?}");
    }
}

/// What is not near is searched for; with parameters it is refused with what stands in the way of a closed form.
#[test]
fn a_table_that_is_near_none_is_refused() {
    let mut draws = Draws::new(23);
    let robot = random(FAMILIES[0], &mut draws).robot;
    let mut far = robot.clone();
    far.joints[4].a = Value::Number(Number::rounded(0.2));
    far.joints[3].a = Value::Number(Number::rounded(0.2));
    assert!(far.nearest_closed_form().expect("six axes").is_search());
    far.joints[0].d = Value::Symbol("d1".to_owned());
    let told = far.nearest_closed_form().expect_err("no closed form is near").message;
    assert!(told.contains("do not meet in a point"), "{told}");
    let mut symbolic = off(&robot, 1e-4, &mut draws);
    symbolic.joints[0].d = Value::Symbol("d1".to_owned());
    assert!(symbolic.nearest_closed_form().is_err());
}
