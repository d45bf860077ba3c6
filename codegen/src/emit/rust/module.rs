//! The text of one function, and of the module of the same name that holds its parts.

use stiffarm_kernels::{Form, Input};

use super::RustOptions;
use super::function::{Function, parameter};
use super::posture::{self, INLINE, readings, values};
use super::shapes;
use super::table::imports;
use crate::derive::Block;
use crate::emit::docs::{ALL_ZERO, docs, inputs};
use crate::emit::lines::Lines;
use crate::ir::Statement;

impl Function<'_> {
    /// The function and its module.
    pub fn text(&self, options: &RustOptions) -> String {
        let mut out = Lines::at(self.depth);
        out.blank();
        self.entry(&mut out);
        out.blank();
        self.module(&mut out, options);
        out.finish()
    }

    /// The public function: what it needs of the posture from `q`, then the kernel.
    fn entry(&self, out: &mut Lines) {
        self.docs(out);
        let (needed, whole) = (&self.of.posture, &self.module.posture);
        let all = needed.fields().len() == whole.fields().len();
        let offsets = if all { whole } else { needed }.reads_constants();
        let mut parameters = Vec::new();
        if self.module.is_symbolic() {
            parameters.push("constants: &Constants<S>".to_string());
        }
        let n = self.of.program.dof;
        let extras = posture::parameters(&self.module.readings, n).concat();
        parameters.push(format!("q: &[S; {n}]{extras}"));
        parameters.extend(self.of.arguments.iter().map(|a| parameter(&a.name, a.size)));
        let (name, returned) = (self.of.name(), self.returned(false));
        out.within(
            &format!("pub fn {name}<S: Scalar>({}) -> {returned} {{", parameters.join(", ")),
            "}",
            |out| {
                let names = self.module.readings.handed_on();
                let posture = if all {
                    format!("Posture::new({}q{names})", if offsets { "constants, " } else { "" })
                } else {
                    let constants = if offsets { "constants: &Constants<S>, " } else { "" };
                    let q = if self.of.reads.is_empty() { "_q" } else { "q" };
                    let q = format!("{q}: &[S; {n}]{extras}");
                    if !names.is_empty() {
                        // What a function needs of the posture may depend on neither.
                        out.code("#[allow(unused_variables)]");
                    }
                    out.code(INLINE);
                    out.within(
                        &format!("fn posture<S: Scalar>({constants}{q}) -> Posture<S> {{"),
                        "}",
                        |out| {
                            values(out, needed, (&self.module.readings, self.style), true);
                            let fields =
                                needed.fields().into_iter().chain(["..Posture::unused()".into()]);
                            out.code(&format!(
                                "Posture {{ {} }}",
                                fields.collect::<Vec<_>>().join(", ")
                            ));
                        },
                    );
                    format!("posture({}q{names})", if offsets { "constants, " } else { "" })
                };
                out.code(&format!("{name}::given({})", self.arguments(&format!("&{posture}"))));
            },
        );
    }

    /// What the function returns: of one's own its sentence; of an output or a result its sentence, its shape with
    /// units, its formula.
    fn output(&self, out: &mut Lines) {
        let own = self.of.own().map(|own| format!("{}.", own.sentence.trim_end_matches('.')));
        let returned = match self.of.blocks() {
            [block] => docs(&block.held, self.of.program.dof, shapes::ORDER),
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
        let name = self.of.name();
        out.doc(&format!(
            "[`{name}`](fn@super::{name}) of a posture, which may serve several functions."
        ));
        self.errors(out);
    }

    fn errors(&self, out: &mut Lines) {
        if self.of.fallible() {
            out.doc("");
            out.doc("# Errors");
            out.doc(self.refusal());
        }
    }

    /// When there is no result.
    pub fn refusal(&self) -> &'static str {
        match self.of.outputs().any(|output| output.is_of_motion()) {
            true => {
                "`Unstable` where a joint moves no mass: its acceleration is then not determined."
            }
            false => "`Unstable` where the loaded arm has no stable equilibrium.",
        }
    }

    fn docs(&self, out: &mut Lines) {
        let ops = self.of.program.ops();
        if self.fused() && self.of.own().is_none() {
            let names: Vec<&str> = self.of.blocks().iter().map(|block| block.held.name()).collect();
            out.doc(&format!(
                "{} of {}, worked out together.",
                names.join(", "),
                self.module.robot.name
            ));
        } else {
            self.output(out);
        }
        out.doc("");
        let given = inputs(self.of.program.inputs(), self.of.own());
        let joints = format!("`{}`: {}", Input::Joints.name(), Input::Joints.sentence());
        out.doc(&given.replacen(&joints, &readings(&self.module.readings), 1));
        out.doc("");
        let angles: Vec<String> = self.of.angles.iter().map(|a| format!("θ{}", a.suffix)).collect();
        let counted = |count: u32, what: &str| match count {
            0 => String::new(),
            count => format!(", {count} {what}"),
        };
        let division = counted(ops.div, "divisions") + &counted(ops.atan2, "arctangents");
        let mut trigonometry = match angles.is_empty() {
            true => "no sines or cosines".to_string(),
            false => format!("sines and cosines of {}", angles.join(", ")),
        };
        let own = self.of.body.iter().map(|step| match step {
            Statement::SinCos(angles) => angles.len(),
            _ => 0,
        });
        match own.sum() {
            0 => {}
            more => trigonometry.push_str(&format!(" and of {more} more")),
        }
        let solves: String = self
            .of
            .solves()
            .map(|solve| format!(", beside a linear system of {}", solve.right.len()))
            .collect();
        out.doc(&format!(
            "{} additions, {} multiplications{division}, {trigonometry}{solves}; worked out in {}.",
            ops.add,
            ops.mul,
            self.of.program.frame()
        ));
        if self.of.is_zero() {
            out.doc("");
            out.doc(ALL_ZERO);
        }
        if self.of.own().is_some_and(|own| !own.finite) && ops.div > 0 {
            out.doc("");
            out.doc("Where a divisor, or what a root is taken of, is zero, what depends on it is not finite.");
        }
        self.errors(out);
    }

    fn module(&self, out: &mut Lines, options: &RustOptions) {
        out.doc(&format!("[`{0}`](fn@{0}) in parts, with its figures.", self.of.name()));
        out.within(&format!("pub mod {} {{", self.of.name()), "}", |out| {
            let poses = self.of.outputs().any(|o| matches!(o.form(), Form::Pose | Form::Poses));
            let uses = [
                (true, "Ops Scalar"),
                (poses, "Pose"),
                (self.of.fallible(), "Unstable"),
                (self.of.solves().any(|solve| solve.margin.is_some()), "margin"),
                (self.of.solves().next().is_some(), self.style.solve()),
            ];
            imports(out, options, &uses);
            out.code("use super::Posture;");
            self.figures(out);
            if self.fused() {
                self.results(out);
            }
            out.blank();
            self.kernels(out);
        });
    }

    fn figures(&self, out: &mut Lines) {
        let ops = self.of.program.ops();
        out.blank();
        out.doc(match self.of.solves().next() {
            None => "Operations beyond the sines and cosines.",
            Some(_) => "Operations beyond the sines and cosines, and beyond the solution of the linear system.",
        });
        out.code(&format!(
            "pub const OPS: Ops = Ops {{ add: {}, mul: {}, neg: {}, div: {}, sin_cos: {} }};",
            ops.add, ops.mul, self.of.negations, ops.div, ops.sin_cos
        ));
        let [block] = self.of.blocks() else { return };
        let (rows, columns) = block.held.shape(self.of.program.dof);
        out.blank();
        out.doc("Entries that are not structurally zero; `[column][row]`.");
        out.within(&format!("pub const SPARSITY: [[bool; {rows}]; {columns}] = ["), "];", |out| {
            for column in block.entries.chunks(rows) {
                let flags: Vec<String> =
                    column.iter().map(|e| (!e.is_zero()).to_string()).collect();
                out.code(&format!("[{}],", flags.join(", ")));
            }
        });
    }

    /// The struct of everything that the function computes.
    fn results(&self, out: &mut Lines) {
        let n = self.of.program.dof;
        out.blank();
        out.doc(&format!("Everything that [`{0}`](fn@super::{0}) computes.", self.of.name()));
        out.code("#[derive(Clone, Copy, Debug, PartialEq)]");
        out.within(&format!("pub struct {}<S> {{", self.structure()), "}", |out| {
            for Block { held, .. } in self.of.blocks() {
                let sentences = docs(held, n, shapes::ORDER);
                out.doc(&sentences[0]);
                if held.output().is_none() {
                    out.doc("");
                    out.doc(&sentences[1]);
                }
                out.code(&format!("pub {}: {},", held.name(), shapes::ty(held, n)));
            }
        });
        out.blank();
        out.within(&format!("impl<S: Scalar> {}<S> {{", self.structure()), "}", |out| {
            out.doc("Every number zero: a place for `write`.");
            out.within("pub fn zero() -> Self {", "}", |out| {
                out.code("let zero = S::lit(0.0);");
                out.code(&self.zero());
            });
        });
    }
}
