//! One function of a generated module, with the module of the same name that holds its parts.

use stiffarm_kernels::{Form, Input, Output};

use super::super::constants::Constants;
use super::super::plan::Plan;
use super::RustOptions;
use super::body::Body;
use super::posture::{has_posture, needs_constants, posture, uses_wrench};
use super::shapes;
use crate::derive::Program;
use crate::emit::docs::docs;
use crate::emit::lines::Lines;
use crate::robot::Robot;

/// A function to be printed.
pub(super) struct Function<'p> {
    pub(super) program: &'p Program,
    name: &'static str,
    outputs: Vec<Output>,
    symbolic: bool,
    /// Whether products are fused into sums.
    pub(super) fused_products: bool,
}

impl<'p> Function<'p> {
    /// The function of one output.
    pub fn single(program: &'p Program, output: Output, symbolic: bool) -> Self {
        let (name, outputs) = (output.name(), vec![output]);
        Function { program, name, outputs, symbolic, fused_products: false }
    }

    /// The fused function.
    pub fn all(program: &'p Program, symbolic: bool) -> Self {
        let outputs = Output::ALL.to_vec();
        Function { program, name: "all", outputs, symbolic, fused_products: false }
    }

    /// The function and its module.
    pub fn text(&self, robot: &Robot, options: &RustOptions, constants: &mut Constants) -> String {
        let plan = Plan::new(self.program, constants);
        let body = Body::new(self, &plan);
        let mut out = Lines::at(0);
        out.blank();
        self.entry(&mut out, &plan, robot);
        out.blank();
        self.module(&mut out, &plan, &body, options);
        out.finish()
    }

    fn fused(&self) -> bool {
        self.outputs.len() > 1
    }

    pub(super) fn wrench(&self) -> bool {
        self.outputs.iter().any(|o| o.takes(Input::Wrench))
    }

    pub(super) fn fallible(&self) -> bool {
        self.outputs.iter().any(|o| o.is_fallible())
    }

    /// The function of the runtime that solves system `k`, and its constants.
    pub(super) fn solve(&self, k: usize) -> (&'static str, String) {
        let solve = &self.program.solves[k];
        let (n, together) = (solve.right.len(), solve.together());
        match (together < n, self.fused_products) {
            (false, false) => ("solve", String::new()),
            (false, true) => ("solve_fused", String::new()),
            (true, false) => ("solve_leading", format!("::<S, {n}, {together}>")),
            (true, true) => ("solve_leading_fused", format!("::<S, {n}, {together}>")),
        }
    }

    pub(super) fn ty(&self) -> String {
        match self.fused() {
            true => "All<S>".to_string(),
            false => shapes::ty(self.outputs[0], self.program.dof),
        }
    }

    pub(super) fn returned(&self, inside: bool) -> String {
        let ty = if self.fused() && !inside { "all::All<S>".to_string() } else { self.ty() };
        if self.fallible() { format!("Result<{ty}, Unstable>") } else { ty }
    }

    /// The public function: posture from `q`, then the kernel.
    fn entry(&self, out: &mut Lines, plan: &Plan, robot: &Robot) {
        self.docs(out, plan, robot);
        let n = self.program.dof;
        let mut parameters = Vec::new();
        if self.symbolic {
            let used = !plan.constants.is_empty() || needs_constants(plan);
            parameters.push(format!("{}constants: &Constants<S>", if used { "" } else { "_" }));
        }
        let by_posture = has_posture(plan);
        parameters.push(format!("{}q: &[S; {n}]", if by_posture { "" } else { "_" }));
        if self.wrench() {
            let used = uses_wrench(plan);
            parameters.push(format!("{}wrench: &[S; 6]", if used { "" } else { "_" }));
        }
        let (name, returned) = (self.name, self.returned(false));
        out.code(&format!("pub fn {name}<S: Scalar>({}) -> {returned} {{", parameters.join(", ")));
        let mut arguments = Vec::new();
        if self.symbolic && !plan.constants.is_empty() {
            arguments.push("constants".to_string());
        }
        if by_posture {
            let offset = if needs_constants(plan) { "constants, " } else { "" };
            arguments.push(format!("&{name}::Posture::new({offset}q)"));
        }
        if self.wrench() && uses_wrench(plan) {
            arguments.push("wrench".to_string());
        }
        out.indent();
        out.code(&format!("{name}::given({})", arguments.join(", ")));
        out.dedent();
        out.code("}");
    }

    fn docs(&self, out: &mut Lines, plan: &Plan, robot: &Robot) {
        let ops = self.program.ops();
        if self.fused() {
            let names: Vec<&str> = self.outputs.iter().map(|o| o.name()).collect();
            out.doc(&format!("{} of {}, worked out together.", names.join(", "), robot.name));
        } else {
            let [first, rest @ ..] = docs(self.outputs[0], self.program.dof, shapes::ORDER);
            out.doc(&first);
            for paragraph in rest {
                out.doc("");
                out.doc(&paragraph);
            }
        }
        out.doc("");
        let angles: Vec<String> = plan.angles.iter().map(|a| format!("θ{}", a.suffix)).collect();
        let division = if ops.div > 0 { format!(", {} divisions", ops.div) } else { String::new() };
        let trigonometry = match angles.is_empty() {
            true => "no sines or cosines".to_string(),
            false => format!("sines and cosines of {}", angles.join(", ")),
        };
        out.doc(&format!(
            "{} additions, {} multiplications{division}, {trigonometry}; worked out in {}.",
            ops.add,
            ops.mul,
            self.program.frame()
        ));
        if self.fallible() {
            out.doc("");
            out.doc("# Errors");
            out.doc("`Unstable` where the loaded arm has no stable equilibrium.");
        }
    }

    fn module(&self, out: &mut Lines, plan: &Plan, body: &Body, options: &RustOptions) {
        out.doc(&format!("[`{0}`](fn@{0}) in parts, with its figures.", self.name));
        out.code(&format!("pub mod {} {{", self.name));
        out.indent();
        let mut imports = vec!["Ops"];
        let pose = |o: &Output| matches!(o.form(), Form::Pose | Form::Poses);
        if self.outputs.iter().any(pose) {
            imports.push("Pose");
        }
        imports.push("Scalar");
        if self.fallible() {
            imports.push("Unstable");
        }
        let mut solves: Vec<&str> =
            (0..self.program.solves.len()).map(|k| self.solve(k).0).collect();
        solves.sort_unstable();
        solves.dedup();
        imports.extend(solves);
        out.code(&format!("use {}::{{{}}};", options.kernels, imports.join(", ")));
        self.figures(out, body);
        if self.fused() {
            self.all_struct(out);
        }
        if has_posture(plan) {
            posture(out, plan, self.program.dof);
        }
        out.blank();
        body.text(out, self);
        out.dedent();
        out.code("}");
    }

    fn figures(&self, out: &mut Lines, body: &Body) {
        let ops = self.program.ops();
        out.blank();
        out.doc("Operations beyond the sines and cosines.");
        out.code(&format!(
            "pub const OPS: Ops = Ops {{ add: {}, mul: {}, neg: {}, div: {}, sin_cos: {} }};",
            ops.add, ops.mul, body.negations, ops.div, ops.sin_cos
        ));
        if self.fused() {
            return;
        }
        let (rows, columns) = self.outputs[0].shape(self.program.dof);
        out.blank();
        out.doc("Entries that are not structurally zero; `[column][row]`.");
        out.code(&format!("pub const SPARSITY: [[bool; {rows}]; {columns}] = ["));
        out.indent();
        for column in self.program.blocks[0].entries.chunks(rows) {
            let flags: Vec<String> = column.iter().map(|e| (!e.is_zero()).to_string()).collect();
            out.code(&format!("[{}],", flags.join(", ")));
        }
        out.dedent();
        out.code("];");
    }

    fn all_struct(&self, out: &mut Lines) {
        out.blank();
        out.doc("Everything that [`all`](fn@super::all) computes.");
        out.code("#[derive(Clone, Copy, Debug, PartialEq)]");
        out.code("pub struct All<S> {");
        out.indent();
        for output in &self.outputs {
            let [sentence, shape, _] = docs(*output, self.program.dof, shapes::ORDER);
            out.doc(&sentence);
            out.doc("");
            out.doc(&shape);
            out.code(&format!("pub {}: {},", output.name(), shapes::ty(*output, self.program.dof)));
        }
        out.dedent();
        out.code("}");
    }

    pub(super) fn zero(&self) -> String {
        let n = self.program.dof;
        if !self.fused() {
            return shapes::zero(self.outputs[0], n);
        }
        let field = |o: &Output| format!("{}: {}", o.name(), shapes::zero(*o, n));
        format!("All {{ {} }}", self.outputs.iter().map(field).collect::<Vec<_>>().join(", "))
    }

    pub(super) fn place(&self, block: usize, entry: usize) -> String {
        let output = self.program.blocks[block].output;
        let place = shapes::place(output, self.program.dof, entry);
        if self.fused() { format!("out.{}{place}", output.name()) } else { format!("out{place}") }
    }
}
