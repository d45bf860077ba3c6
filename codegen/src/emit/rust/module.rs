//! The text of one function, and of the module of the same name that holds its parts.

use stiffarm_kernels::{Form, Input, Output};

use super::RustOptions;
use super::body::Body;
use super::function::Function;
use super::posture::{self, INLINE, needs_constants, readings, values};
use super::shapes;
use crate::emit::docs::{docs, inputs};
use crate::emit::lines::Lines;
use crate::robot::Robot;

impl Function<'_> {
    /// The function and its module.
    pub fn text(&self, robot: &Robot, options: &RustOptions) -> String {
        let body = Body::new(self);
        let mut out = Lines::at(0);
        out.blank();
        self.entry(&mut out, robot);
        out.blank();
        self.module(&mut out, &body, options);
        out.finish()
    }

    /// The public function: what it needs of the posture from `q`, then the kernel.
    fn entry(&self, out: &mut Lines, robot: &Robot) {
        self.docs(out, robot);
        let needed = &self.needs.posture;
        let all = needed.fields().len() == self.posture.fields().len();
        let offsets = needs_constants(if all { self.posture } else { needed });
        let mut parameters = Vec::new();
        if self.symbolic {
            parameters.push("constants: &Constants<S>".to_string());
        }
        let n = self.program().dof;
        let extras = posture::parameters(self.stage, n).concat();
        parameters.push(format!("q: &[S; {n}]{extras}"));
        if self.wrench() {
            parameters.push("wrench: &[S; 6]".to_string());
        }
        let (name, returned) = (self.name(), self.returned(false));
        out.code(&format!("pub fn {name}<S: Scalar>({}) -> {returned} {{", parameters.join(", ")));
        out.indent();
        let names = self.stage.extras().into_iter().map(|e| format!(", {}", e.name()));
        let names: String = names.collect();
        let posture = if all {
            format!("Posture::new({}q{names})", if offsets { "constants, " } else { "" })
        } else {
            let constants = if offsets { "constants: &Constants<S>, " } else { "" };
            let q = if self.needs.reads.is_empty() { "_q" } else { "q" };
            let q = format!("{q}: &[S; {n}]{extras}");
            if !names.is_empty() {
                // What a function needs of the posture may depend on neither.
                out.code("#[allow(unused_variables)]");
            }
            out.code(INLINE);
            out.code(&format!("fn posture<S: Scalar>({constants}{q}) -> Posture<S> {{"));
            out.indent();
            values(out, needed, (self.stage, self.style));
            let fields = needed.fields().into_iter().chain(["..Posture::unused()".to_string()]);
            out.code(&format!("Posture {{ {} }}", fields.collect::<Vec<_>>().join(", ")));
            out.dedent();
            out.code("}");
            format!("posture({}q{names})", if offsets { "constants, " } else { "" })
        };
        out.code(&format!("{name}::given({})", self.arguments(&format!("&{posture}"))));
        out.dedent();
        out.code("}");
    }

    /// What the function returns: of an output its sentence, its shape with units, its formula.
    fn output(&self, out: &mut Lines) {
        let [sentence, rest @ ..] = docs(self.outputs[0], self.program().dof, shapes::ORDER);
        out.doc(&sentence);
        for paragraph in rest {
            out.doc("");
            out.doc(&paragraph);
        }
    }

    /// What goes into the function.
    fn inputs(&self) -> Vec<Input> {
        let taken = |input: &Input| self.outputs.iter().any(|output| output.takes(*input));
        Input::EACH.into_iter().filter(taken).collect()
    }

    /// The documentation of the kernel itself.
    pub fn kernel_docs(&self, out: &mut Lines) {
        if self.fused() {
            out.doc("The kernel: everything that [`All`] holds.");
        } else {
            self.output(out);
        }
        let mut read = self.inputs();
        read.retain(|input| match input {
            Input::Joints => !self.needs.reads.is_empty(),
            _ => self.plan.wrench().contains(&true),
        });
        if !read.is_empty() {
            out.doc("");
            out.doc(&inputs(&read, true));
        }
        out.doc("");
        out.doc("Additions and multiplications only, where no load is to be solved for.");
        self.errors(out);
    }

    fn errors(&self, out: &mut Lines) {
        if self.fallible() {
            out.doc("");
            out.doc("# Errors");
            out.doc("`Unstable` where the loaded arm has no stable equilibrium.");
        }
    }

    fn docs(&self, out: &mut Lines, robot: &Robot) {
        let ops = self.program().ops();
        if self.fused() {
            let names: Vec<&str> = self.outputs.iter().map(|o| o.name()).collect();
            out.doc(&format!("{} of {}, worked out together.", names.join(", "), robot.name));
        } else {
            self.output(out);
        }
        out.doc("");
        let given = inputs(&self.inputs(), false);
        let joints = format!("`{}`: {}", Input::Joints.name(), Input::Joints.sentence());
        out.doc(&given.replacen(&joints, &readings(self.stage), 1));
        out.doc("");
        let angles: Vec<String> =
            self.plan.angles.iter().map(|a| format!("θ{}", a.suffix)).collect();
        let division = if ops.div > 0 { format!(", {} divisions", ops.div) } else { String::new() };
        let trigonometry = match angles.is_empty() {
            true => "no sines or cosines".to_string(),
            false => format!("sines and cosines of {}", angles.join(", ")),
        };
        out.doc(&format!(
            "{} additions, {} multiplications{division}, {trigonometry}; worked out in {}.",
            ops.add,
            ops.mul,
            self.program().frame()
        ));
        self.errors(out);
    }

    fn module(&self, out: &mut Lines, body: &Body, options: &RustOptions) {
        out.doc(&format!("[`{0}`](fn@{0}) in parts, with its figures.", self.name()));
        out.code(&format!("pub mod {} {{", self.name()));
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
        let solves = 0..self.program().solves.len();
        if solves.clone().any(|k| self.plan.margin(k).is_some()) {
            imports.push("margin");
        }
        if !solves.is_empty() {
            imports.push(self.solve());
        }
        out.code(&format!("use {}::{{{}}};", options.kernels, imports.join(", ")));
        out.code("use super::Posture;");
        self.figures(out, body);
        if self.fused() {
            self.all_struct(out);
        }
        out.blank();
        body.text(out);
        out.dedent();
        out.code("}");
    }

    fn figures(&self, out: &mut Lines, body: &Body) {
        let ops = self.program().ops();
        out.blank();
        out.doc("Operations beyond the sines and cosines.");
        out.code(&format!(
            "pub const OPS: Ops = Ops {{ add: {}, mul: {}, neg: {}, div: {}, sin_cos: {} }};",
            ops.add, ops.mul, body.negations, ops.div, ops.sin_cos
        ));
        if self.fused() {
            return;
        }
        let (rows, columns) = self.outputs[0].shape(self.program().dof);
        out.blank();
        out.doc("Entries that are not structurally zero; `[column][row]`.");
        out.code(&format!("pub const SPARSITY: [[bool; {rows}]; {columns}] = ["));
        out.indent();
        for column in self.program().blocks[0].entries.chunks(rows) {
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
        for output in self.outputs {
            let [sentence, shape, _] = docs(*output, self.program().dof, shapes::ORDER);
            out.doc(&sentence);
            out.doc("");
            out.doc(&shape);
            out.code(&format!(
                "pub {}: {},",
                output.name(),
                shapes::ty(*output, self.program().dof)
            ));
        }
        out.dedent();
        out.code("}");
    }
}
