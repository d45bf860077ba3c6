//! Operation counts: the reviewed snapshot of every arm is the limit.
//!
//! A change that moves a count shows up as a difference of `snapshots/`; `INSTA_UPDATE=always
//! cargo test -p stiffarm --test counts` accepts it.

use std::fmt::Write as _;

use stiffarm_codegen::derive::{Output, Passes, Program, Readings, derive, derive_at, derive_with};
use stiffarm_codegen::number::Number;
use stiffarm_codegen::robot::{Robot, Value};
use stiffarm_robots::ARMS;

fn read(id: &str) -> Robot {
    let arm = stiffarm_robots::arm(id).expect("the arm is in the collection");
    Robot::from_toml(arm.toml, id).expect("the file is valid").0
}

/// The arm with a spring in every joint, where its maker publishes none.
fn sprung(id: &str) -> Robot {
    let mut robot = read(id);
    for joint in &mut robot.joints {
        joint.stiffness.get_or_insert(Value::Number(Number::integer(100_000)));
    }
    robot
}

#[test]
fn every_pass_saves_operations_somewhere_and_costs_none_anywhere() {
    let off = [
        Passes { frame: false, ..Passes::ALL },
        Passes { sums: false, ..Passes::ALL },
        Passes { runs: false, ..Passes::ALL },
        Passes { parallel: false, ..Passes::ALL },
        Passes { bodies: false, ..Passes::ALL },
    ];
    let mut saved = [false; 5];
    let outputs = [
        Output::Jacobian,
        Output::Compliance,
        Output::ComplementaryStiffness,
        Output::InverseDynamicsByRates,
    ];
    for arm in ["lin_planar", "kuka_kr240", "ur10", "stanford"].map(sprung) {
        for output in outputs {
            let all = derive(&arm, &[output]).ops().cost();
            for (passes, saved) in off.into_iter().zip(&mut saved) {
                let without = derive_with(&arm, &[output], passes).ops().cost();
                assert!(without >= all, "{} {}: {passes:?}", arm.name, output.name());
                *saved |= without > all;
            }
        }
    }
    assert_eq!(saved, [true; 5]);
}

#[test]
fn counts_are_reviewed() {
    let mut table = String::from("add + mul (sin-cos pairs), every joint sprung\n");
    for arm in ARMS {
        let robot = sprung(arm.id);
        let _ = writeln!(table, "\n{}", arm.id);
        for output in robot.generated() {
            line(&mut table, output.name(), &robot, &[output]);
        }
        line(&mut table, "all", &robot, &Output::ALL);
        let told =
            |output: &Output| output.is_on_request() && (moves(&robot) || !output.is_of_motion());
        for output in Output::EACH.into_iter().filter(told) {
            line(&mut table, output.name(), &robot, &[output]);
        }
        if moves(&robot) {
            let of_torques = [
                Output::InverseDynamicsByJoints,
                Output::InverseDynamicsByRates,
                Output::MassMatrix,
            ];
            line(&mut table, "the torques' derivatives", &robot, &of_torques);
        }
    }
    insta::assert_snapshot!(table);
}

/// Of an arm with effects beyond its table: what lies between readings and joint values, then the outputs.
#[test]
fn counts_of_a_corrected_arm_are_reviewed() {
    let text = include_str!("../data/corrected_kuka.toml");
    let (robot, _) = Robot::for_kernels(text, "corrected_kuka.toml").expect("effects of kernels");
    let ops = Readings::of(&robot).ops();
    let mut table = String::from("add + mul (sin-cos pairs)\n\ncorrected_kuka\n");
    let _ = writeln!(table, "  joints {} + {} ({})", ops.add, ops.mul, ops.sin_cos);
    for output in robot.generated() {
        line(&mut table, output.name(), &robot, &[output]);
    }
    line(&mut table, "all", &robot, &Output::ALL);
    insta::assert_snapshot!(table);
}

/// Of frames and markers, on links within the arm and on its tool.
#[test]
fn counts_of_places_are_reviewed() {
    let (robot, _) =
        Robot::from_toml(include_str!("../c/framed.toml"), "framed.toml").expect("sound");
    let mut table = String::from("add + mul (sin-cos pairs)\n");
    for (place, outputs) in robot.places() {
        let _ = writeln!(table, "\n{place}");
        for output in outputs {
            let program = derive_at(&robot, place, output).expect("the place is there");
            counted(&mut table, output.name(), &program);
        }
    }
    insta::assert_snapshot!(table);
}

/// Whether the file says how the mass of some link is spread.
fn moves(robot: &Robot) -> bool {
    robot.joints.iter().any(|joint| joint.inertia.is_some())
}

fn line(table: &mut String, name: &str, robot: &Robot, outputs: &[Output]) {
    counted(table, name, &derive(robot, outputs));
}

fn counted(table: &mut String, name: &str, program: &Program) {
    let ops = program.ops();
    let _ = writeln!(
        table,
        "  {name:<24} {:>4} + {:>4} = {:>5}  ({}) in {}",
        ops.add,
        ops.mul,
        ops.flops(),
        ops.sin_cos,
        program.frame()
    );
}

#[test]
fn counts_in_the_text_are_those_of_the_graph() {
    let program = derive(&read("kuka_kr240"), &[Output::Jacobian]);
    let ops = stiffarm_robots::kuka_kr240::jacobian::OPS;
    assert_eq!(ops.flops(), program.ops().flops());
    assert_eq!(ops.sin_cos, 5, "neither theta 6 nor theta 3 alone enters");
}
