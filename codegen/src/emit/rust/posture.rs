//! What enters a kernel: the posture as sines, cosines and displacements, and the wrench.

use super::super::angles::{Angle, angle_terms};
use super::super::literal::constant;
use super::super::plan::Plan;
use crate::emit::lines::Lines;
use crate::expr::{Expr, Node, Symbol};

/// What a function is made of is joined to it, so that sines and cosines and all entries stay in
/// registers; the way through memory costs a quarter more.
pub(super) const INLINE: &str = "#[inline(always)]";

/// Whether the kernel depends on the joint values at all.
pub(super) fn has_posture(plan: &Plan) -> bool {
    !plan.angles.is_empty() || !plan.prismatic.is_empty()
}

/// Whether the kernel reads the wrench.
pub(super) fn uses_wrench(plan: &Plan) -> bool {
    plan.wrench().contains(&true)
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
    trigonometric.chain(plan.prismatic.iter().map(|j| format!("q{}", j + 1))).collect()
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
                out.doc(&format!("`{word}({sum})`"));
                out.code(&format!("pub {letter}{}: S,", angle.suffix));
            }
        }
    }
    for joint in &plan.prismatic {
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
    out.code(INLINE);
    out.code(&format!("pub fn new({constants}q: &[S; {n}]) -> Self {{"));
    out.indent();
    if !plan.angles.is_empty() {
        let name = |used: bool, letter: &str, a: &Angle| match used {
            true => format!("{letter}{}", a.suffix),
            false => "_".to_string(),
        };
        let sines: Vec<String> = plan.angles.iter().map(|a| name(a.sine, "s", a)).collect();
        let cosines: Vec<String> = plan.angles.iter().map(|a| name(a.cosine, "c", a)).collect();
        let mut sums = Vec::new();
        for angle in &plan.angles {
            let text = angle_text(plan, angle);
            if text.contains(' ') {
                out.code(&format!("let theta{} = {text};", angle.suffix));
                sums.push(format!("theta{}", angle.suffix));
            } else {
                sums.push(text);
            }
        }
        out.code(&format!("let ([{}], [{}]) =", sines.join(", "), cosines.join(", ")));
        out.code(&format!("    S::sin_cos_all([{}]);", sums.join(", ")));
    }
    for joint in &plan.prismatic {
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
    let g = &plan.program.graph;
    let named = |e: Expr| plan.name(e.node()).unwrap_or_default().to_string();
    let term = |e: Expr| match g.node(e) {
        Node::Number(n) => format!("S::lit({})", constant(n)),
        Node::Symbol(s) => match g.symbol_of(s) {
            Symbol::Joint(joint) => format!("q[{joint}]"),
            _ => named(e),
        },
        _ => named(e),
    };
    let mut text = String::new();
    for e in angle_terms(g, angle.sum) {
        text.push_str(match (text.is_empty(), e.is_negative()) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        });
        text.push_str(&term(e.abs()));
    }
    text
}
