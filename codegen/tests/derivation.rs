//! The derivation against the graph's own symbolic derivative: a second way to every derivative that
//! stays inside the graph, exact but for rounding.

use stiffarm_codegen::derive::{Held, Output, derive_in};
use stiffarm_codegen::expr::{Expr, Graph, Symbol};

use super::common;

/// Values for the symbols: posture, wrench.
fn value(symbol: &Symbol) -> f64 {
    match symbol {
        Symbol::Joint(j) => 0.7 * *j as f64 - 1.9,
        Symbol::Wrench(k) => 10.0 - 3.0 * *k as f64,
        _ => f64::NAN,
    }
}

fn entries(program: &stiffarm_codegen::derive::Program, output: Output) -> Vec<Expr> {
    let block =
        program.blocks.iter().find(|b| b.held == Held::Output(output)).expect("it was asked for");
    block.entries.clone()
}

fn slopes(g: &mut Graph, of: &[Expr], joint: usize) -> Vec<f64> {
    let derived = g.derivative(of, &Symbol::Joint(joint));
    g.evaluate(&derived, value)
}

#[test]
fn stiffness_is_the_symbolic_derivative_of_the_torque() {
    for robot in [common::ur5(), common::kr240()] {
        for cut in [0, 4, 9, 14] {
            let outputs = [Output::JointTorque, Output::ComplementaryStiffness];
            let mut program = derive_in(&robot, &outputs, cut);
            let torque = entries(&program, Output::JointTorque);
            let k_c = entries(&program, Output::ComplementaryStiffness);
            let k_c = program.graph.evaluate(&k_c, value);
            for joint in 0..6 {
                let slope = slopes(&mut program.graph, &torque, joint);
                for (a, b) in slope.iter().zip(&k_c[6 * joint..]) {
                    assert!((a - b).abs() < 1e-13, "{} cut {cut}: {a} {b}", robot.name);
                }
            }
        }
    }
}

#[test]
fn jacobian_is_the_symbolic_derivative_of_the_position() {
    for robot in [common::ur5(), common::kr240()] {
        let mut program = derive_in(&robot, &[Output::Pose, Output::Jacobian], 4);
        let position = entries(&program, Output::Pose)[9..].to_vec();
        let jacobian = entries(&program, Output::Jacobian);
        let jacobian = program.graph.evaluate(&jacobian, value);
        for joint in 0..6 {
            let slope = slopes(&mut program.graph, &position, joint);
            for (a, b) in slope.iter().zip(&jacobian[6 * joint..]) {
                assert!((a - b).abs() < 1e-14);
            }
        }
    }
}

#[test]
fn wrists_and_parallel_axes_leave_structural_zeros() {
    let program = derive_in(&common::ur5(), &[Output::Jacobian], 0);
    let jacobian = entries(&program, Output::Jacobian);
    // The tool lies on axis 6, and axis 1 is vertical.
    assert!(jacobian[30..33].iter().all(|e| e.is_zero()));
    assert_eq!(jacobian[2..5], [Expr::ZERO; 3]);
    assert_eq!(jacobian[5], Expr::ONE);
    // Axes 2, 3 and 4 are parallel: one expression for all three.
    assert_eq!(jacobian[9..12], jacobian[15..18]);
    assert_eq!(jacobian[9..12], jacobian[21..24]);
}
