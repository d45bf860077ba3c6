//! The LaTeX and dot printers on real arms.

use stiffarm_codegen::derive::Output;
use stiffarm_codegen::emit::{dot, latex};

use super::common;

#[test]
fn latex_is_balanced_and_speaks_the_papers_notation() {
    let text =
        latex(&common::kr240(), &[Output::Jacobian, Output::Deflection]).expect("no inverse");
    let count = |c: char| text.matches(c).count();
    assert_eq!(count('{'), count('}'));
    assert_eq!(text.matches("\\left(").count(), text.matches("\\right)").count());
    assert_eq!(text.matches("\\begin{align*}").count(), 2);
    for piece in ["c_{23}", "[J]_{12} &=", "(K_\\theta-K_C)_{11} &=", "[\\delta d]_{6} &="] {
        assert!(text.contains(piece), "{piece} is missing");
    }
    assert!(!text.contains("node"), "every node has a name");
}

#[test]
fn latex_keeps_symbols() {
    let mut robot = common::ur5();
    robot.joints[1].a = stiffarm_codegen::robot::Value::Symbol("a2".into());
    robot.joints[2].theta = stiffarm_codegen::robot::Angle::Symbol("t3".into());
    let text = latex(&robot, &[Output::Pose]).expect("no inverse");
    assert!(text.contains("a_{2}"), "{text}");
    assert!(text.contains("\\sin(q_{2}+q_{3}+t_{3})"), "{text}");
}

#[test]
fn dot_draws_every_entry() {
    let text = dot(&common::ur5(), &[Output::Jacobian]);
    assert!(text.starts_with("digraph \"UR5\" {") && text.ends_with("}\n"));
    assert_eq!(text.matches("doubleoctagon").count(), 27, "one per entry that is not zero");
    for line in text.lines().filter(|l| l.contains("->")) {
        let source = line.trim().split(' ').next().expect("an edge has a source");
        assert!(text.contains(&format!("  {source} [label=")), "{source} is drawn");
    }
}
