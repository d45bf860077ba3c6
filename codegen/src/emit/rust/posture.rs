//! What enters a kernel: the posture as sines, cosines and displacements.

use super::super::posture::{Needs, Pair, Posture, unit};
use crate::emit::lines::Lines;
use crate::robot::Robot;

/// What a function is made of is joined to it, so that sines and cosines and all entries stay in
/// registers; the way through memory costs a quarter more.
pub(super) const INLINE: &str = "#[inline(always)]";

/// Whether an angle has a symbolic offset.
pub(super) fn needs_constants(posture: &Posture) -> bool {
    posture.angles.iter().any(|pair| pair.sum.contains("constants."))
}

/// The struct `Posture`: what of the joint values the functions of the module need.
pub(super) fn module(posture: &Posture, needs: &[Needs], robot: &Robot) -> String {
    let n = robot.dof();
    let mut out = Lines::at(0);
    out.blank();
    out.doc("The joint values as the kernels need them: sines, cosines, displacements.");
    out.code("#[derive(Clone, Copy, Debug, PartialEq)]");
    out.code("pub struct Posture<S> {");
    out.indent();
    for pair in &posture.angles {
        for field in pair.fields() {
            let word = if field.starts_with('s') { "sin" } else { "cos" };
            out.doc(&format!("`{word}({})`", pair.sum));
            out.code(&format!("pub {field}: S,"));
        }
    }
    for joint in &posture.prismatic {
        out.doc(&format!("`q[{joint}]`, {}", unit(robot, *joint)));
        out.code(&format!("pub q{}: S,", joint + 1));
    }
    out.dedent();
    out.code("}");
    out.blank();
    out.code("impl<S: Scalar> Posture<S> {");
    out.indent();
    out.doc("All sines and cosines at once.");
    let constants = if needs_constants(posture) { "constants: &Constants<S>, " } else { "" };
    out.code(INLINE);
    out.code(&format!("pub fn new({constants}q: &[S; {n}]) -> Self {{"));
    out.indent();
    values(&mut out, posture);
    out.code(&format!("Posture {{ {} }}", posture.fields().join(", ")));
    out.dedent();
    out.code("}");
    let fields = posture.fields();
    if needs.iter().any(|needs| needs.reads.len() < fields.len()) {
        out.blank();
        out.doc("Zeros, in the place of what a kernel does not need.");
        out.code(INLINE);
        out.code("fn unused() -> Self {");
        out.indent();
        out.code("let zero = S::lit(0.0);");
        let zeros: Vec<String> = fields.iter().map(|field| format!("{field}: zero")).collect();
        out.code(&format!("Posture {{ {} }}", zeros.join(", ")));
        out.dedent();
        out.code("}");
    }
    out.dedent();
    out.code("}");
    out.finish()
}

/// The fields as locals.
pub(super) fn values(out: &mut Lines, posture: &Posture) {
    if !posture.angles.is_empty() {
        let name = |used: bool, letter: &str, pair: &Pair| match used {
            true => format!("{letter}{}", pair.suffix),
            false => "_".to_string(),
        };
        let sines: Vec<String> = posture.angles.iter().map(|a| name(a.sine, "s", a)).collect();
        let cosines: Vec<String> = posture.angles.iter().map(|a| name(a.cosine, "c", a)).collect();
        let mut sums = Vec::new();
        for pair in &posture.angles {
            if pair.sum.contains(' ') {
                out.code(&format!("let theta{} = {};", pair.suffix, pair.sum));
                sums.push(format!("theta{}", pair.suffix));
            } else {
                sums.push(pair.sum.clone());
            }
        }
        out.code(&format!("let ([{}], [{}]) =", sines.join(", "), cosines.join(", ")));
        out.code(&format!("    S::sin_cos_all([{}]);", sums.join(", ")));
    }
    for joint in &posture.prismatic {
        out.code(&format!("let q{} = q[{joint}];", joint + 1));
    }
}
