//! Every arm of the collection.

use stiffarm::kernels::Output;
use stiffarm_codegen::robot::Robot;
use stiffarm_robots::ARMS;

use crate::compare::{CANCELLED, CANCELLED_F32, Draws, deviation};

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
        let (q, wrench) = (draws.posture(&arm), draws.wrench(&arm));
        for output in Output::EACH {
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

#[test]
fn single_precision_agrees_to_2e_6() {
    for entry in ARMS {
        let (robot, _) = Robot::from_toml(entry.toml, entry.id).expect("the file is valid");
        let arm = stiffarm_gap::robot::arm(&robot).expect("every parameter has a number");
        let mut draws = Draws::new(2);
        for _ in 0..COUNT / 20 {
            // The inputs themselves are rounded first: what is tested is the kernel.
            let q: Vec<f64> = draws.posture(&arm).iter().map(|x| f64::from(*x as f32)).collect();
            let wrench = draws.wrench(&arm).map(|x| f64::from(x as f32));
            for output in Output::EACH {
                let load = (&q[..], &wrench);
                let worst =
                    deviation(entry.kernels_f32, &arm, output, load, (CANCELLED_F32, f64::from));
                assert!(worst <= 2e-6, "{} {}: {worst:e} at {q:?}", entry.id, output.name());
            }
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
