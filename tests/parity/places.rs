//! Named frames and markers against the textbook of the arm that ends there, and against the whole arm's frames and
//! their differences.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use stiffarm::kernels::generic::Arm;
use stiffarm::kernels::{Kernels, Output, Scalar, has};
use stiffarm_codegen::derive::derive_at;
use stiffarm_codegen::robot::{Asked, Robot};

use crate::compare::{CANCELLED, Draws, ForArm, collection, relative, terms};
use crate::tables::{Table, table};

/// The table with a frame on link `row` and a marker on the tool, at both of which everything is asked for that
/// can be told there.
fn placed(table: &Table, row: usize) -> Robot {
    let mut text = table.text.clone();
    text += &format!("[[frame]]\nname = \"here\"\njoint = {}\n", row + 1);
    text += "translation = [0.1, \"-20 mm\", 0.3]\nrotation = [\"pi/3\", 0, 0.2]\n";
    text += "[[marker]]\nname = \"smr\"\ntranslation = [0.02, 0, -0.1]\n";
    let mut robot = Table { text, values: table.values.clone() }.numeric();
    for (output, place) in Output::EACH.into_iter().flat_map(|o| [(o, "here"), (o, "smr")]) {
        // What is not told of a frame is refused.
        let _ = robot.ask(&Asked { output, at: Some(place.to_owned()) });
    }
    robot
}

/// Where the frame is in its row's, and the marker on the tool.
fn frame() -> Isometry3<f64> {
    let turned =
        UnitQuaternion::from_scaled_axis(Vector3::new(core::f64::consts::FRAC_PI_3, 0.0, 0.2));
    Isometry3::from_parts(Translation3::new(0.1, -0.02, 0.3), turned)
}

fn marker(arm: &Arm) -> Isometry3<f64> {
    arm.tool * Translation3::new(0.02, 0.0, -0.1)
}

/// The block of an arm that ends early as that of one with `n` joints: nothing of the joints beyond.
fn with_joints_beyond(output: Output, found: &[f64], dof: usize, n: usize) -> Vec<f64> {
    let ((rows, columns), (more, all)) = (output.shape(dof), output.shape(n));
    let each = output.columns().each();
    let mut padded = vec![0.0; more * all];
    for column in 0..columns {
        let (matrix, within) = (column / each.count(dof), column % each.count(dof));
        let at = matrix * each.count(n) + within;
        padded[at * more..][..rows].copy_from_slice(&found[column * rows..][..rows]);
    }
    padded
}

/// The largest deviation of all that a placed robot is asked for from the textbook of the arms that end there, and of
/// which output it is.
fn agree(robot: &Robot, arm: &Arm, row: usize, (states, seed): (usize, u64)) -> (f64, String) {
    let mut ending = arm.clone();
    ending.joints.truncate(row + 1);
    let [here, smr] =
        [(ending, frame()), (arm.clone(), marker(arm))].map(|(arm, tool)| Arm { tool, ..arm });
    let places = robot.places();
    assert_eq!(places.len(), 2);
    let mut worst = (0.0, String::new());
    for (place, outputs) in places {
        let ending = if place == "here" { &here } else { &smr };
        assert!(outputs.len() >= 10);
        for output in outputs {
            let program = derive_at(robot, place, output).expect("the place is there");
            let taken = output.state(arm.dof()) / arm.dof();
            let mut draws = Draws::new(seed);
            for _ in 0..states {
                let (q, wrench) = (draws.state(arm), draws.wrench(arm));
                let of_inner = q.chunks(arm.dof()).take(taken).flat_map(|of| &of[..ending.dof()]);
                let state: Vec<f64> = of_inner.copied().collect();
                let expected = ending.evaluate(output, &state, &wrench).ok();
                let got = program.evaluate(&q[..taken * arm.dof()], &wrench, |_| f64::NAN).ok();
                assert_eq!(expected.is_some(), got.is_some(), "{} at {place}", output.name());
                let (Some(expected), Some(got)) = (expected, got) else { continue };
                let expected = with_joints_beyond(output, &expected, ending.dof(), arm.dof());
                let floor = CANCELLED * terms(ending, output, &state, &wrench);
                let off = relative(&got.concat(), &expected, floor);
                if off > worst.0 {
                    worst = (off, format!("{} at {place}", output.name()));
                }
            }
        }
    }
    worst
}

/// A frame on the link in the middle, a marker on the tool.
fn every_arm(states: usize) {
    for (entry, _, arm) in collection() {
        let table = Table { text: entry.toml.to_owned(), values: Vec::new() };
        let row = arm.dof() / 2;
        let worst = agree(&placed(&table, row), &arm, row, (states, 6));
        println!("{} {worst:?}", entry.id);
        assert!(worst.0 <= 1e-12, "{}: {worst:?}", entry.id);
    }
}

#[test]
fn places_of_every_arm_agree() {
    every_arm(50);
}

#[test]
#[ignore = "ten thousand states of every arm take minutes"]
fn places_of_every_arm_agree_at_ten_thousand_states() {
    every_arm(10_000);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, ..ProptestConfig::default() })]

    #[test]
    fn places_agree_with_the_textbook_of_the_arm_that_ends_there(
        table in table(1..=8), row in 0usize..8, seed in any::<u64>()
    ) {
        let row = row % table.robot().dof();
        let worst = agree(&placed(&table, row), &table.arm(), row, (1, seed));
        prop_assert!(worst.0 <= 1e-11, "{worst:?}\n{}", table.text);
    }

    /// From the frames of the whole arm alone: the pose, its differences by every joint, and what springs give of
    /// them.
    #[test]
    fn places_are_where_the_frames_of_the_arm_put_them(
        table in table(1..=6), row in 0usize..6, seed in any::<u64>()
    ) {
        let row = row % table.robot().dof();
        let robot = placed(&table, row);
        let arm = table.arm();
        let mut draws = Draws::new(seed);
        let (q, wrench) = (draws.posture(&arm), draws.wrench(&arm));
        let at = |q: &[f64]| arm.frames(q)[row + 1] * frame();
        let value = |output| {
            let program = derive_at(&robot, "here", output).expect("the place is there");
            program.evaluate(&q, &wrench, |_| f64::NAN).map(|blocks| blocks.concat())
        };
        let here = at(&q);
        let pose = value(Output::Pose).expect("a pose");
        let columns = here.rotation.to_rotation_matrix();
        let expected: Vec<f64> =
            columns.matrix().iter().chain(here.translation.vector.iter()).copied().collect();
        prop_assert!(relative(&pose, &expected, 1.0) < 1e-12);
        let step = 1e-5;
        let mut twists = Vec::new();
        for joint in 0..arm.dof() {
            let moved = |by: f64| {
                let mut q = q.clone();
                q[joint] += by;
                at(&q)
            };
            let (low, high) = (moved(-step), moved(step));
            let v = (high.translation.vector - low.translation.vector) / (2.0 * step);
            let w = (high.rotation * low.rotation.inverse()).scaled_axis() / (2.0 * step);
            twists.extend([v.x, v.y, v.z, w.x, w.y, w.z]);
        }
        // Central differences of step 1e-5 err by 1e-10 of the reach cubed, and 1e-11 of rounding.
        let jacobian = value(Output::Jacobian).expect("a Jacobian");
        prop_assert!(relative(&jacobian, &twists, 1.0) < 1e-8);
        let p = here.translation.vector;
        let turned = |t: &[f64]| {
            let back = here.rotation.inverse();
            let (v, w) = (back * Vector3::new(t[0], t[1], t[2]), back * Vector3::new(t[3], t[4], t[5]));
            [v.x, v.y, v.z, w.x, w.y, w.z]
        };
        let carried = |t: &[f64]| {
            let v = Vector3::new(t[0], t[1], t[2]) + p.cross(&Vector3::new(t[3], t[4], t[5]));
            [v.x, v.y, v.z, t[3], t[4], t[5]]
        };
        let of = |each: &dyn Fn(&[f64]) -> [f64; 6]| twists.chunks(6).flat_map(each).collect::<Vec<_>>();
        let tool = value(Output::JacobianTool).expect("a Jacobian");
        prop_assert!(relative(&tool, &of(&turned), 1.0) < 1e-8);
        let spatial = value(Output::JacobianSpatial).expect("a Jacobian");
        prop_assert!(relative(&spatial, &of(&carried), 1.0) < 1e-8);
    }
}

stiffarm::robot! {
    /// A frame on the upper arm, one on the wrist, and a reflector.
    mod framed;
    convention: standard_dh;
    tool: translation [0, 0, t] rotation [0, 0, pi/2];
    frame: upper on a2 translation [-0.2, 0, 0.1] rotation [pi/2, 0, 0];
    frame: wrist on 3;
    outputs: pose, jacobian, frames, pose at upper, jacobian at upper, compliance at upper, pose at wrist;
    joint | theta | d   | a   | alpha | stiffness
    a1    | q     | 0.3 | 0   | pi/2  | 2e5
    a2    | q     | 0   | a_2 | 0     | k_2
    a3    | q     | 0   | 0.4 | 0     | 1e5
}

/// What is written against any arm runs at its frames, with the arm's posture.
#[test]
fn a_frame_is_an_arm() {
    fn moved<S: Scalar, const N: usize, A>(arm: &A, posture: &A::Posture) -> ([S; 3], [S; 3])
    where
        A: has::Pose<N, S> + has::Jacobian<N, S>,
    {
        let twist = arm.jacobian(posture)[0];
        (arm.pose(posture).position, [twist[0], twist[1], twist[2]])
    }
    let parameters = framed::Parameters { t: 0.1, a_2: 0.5, k_2: 1e5 };
    let (arm, upper) =
        (framed::Robot::new(&parameters), framed::at::upper::Robot::new(&parameters));
    let q = [0.3_f64, 0.5, -0.7];
    let posture = framed::Posture::new(&q);
    let [_, second, third] = framed::frames(&arm.constants, &q);
    let along = |frame: stiffarm::kernels::Pose<f64>, place: [f64; 3]| -> [f64; 3] {
        let [x, y, z] = frame.rotation;
        core::array::from_fn(|k| {
            frame.position[k] + x[k] * place[0] + y[k] * place[1] + z[k] * place[2]
        })
    };
    let (at, by_first) = moved(&upper, &posture);
    let expected = along(second, [-0.2, 0.0, 0.1]);
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15);
    assert!(near(at, expected), "{at:?} {expected:?}");
    // The first joint turns about the base's z.
    assert!(near(by_first, [-expected[1], expected[0], 0.0]), "{by_first:?}");
    assert!(near(moved(&arm, &posture).0, along(third, [0.0, 0.0, 0.1])));
    let wrist = framed::at::wrist::pose(&arm.constants, &q);
    assert!(near(wrist.position, third.position));
    assert_eq!(framed::at::upper::jacobian(&arm.constants, &q)[2], [0.0; 6]);
    let mut out = [0.0; 36];
    let outcome = Kernels::<f64>::evaluate(&upper, Output::Compliance, &q, &[0.0; 6], &mut out);
    assert_eq!(outcome, Ok(()));
    // Both springs give under a moment about the vertical and about the second axis: their compliances, each along
    // its own axis.
    let axis = framed::at::upper::jacobian(&arm.constants, &q)[1];
    assert!((out[35] - (1.0 / 2e5 + axis[5] * axis[5] / 1e5)).abs() < 1e-20);
}
