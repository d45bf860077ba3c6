//! Operation counts: reviewed snapshots, and the limits that they must keep.

mod common;

use stiffarm_codegen::derive::{Output, derive};

#[test]
fn counts_stay_within_their_limits() {
    let jacobian = |robot| derive(&robot, &[Output::Jacobian]).ops().flops();
    assert!(jacobian(common::ur5()) <= 119);
    assert!(jacobian(common::kr240()) <= 90);
    let loaded = [
        Output::Pose,
        Output::Jacobian,
        Output::ComplementaryStiffness,
        Output::DeflectionFirstOrder,
    ];
    assert!(derive(&common::ur5(), &loaded).ops().flops() <= 352);
}

#[test]
fn print_counts() {
    for robot in [common::ur5(), common::kr240()] {
        for output in Output::EACH {
            let program = derive(&robot, &[output]);
            println!("{} {}: {:?} {} in {}", robot.name, output.name(), program.ops(), program.ops().flops(), program.frame());
        }
        let all = derive(&robot, &Output::ALL);
        println!("all {:?} {}", all.ops(), all.frame());
        let f = [Output::Pose, Output::Jacobian, Output::ComplementaryStiffness, Output::DeflectionFirstOrder];
        println!("fused {:?}", derive(&robot, &f).ops().flops());
    }
}
