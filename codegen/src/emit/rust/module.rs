//! The text of one function, and of the module of the same name that holds its parts.

use stiffarm_kernels::{Form, Input};

use super::super::plan::Given;
use super::RustOptions;
use super::body::Body;
use super::function::{Function, parameter};
use super::posture::{self, INLINE, needs_constants, readings, values};
use super::shapes;
use crate::derive::Block;
use crate::emit::docs::{docs, inputs};
use crate::emit::lines::Lines;
use crate::robot::Robot;

impl Function<'_> {
    /// The function and its module.
    pub fn text(&self, robot: &Robot, options: &RustOptions) -> String {
        let body = Body::new(self);
        let mut out = Lines::at(self.depth);
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
        let arguments = self.plan.arguments();
        parameters.extend(arguments.iter().map(|a| parameter(&a.name, a.size)));
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

    /// What the function returns: of one's own its sentence; of an output or a result its sentence, its shape with
    /// units, its formula.
    fn output(&self, out: &mut Lines) {
        let own = self.own().map(|own| format!("{}.", own.sentence.trim_end_matches('.')));
        let returned = match self.blocks() {
            [block] => docs(&block.held, self.program().dof, shapes::ORDER),
            _ => Vec::new(),
        };
        for (k, paragraph) in own.into_iter().chain(returned).enumerate() {
            if k > 0 {
                out.doc("");
            }
            out.doc(&paragraph);
        }
    }

    /// The documentation of the kernel itself.
    pub fn kernel_docs(&self, out: &mut Lines) {
        if self.fused() {
            out.doc(&format!("The kernel: everything that [`{}`] holds.", self.structure()));
        } else {
            self.output(out);
        }
        let mut read: Vec<Input> = self.program().inputs().collect();
        let arguments = self.plan.arguments();
        read.retain(|input| match input {
            Input::Joints => !self.needs.reads.is_empty(),
            beside => arguments.iter().any(|a| a.of == Given::Arm(*beside) && self.plan.reads(a)),
        });
        if !read.is_empty() || self.own().is_some_and(|own| !own.inputs.is_empty()) {
            out.doc("");
            out.doc(&inputs(read, true, self.own()));
        }
        if self.own().is_none() {
            out.doc("");
            out.doc("Additions and multiplications only, where no load is to be solved for.");
        }
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
        if self.fused() && self.own().is_none() {
            let names: Vec<&str> = self.blocks().iter().map(|block| block.held.name()).collect();
            out.doc(&format!("{} of {}, worked out together.", names.join(", "), robot.name));
        } else {
            self.output(out);
        }
        out.doc("");
        let given = inputs(self.program().inputs(), false, self.own());
        let joints = format!("`{}`: {}", Input::Joints.name(), Input::Joints.sentence());
        out.doc(&given.replacen(&joints, &readings(self.stage), 1));
        out.doc("");
        let angles: Vec<String> =
            self.plan.angles.iter().map(|a| format!("θ{}", a.suffix)).collect();
        let division = if ops.div > 0 { format!(", {} divisions", ops.div) } else { String::new() };
        let mut trigonometry = match angles.is_empty() {
            true => "no sines or cosines".to_string(),
            false => format!("sines and cosines of {}", angles.join(", ")),
        };
        match self.plan.own_angles.iter().map(Vec::len).sum() {
            0 => {}
            more => trigonometry.push_str(&format!(" and of {more} more")),
        }
        out.doc(&format!(
            "{} additions, {} multiplications{division}, {trigonometry}; worked out in {}.",
            ops.add,
            ops.mul,
            self.program().frame()
        ));
        if self.own().is_some() && ops.div > 0 {
            out.doc("");
            out.doc("Where a divisor, or what a root is taken of, is zero, what depends on it is not finite.");
        }
        self.errors(out);
    }

    fn module(&self, out: &mut Lines, body: &Body, options: &RustOptions) {
        out.doc(&format!("[`{0}`](fn@{0}) in parts, with its figures.", self.name()));
        out.code(&format!("pub mod {} {{", self.name()));
        out.indent();
        let mut imports = vec!["Ops"];
        if self.outputs().any(|o| matches!(o.form(), Form::Pose | Form::Poses)) {
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
            self.results(out);
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
        let [block] = self.blocks() else { return };
        let (rows, columns) = block.held.shape(self.program().dof);
        out.blank();
        out.doc("Entries that are not structurally zero; `[column][row]`.");
        out.code(&format!("pub const SPARSITY: [[bool; {rows}]; {columns}] = ["));
        out.indent();
        for column in block.entries.chunks(rows) {
            let flags: Vec<String> = column.iter().map(|e| (!e.is_zero()).to_string()).collect();
            out.code(&format!("[{}],", flags.join(", ")));
        }
        out.dedent();
        out.code("];");
    }

    /// The struct of everything that the function computes.
    fn results(&self, out: &mut Lines) {
        let n = self.program().dof;
        out.blank();
        out.doc(&format!("Everything that [`{0}`](fn@super::{0}) computes.", self.name()));
        out.code("#[derive(Clone, Copy, Debug, PartialEq)]");
        out.code(&format!("pub struct {}<S> {{", self.structure()));
        out.indent();
        for Block { held, .. } in self.blocks() {
            let sentences = docs(held, n, shapes::ORDER);
            out.doc(&sentences[0]);
            out.doc("");
            out.doc(&sentences[1]);
            out.code(&format!("pub {}: {},", held.name(), shapes::ty(held, n)));
        }
        out.dedent();
        out.code("}");
    }
}
