//! What an arm carries moves with its last link. Compared with the textbook of an arm that has one row more: a joint that
//! slides out of the tool's frame, held where it is, whose link the load is.

use nalgebra::{Matrix3, Vector3};
use stiffarm::kernels::generic::{Arm, Joint};
use stiffarm::kernels::{Input, Kernels, Motion, Output, Side};
use stiffarm_codegen::robot::Robot;

use crate::compare::{Draws, ForArm, block, relative};

const FILE: &str = include_str!("../data/payload.toml");

stiffarm::robot! {
    /// With its gripper.
    mod gripping from "tests/data/payload.toml";
    carries: gripper;
}
stiffarm::robot! {
    /// The same arm, told inline.
    mod inline;
    convention: standard_dh;
    tool: translation [0, 50 mm, 0.1] rotation [0, 0, pi/2];
    payload: "5 kg" mass 5 kg, com [0, 0, 60 mm];
    payload: gripper mass 1200 g, inertia [2e-3, 1e-4, -2e-4, 3e-3, 3e-4, 2.5e-3], com [10 mm, 20 mm, 60 mm];
    carries: gripper;
    joint | d   | a   | alpha   | theta | stiffness | mass | com                 | inertia
    a1    | 0.3 | 0   | 90 deg  | q     | 2e5       | 7    | [0.01, -0.1, 0.02]  | [0.06, 0.001, -0.002, 0.03, 0.004, 0.05]
    a2    | 0   | 0.5 | 0       | q     | 2e5       | 5    | [-0.2, 0.01, 0.03]  | [0.01, -0.002, 0.001, 0.08, 0.003, 0.08]
    a3    | 0   | 0.4 | -90 deg | q     | 1e5       | 3    | [-0.1, 0.02, -0.01] | [0.01, 0.001, 0.002, 0.03, -0.001, 0.03]
}

fn read(text: &str) -> Robot {
    Robot::from_toml(text, "payload.toml").expect("the file is valid").0
}

/// The row from the last frame to the tool's, with the gripper as its link.
fn gripper(robot: &Robot) -> Arm {
    let mut arm = stiffarm_gap::robot::arm(robot).expect("numbers only");
    let held = Joint {
        motion: Motion::Prismatic,
        theta: core::f64::consts::FRAC_PI_2,
        d: 0.1,
        a: 0.05,
        alpha: 0.0,
        compliance: 0.0,
        mass: 1.2,
        com: Vector3::new(0.01, 0.02, 0.06),
        inertia: Matrix3::new(2e-3, 1e-4, -2e-4, 1e-4, 3e-3, 3e-4, -2e-4, 3e-4, 2.5e-3),
        ..arm.joints[2].clone()
    };
    arm.joints.push(held);
    // The row ends where the tool is.
    arm.tool = nalgebra::Isometry3::identity();
    arm.tool_rotation_vector = Vector3::zeros();
    arm
}

/// The first three of four joints of a block.
fn without_last(output: Output, block: &[f64]) -> Vec<f64> {
    let kept = |side: Side| if side == Side::Joints { 3 } else { side.count(4) };
    let (rows, _) = output.shape(4);
    let columns = block.chunks(rows).take(kept(output.columns()));
    columns.flat_map(|column| column[..kept(output.rows())].to_vec()).collect()
}

#[test]
fn what_is_carried_moves_with_the_last_link() {
    let robot = read(FILE);
    let arm = gripper(&robot);
    let mut draws = Draws::new(41);
    let outputs: Vec<Output> = Kernels::<f64>::outputs(&gripping::Robot)
        .iter()
        .copied()
        // The regressor is of a link's moments, whichever these are; the table has a row less.
        .filter(|o| {
            !matches!(o, Output::TorqueRegressor | Output::ParameterJacobian | Output::Frames)
        })
        .collect();
    assert!(
        outputs.contains(&Output::InverseDynamics)
            && outputs.contains(&Output::DeflectionWithGravity)
    );
    for _ in 0..200 {
        let (state, wrench) = (draws.state(&arm), draws.wrench(&arm));
        // The fourth joint stays where it is.
        let still: Vec<f64> =
            state.iter().enumerate().map(|(k, x)| if k % 4 == 3 { 0.0 } else { *x }).collect();
        let three: Vec<f64> =
            still.iter().enumerate().filter(|(k, _)| k % 4 != 3).map(|(_, x)| *x).collect();
        for &output in &outputs {
            // A joint that nothing holds would slide away.
            if output.takes(Input::Torques) {
                continue;
            }
            let expected =
                arm.evaluate(output, &still[..output.state(4)], &wrench).expect("stable");
            let expected = without_last(output, &expected);
            let kernels: [&dyn Kernels<f64>; 2] = [&gripping::Robot, &inline::Robot];
            for kernels in kernels {
                let out = block(kernels, output, &three[..output.state(3)], &wrench);
                let worst = relative(&out, &expected, 0.0);
                assert!(worst <= 1e-12, "{}: {worst:e}", output.name());
            }
        }
    }
}

/// In a file as beside it, and as the textbook has it.
#[test]
fn a_file_says_what_its_arm_carries() {
    let carrying = FILE.replacen("[[joint]]", "carries = \"gripper\"\n\n[[joint]]", 1);
    let mut beside = read(FILE);
    beside.carry("gripper").expect("it is there");
    assert_eq!(read(&carrying), beside);
    let arm = stiffarm_gap::robot::arm(&beside).expect("numbers only");
    let mut out = [0.0; 3];
    let state = [0.3, -0.5, 0.7, 1.0, -2.0, 0.5, 0.1, 0.2, -0.3];
    let found = Kernels::<f64>::evaluate(
        &gripping::Robot,
        Output::InverseDynamics,
        &state,
        &[0.0; 6],
        &mut out,
    );
    assert_eq!(found, Ok(()));
    let expected = arm.inverse_dynamics(&state[..3], &state[3..6], &state[6..]);
    assert!(relative(&out, expected.as_slice(), 0.0) <= 1e-12);
    // A load on a load: both hang there.
    beside.carry("part").expect("it is there, too");
    let both = stiffarm_gap::robot::arm(&beside).expect("numbers only");
    assert_eq!(both.joints[2].mass, 8.2);
    // Nothing of a right angle is lost: the part's centre lies on the tool's axis.
    let mut part = read(FILE);
    part.joints[2].mass = None;
    part.joints[2].inertia = None;
    part.carry("part").expect("it is there");
    assert!(part.joints[2].com[0].is_zero() && part.joints[2].inertia.is_none());
}
