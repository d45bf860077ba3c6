//! Plans of tests, by what they show and how well.

use nalgebra::{DMatrix, Vector6};
use stiffarm_kernels::generic::Arm;

use crate::dexterity::design::{DEVIATIONS, Design, Plan, Planned, Purpose, Station, Suspect};
use crate::dexterity::{DexterityError, inverse_condition};
use crate::effects::{Catalogue, Known};
use crate::fixture::known;
use crate::instrument::View;
use crate::plans::{design, kr240, plan, separate};
use crate::whole::{Situation, Whole};

fn within_limits<'a>(whole: impl Into<Whole<'a>>, design: &Design) {
    let whole = whole.into();
    for (k, test) in design.tests.iter().enumerate() {
        for (q, joint) in test.q.iter().zip(&whole.arm.joints) {
            let [low, high] = joint.limits.unwrap();
            assert!((low..=high).contains(q));
        }
        let own = inverse_condition(whole, &test.q, design.length).unwrap();
        assert_eq!(own, test.inverse_condition);
        assert!(design.tests[..k].iter().all(|other| other.q != test.q));
    }
}

/// What moves joints alone makes of a posture another one, of which the table says everything; what belongs
/// to another session is not there.
#[test]
fn a_corrected_arm_is_planned_at_the_joint_values_that_readings_mean() {
    let arm = kr240();
    let slip =
        Known { session: Some("run1.csv".to_owned()), ..known("slip", "base", 0, &[1.0; 6]) };
    let ratio = known("joint_ratio", "joint 3", 0, &[0.05]);
    let both = [ratio.clone(), slip];
    let plan = plan(Purpose::Diagnose);
    let found = design(Whole { arm: &arm, known: &both }, &plan).unwrap();
    let whole = Whole { arm: &arm, known: &[ratio] };
    within_limits(whole, &found);
    let noise = plan.noise_position;
    let mut normal = DMatrix::<f64>::zeros(12, 12);
    for test in &found.tests {
        let mut q = test.q.clone();
        q[2] *= 1.05;
        let springs = arm.compliance_regressor(&q, &test.wrench).fixed_rows::<3>(0) / noise;
        let zeros = arm.jacobian(&q).fixed_rows::<3>(0) / noise;
        for loaded in [0.0, 1.0] {
            let row = DMatrix::from_fn(3, 12, |r, c| match c {
                0..6 => loaded * springs[(r, c)],
                _ => zeros[(r, c - 6)],
            });
            normal += row.tr_mul(&row);
        }
    }
    // By the units of both, lest the inverse lose its digits.
    let unit = normal.diagonal().map(|d| 1.0 / d.sqrt());
    let unit = DMatrix::from_diagonal(&unit);
    let covariance = &unit * (&unit * normal * &unit).try_inverse().unwrap() * &unit;
    for (j, expected) in found.expected.iter().enumerate() {
        for (found, k) in [(expected.compliance, j), (expected.zero, 6 + j)] {
            assert!((found.unwrap() / covariance[(k, k)].sqrt() - 1.0).abs() < 1e-4, "{j} {k}");
        }
    }
}

#[test]
fn zeros_are_planned_for_too() {
    let arm = kr240();
    let found = design(&arm, &plan(Purpose::Diagnose)).unwrap();
    within_limits(&arm, &found);
    for expected in &found.expected {
        assert!(expected.compliance.is_some() && expected.zero.is_some(), "{expected:?}");
        // A zero shows by micrometres per microradian: 8 postures give it to microradians.
        assert!(expected.zero.unwrap() < 2e-3);
    }
}

/// A hanging weight does not show joint 1; the plan says so.
#[test]
fn what_no_test_shows_is_said() {
    let arm = kr240();
    let mut hanging = plan(Purpose::Identify);
    hanging.loads.truncate(1);
    let found = design(&arm, &hanging).unwrap();
    assert_eq!(found.expected[0].compliance, None);
    assert!(found.expected[1].compliance.is_some());
}

/// What a spring and a beam do in the tests by differences of the arm at rest, and from these the
/// deviations and the smallest displacement: nothing of the effects' own blocks.
#[test]
fn what_is_told_apart_is_what_least_squares_tell() {
    told_apart(&[]);
    told_apart(&[
        known("joint_ratio", "joint 3", 0, &[0.03]),
        known("base_compliance", "base", 0, &[4e-8, 3e-8, 1e-9, 0.0]),
        known("wrench_scale", "tool", 0, &[0.2]),
    ]);
}

fn told_apart(known: &[Known]) {
    let arm = kr240();
    let plan = separate(&arm, ["joint_compliance@joint 2", "joint_compliance@joint3"]);
    let found = design(Whole { arm: &arm, known }, &plan).unwrap();
    assert!(found.displacements && found.expected.is_empty());
    within_limits(Whole { arm: &arm, known }, &found);
    let at = |arm: &Arm, q: &[f64], w: &Vector6<f64>| {
        let (state, _) = Whole { arm, known }.at(q, &Situation::under(*w)).unwrap();
        state.tool.translation.vector
    };
    let sagging = |joint: usize, change: f64, test: &Planned| {
        let mut arm = arm.clone();
        arm.joints[joint].compliance += change;
        at(&arm, &test.q, &test.wrench) - at(&arm, &test.q, &Vector6::zeros())
    };
    let noise = 3e-5 * 2f64.sqrt();
    let mut normal = DMatrix::<f64>::zeros(2, 2);
    for test in &found.tests {
        let step = 1e-9;
        let column =
            |j: usize| (sagging(j, step, test) - sagging(j, -step, test)) / (2.0 * step * noise);
        let block = nalgebra::Matrix3x2::from_columns(&[column(1), column(2)]);
        normal += DMatrix::from_iterator(2, 2, (block.transpose() * block).iter().copied());
    }
    let covariance = normal.clone().try_inverse().unwrap();
    for (k, told) in found.told.iter().enumerate() {
        let deviation = told.numbers[0].1.unwrap();
        assert!((deviation / covariance[(k, k)].sqrt() - 1.0).abs() < 1e-5, "{told:?}");
        let moved = (normal[(k, k)] / found.tests.len() as f64).sqrt() * noise;
        let smallest = DEVIATIONS * deviation * moved;
        assert!((told.smallest.unwrap() / smallest - 1.0).abs() < 1e-5, "{told:?} {smallest}");
    }
    assert_eq!(found.told[0].effect, "joint compliance at joint 2");
    assert!(found.efficiency > 1.5, "{}", found.efficiency);
}

/// What no load changes shows in poses; what depends on the side needs sides; a frame that is
/// fitted along leaves less.
#[test]
fn poses_and_sides_are_planned_where_they_are_needed() {
    let arm = kr240();
    let plan = separate(&arm, ["backlash@joint 2", "joint_offset@joint 2"]);
    let found = design(&arm, &plan).unwrap();
    assert!(!found.displacements);
    assert!(found.tests.iter().all(|t| t.direction.as_ref().unwrap().iter().all(|s| s.abs() == 1)));
    let plain = found.told[1].smallest.unwrap();
    let base = Suspect::parse("base_frame", &arm, &Catalogue::default()).unwrap();
    let found = design(&arm, &Plan { along: vec![base], ..plan }).unwrap();
    assert!(found.told[1].smallest.unwrap() > plain);
    let plan = separate(&arm, ["joint_offset@joint 1", "joint_ratio@joint 2"]);
    let found = design(&arm, &plan).unwrap();
    assert!(found.tests.iter().all(|t| t.direction.is_none()));
    let orders =
        separate(&arm, ["transmission_error@joint 2:cos 1", "transmission_error@joint 2:sin  2"]);
    let found = design(&arm, &orders).unwrap();
    let names: Vec<&str> = found.told[1].numbers.iter().map(|n| n.0.name.as_str()).collect();
    assert_eq!(names, ["cos 2", "sin 2"]);
}

#[test]
fn what_cannot_be_told_apart_is_said() {
    let arm = kr240();
    let same = separate(&arm, ["base_frame", "base_frame"]);
    let error = design(&arm, &same).unwrap_err().to_string();
    assert!(error.contains("tells base frame at base from base frame at base"), "{error}");
    let idle = separate(&arm, ["joint_compliance@joint 2", "drift"]);
    let error = design(&arm, &idle).unwrap_err().to_string();
    assert_eq!(error, "no test of this plan shows drift at base: no time passes");
    let wrong =
        |text: &str| Suspect::parse(text, &arm, &Catalogue::default()).unwrap_err().to_string();
    assert!(wrong("backlas@joint 2").contains("did you mean `backlash`?"));
    assert!(wrong("backlash").contains("found no place, expected one of joint 1, joint 2,"));
    assert!(wrong("backlash@tool").contains("found the place `tool`"));
}

#[test]
fn the_same_seed_gives_the_same_plan() {
    let arm = kr240();
    let small = Plan { count: 3, ..plan(Purpose::Identify) };
    assert_eq!(design(&arm, &small), design(&arm, &small));
    let other = Plan { seed: 2, ..small.clone() };
    assert_ne!(design(&arm, &small), design(&arm, &other));
}

#[test]
fn plans_that_cannot_be_made_are_refused() {
    let mut arm = kr240();
    let good = plan(Purpose::Identify);
    for wrong in [
        Plan { count: 0, ..good.clone() },
        Plan { loads: vec![], ..good.clone() },
        Plan { loads: vec![Vector6::repeat(f64::NAN)], ..good.clone() },
        Plan { noise_position: 0.0, ..good.clone() },
    ] {
        assert!(matches!(design(&arm, &wrong), Err(DexterityError::Setting { .. })), "{wrong:?}");
    }
    let heavy = Plan { loads: vec![Vector6::new(0.0, 0.0, -1e12, 0.0, 0.0, 0.0)], ..good.clone() };
    assert!(matches!(design(&arm, &heavy), Err(DexterityError::Unstable(_))));
    arm.joints[1].motion = stiffarm_kernels::Motion::Prismatic;
    arm.joints[1].limits = None;
    assert_eq!(design(&arm, &good).unwrap_err(), DexterityError::Unlimited { joint: 2 });
}

/// Sockets and a plate: every posture is there and above the plate, and the plan says as much as its own covariance.
#[test]
fn postures_at_a_bench_are_where_it_is() {
    let arm = crate::fixture::springy();
    let text = "[[point]]\nname = \"a\"\nat = [0.4, 0.1, 0.3]\n[[point]]\nname = \"b\"\nat = [0.1, 0.4, 0.2]\n\
                [[plane]]\nname = \"floor\"\nnormal = [0, 0, 1]\noffset = \"-0.6 m\"";
    let bench = crate::instrument::Bench::read("b.toml", text).unwrap().places();
    let stations = bench.iter().cloned().map(Station::Thing).collect();
    let plates = bench.iter().filter_map(|aim| match aim.view {
        View::Plane(plane) => Some(plane),
        _ => None,
    });
    let plates = plates.collect();
    let plan = Plan { count: 9, plates, bench: stations, ..plan(Purpose::Diagnose) };
    let found = design(&arm, &plan).unwrap();
    assert_eq!(found.tests.len(), 9);
    for test in &found.tests {
        let view = &bench[test.thing.unwrap()].view;
        assert!(view.read(&arm.pose(&test.q)).norm() < 1e-5, "{test:?}");
        assert!(arm.frames(&test.q)[1..arm.dof()].iter().all(|at| at.translation.z > -0.6));
    }
    assert!(found.expected.iter().any(|e| e.compliance.is_some()));
    let refused = design(&arm, &Plan { purpose: Purpose::Identify, ..plan }).unwrap_err();
    assert!(refused.to_string().contains("bench"), "{refused}");
}

/// A board on the floor before a camera on the tool, and a board on the tool before a camera beside the arm: at every
/// posture all corners are in the picture, by a pinhole that stands here.
#[test]
fn postures_before_a_camera_show_the_board() {
    let arm = kr240();
    let corners =
        "corners = { a = [0, 0, 0], b = [0.2, 0, 0], c = [0, 0.2, 0], d = [0.2, 0.2, 0] }";
    let lens = "matrix = [[1000, 0, 640], [0, 1000, 360], [0, 0, 1]]";
    let hand = format!(
        "[[camera]]\nname = \"hand\"\non = \"tool\"\n{lens}\nat = [0, 0.08, 0]\n\
         [[board]]\nname = \"floor\"\nat = [2.0, 0.3, 0.1]\nrotation = [\"180 deg\", 0, 0]\n{corners}"
    );
    let beside = format!(
        "[[camera]]\nname = \"left\"\n{lens}\nat = [2.0, 4.5, 1.5]\ntowards = [2.0, 0, 1.2]\nfit = [\"matrix\"]\n\
         [[board]]\nname = \"held\"\nat = [0, 0, 0.05]\n{corners}"
    );
    for (text, constants) in [(hand, 12), (beside, 16)] {
        let looks = crate::instrument::Bench::read("b.toml", &text).unwrap().looks();
        let [look] = &looks[..] else { panic!("{looks:?}") };
        assert_eq!(look.constants(), constants);
        let station = Station::Board(look.clone());
        let noise_rotation = Some(1e-4);
        let plan = Plan { bench: vec![station], noise_rotation, ..plan(Purpose::Diagnose) };
        let found = design(&arm, &plan).unwrap();
        within_limits(&arm, &found);
        assert_eq!(found.tests.len(), 8);
        for test in &found.tests {
            let mounted = arm.pose(&test.q) * look.mounted;
            let (camera, board) = match look.is_on_tool {
                true => (mounted, look.beside),
                false => (look.beside, mounted),
            };
            for (_, corner) in &look.corners {
                let at = camera.inverse() * board * nalgebra::Point3::from(*corner);
                let [u, v] = [1000.0 * at.x / at.z + 640.0, 1000.0 * at.y / at.z + 360.0];
                let is_inside = (0.0..=1280.0).contains(&u) && (0.0..=720.0).contains(&v);
                assert!(at.z > 0.0 && is_inside, "{u} {v} {}", at.z);
            }
        }
        assert!(found.expected.iter().any(|e| e.zero.is_some()), "{:?}", found.expected);
    }
}
