//! What enters a kernel: the posture as sines, cosines and displacements, and the wrench.

use super::super::expression::constant;
use super::super::plan::{Angle, Plan};
use super::lines::Lines;
use crate::expr::{Expr, Node, Symbol};

/// Whether the kernel depends on the joint values at all.
pub(super) fn has_posture(plan: &Plan) -> bool {
    !plan.angles.is_empty() || !plan.slides.is_empty()
}

/// Whether the kernel reads the wrench.
pub(super) fn uses_wrench(plan: &Plan) -> bool {
    let g = &plan.program.graph;
    let symbols = (0..g.nodes().len()).filter(|node| plan.name(*node).is_some());
    symbols.into_iter().any(|node| match g.nodes()[node] {
        Node::Symbol(s) => matches!(g.symbol_of(s), Symbol::Wrench(_)),
        _ => false,
    })
}

/// Whether an angle has a symbolic offset.
pub(super) fn needs_constants(plan: &Plan) -> bool {
    plan.angles.iter().any(|a| angle_text(plan, a).contains("constants."))
}

/// Fields of `Posture` in order: sines and cosines by angle, then displacements.
pub(super) fn field_names(plan: &Plan) -> Vec<String> {
    let trigonometric = plan.angles.iter().flat_map(|a| {
        let pair = [(a.sine, "s"), (a.cosine, "c")];
        pair.into_iter().filter(|(used, _)| *used).map(|(_, l)| format!("{l}{}", a.suffix))
    });
    trigonometric.chain(plan.slides.iter().map(|j| format!("q{}", j + 1))).collect()
}

/// The struct `Posture`: what of the joint values a kernel needs.
pub(super) fn posture(out: &mut Lines, plan: &Plan, n: usize) {
    out.blank();
    out.doc("The joint values as the kernel needs them: sines, cosines, displacements.");
    out.code("#[derive(Clone, Copy, Debug, PartialEq)]");
    out.code("pub struct Posture<S> {");
    out.indent();
    for angle in &plan.angles {
        let sum = angle_text(plan, angle);
        for (used, letter, word) in [(angle.sine, "s", "sin"), (angle.cosine, "c", "cos")] {
            if used {
                out.doc(&format!("{word}({sum})"));
                out.code(&format!("pub {letter}{}: S,", angle.suffix));
            }
        }
    }
    for joint in &plan.slides {
        out.doc(&format!("`q[{joint}]`, m"));
        out.code(&format!("pub q{}: S,", joint + 1));
    }
    out.dedent();
    out.code("}");
    out.blank();
    out.code("impl<S: Scalar> Posture<S> {");
    out.indent();
    out.doc("All sines and cosines at once.");
    let constants = if needs_constants(plan) { "constants: &super::Constants<S>, " } else { "" };
    out.code(&format!("pub fn new({constants}q: &[S; {n}]) -> Self {{"));
    out.indent();
    if !plan.angles.is_empty() {
        let name = |used: bool, letter: &str, a: &Angle| match used {
            true => format!("{letter}{}", a.suffix),
            false => "_".to_string(),
        };
        let sines: Vec<String> = plan.angles.iter().map(|a| name(a.sine, "s", a)).collect();
        let cosines: Vec<String> = plan.angles.iter().map(|a| name(a.cosine, "c", a)).collect();
        let sums: Vec<String> = plan.angles.iter().map(|a| angle_text(plan, a)).collect();
        out.code(&format!("let ([{}], [{}]) =", sines.join(", "), cosines.join(", ")));
        out.code(&format!("    S::sin_cos_all([{}]);", sums.join(", ")));
    }
    for joint in &plan.slides {
        out.code(&format!("let q{} = q[{joint}];", joint + 1));
    }
    out.code(&format!("Posture {{ {} }}", field_names(plan).join(", ")));
    out.dedent();
    out.code("}");
    out.dedent();
    out.code("}");
}

/// An angle in terms of `q` and the constants.
fn angle_text(plan: &Plan, angle: &Angle) -> String {
    fn write(plan: &Plan, e: Expr) -> String {
        let g = &plan.program.graph;
        let sign = if e.is_negative() { "-" } else { "" };
        if let Some(constant) = plan.name(e.node()).filter(|n| n.starts_with("constants.")) {
            return format!("{sign}{constant}");
        }
        match g.node(e) {
            Node::Number(n) => format!("S::lit({sign}{})", constant(n)),
            Node::Symbol(s) => match g.symbol_of(s) {
                Symbol::Joint(joint) => format!("{sign}q[{joint}]"),
                _ => String::new(),
            },
            Node::Add(a, b) if e.is_negative() => format!("-({})", write_sum(plan, a, b)),
            Node::Add(a, b) => write_sum(plan, a, b),
            Node::Mul(a, b) => format!("{sign}({} * {})", write(plan, a), write(plan, b)),
            _ => String::new(),
        }
    }
    fn write_sum(plan: &Plan, a: Expr, b: Expr) -> String {
        let (operator, b) = if b.is_negative() { ("-", -b) } else { ("+", b) };
        let right = write(plan, b);
        let nested = matches!(plan.program.graph.node(b), Node::Add(..));
        let right = if nested { format!("({right})") } else { right };
        format!("{} {operator} {right}", write(plan, a))
    }
    write(plan, angle.sum)
}
