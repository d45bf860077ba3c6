//! The implementation of `Kernels`: a generated robot behind a pointer.

use stiffarm_kernels::{Input, Output};

use super::shapes::flat;
use crate::emit::lines::Lines;

/// The struct `Robot` and its `Kernels`.
pub(super) fn interface(symbolic: bool) -> String {
    let mut out = Lines::at(0);
    out.blank();
    if symbolic {
        out.doc("This arm with numbers for its parameters, as `Kernels`.");
        out.code("#[derive(Clone, Copy, Debug, PartialEq)]");
        out.code("pub struct Robot<S> {");
        out.indent();
        out.doc("What the functions need of the parameters.");
        out.code("pub constants: Constants<S>,");
        out.dedent();
        out.code("}");
        out.blank();
        out.code("impl<S: Scalar> Robot<S> {");
        out.indent();
        out.doc("The arm with these parameters.");
        out.code("pub fn new(p: &Parameters<S>) -> Self {");
        out.indent();
        out.code("Robot { constants: Constants::new(p) }");
        out.dedent();
        out.code("}");
        out.dedent();
        out.code("}");
    } else {
        out.doc("This arm as `Kernels`.");
        out.code("#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]");
        out.code("pub struct Robot;");
    }
    out.blank();
    let target = if symbolic { "Robot<S>" } else { "Robot" };
    out.code(&format!("impl<S: Scalar> Kernels<S> for {target} {{"));
    out.indent();
    method(&mut out, "fn name(&self) -> &'static str {", "NAME");
    method(&mut out, "fn dof(&self) -> usize {", "N");
    out.code("fn evaluate(");
    out.code("    &self,");
    out.code("    output: Output,");
    out.code("    q: &[S],");
    out.code("    wrench: &[S; 6],");
    out.code("    out: &mut [S],");
    out.code(") -> Result<(), Error> {");
    out.indent();
    out.code("let q: &[S; N] = q.try_into().map_err(|_| Error::Length)?;");
    if symbolic {
        out.code("let constants = &self.constants;");
    }
    out.code("match output {");
    out.indent();
    for output in Output::EACH {
        let first = if symbolic { "constants, q" } else { "q" };
        let last = if output.takes(Input::Wrench) { ", wrench" } else { "" };
        let question = if output.is_fallible() { "?" } else { "" };
        let call = format!("{}({first}{last}){question}", output.name());
        let flat = flat(output, &call);
        out.code(&format!("Output::{output:?} => fill(out, {flat}),"));
    }
    out.code("_ => Err(Error::Absent),");
    for _ in 0..3 {
        out.dedent();
        out.code("}");
    }
    out.finish()
}

fn method(out: &mut Lines, signature: &str, body: &str) {
    out.code(signature);
    out.indent();
    out.code(body);
    out.dedent();
    out.code("}");
}
