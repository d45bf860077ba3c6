//! Every arm of the collection.

use stiffarm::kernels::Output;
use stiffarm::kernels::parity::{self, Subject};
use stiffarm_codegen::robot::Robot;
use stiffarm_robots::ARMS;

use crate::compare::{CANCELLED, Draws, ForArm, deviation};

/// Draws per robot, as the claim "10,000 random joint vectors and wrenches per robot" has it.
const COUNT: usize = 10_000;

#[test]
fn double_precision_agrees_to_1e_12() {
    std::thread::scope(|scope| {
        for half in ARMS.chunks(ARMS.len().div_ceil(2)) {
            scope.spawn(move || half.iter().for_each(check));
        }
    });
}

fn check(entry: &stiffarm_robots::Arm) {
    let (robot, warnings) = Robot::from_toml(entry.toml, entry.id).expect("the file is valid");
    assert!(warnings.is_empty(), "{warnings:?}");
    let arm = stiffarm_gap::robot::arm(&robot).expect("every parameter has a number");
    let mut draws = Draws::new(1);
    for _ in 0..COUNT {
        let (q, wrench) = (draws.state(&arm), draws.wrench(&arm));
        for &output in entry.kernels.outputs() {
            let load = (&q[..], &wrench);
            let worst = deviation(entry.kernels, &arm, output, load, (CANCELLED, |x| x));
            assert!(
                worst <= 1e-12,
                "{} {}: {worst:e} at {q:?} {wrench:?}",
                entry.id,
                output.name()
            );
        }
    }
}

/// In both precisions, by the textbook, its differences and dual numbers: what `stiffarm check` does
/// with a derived graph, with the compiled kernels.
#[test]
fn compiled_kernels_agree_in_every_way() {
    for entry in ARMS {
        let (robot, _) = Robot::from_toml(entry.toml, entry.id).expect("the file is valid");
        let arm = stiffarm_gap::robot::arm(&robot).expect("every parameter has a number");
        let double = parity::compiled(entry.kernels, |x: f64| x);
        let single = parity::compiled(entry.kernels_f32, |x: f32| f64::from(x));
        let outputs = entry.kernels.outputs();
        let subject =
            Subject { outputs, arm: &arm, beyond: None, generated: &double, single: Some(&single) };
        for line in parity::agreement(&subject, COUNT / 20, 2, &|_| {}).lines {
            assert_eq!(line.exceeded().next(), None, "{} {line:?}", entry.id);
            assert!(line.worst[0].is_some() && line.worst[1].is_some(), "{} {line:?}", entry.id);
        }
    }
}

#[test]
fn slices_of_the_wrong_length_are_refused() {
    use stiffarm::kernels::Error;
    let arm = stiffarm_robots::arm("ur5").expect("the collection has a UR5");
    let mut out = [0.0; 12];
    let short = arm.kernels.evaluate(Output::Pose, &[0.0; 5], &[0.0; 6], &mut out);
    assert_eq!(short, Err(Error::Length));
    let small = arm.kernels.evaluate(Output::Jacobian, &[0.0; 6], &[0.0; 6], &mut out);
    assert_eq!(small, Err(Error::Length));
    assert_eq!(out, [0.0; 12], "nothing is written on an error");
}
