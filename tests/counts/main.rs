//! Operation counts: a reviewed snapshot for every arm, and the limits that some of them must keep.
//!
//! A change that moves a count shows up as a difference of `snapshots/`; `INSTA_UPDATE=always cargo
//! test --test counts` accepts it.

use std::fmt::Write as _;

use stiffarm_codegen::derive::{Output, derive};
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
fn counts_keep_their_limits() {
    let flops = |robot: &Robot, outputs: &[Output]| derive(robot, outputs).ops().flops();
    assert!(flops(&read("ur5"), &[Output::Jacobian]) <= 119);
    assert!(flops(&read("kuka_kr240"), &[Output::Jacobian]) <= 90);
    let loaded = [
        Output::Pose,
        Output::Jacobian,
        Output::ComplementaryStiffness,
        Output::DeflectionFirstOrder,
    ];
    assert!(flops(&sprung("ur5"), &loaded) <= 352);
}

#[test]
fn counts_are_reviewed() {
    let mut table = String::from("add + mul (sin-cos pairs), every joint sprung\n");
    for arm in ARMS {
        let robot = sprung(arm.id);
        let _ = writeln!(table, "\n{}", arm.id);
        for output in Output::EACH {
            line(&mut table, output.name(), &robot, &[output]);
        }
        line(&mut table, "all", &robot, &Output::ALL);
    }
    insta::assert_snapshot!(table);
}

fn line(table: &mut String, name: &str, robot: &Robot, outputs: &[Output]) {
    let program = derive(robot, outputs);
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
