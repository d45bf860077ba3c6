//! One function in C: from the joint values, and from the posture.

use stiffarm_kernels::{Output, Side};

use super::Module;
use super::solve::solve_name;
use super::trigonometry::{Pair, declare};
use crate::derive::Block;
use crate::emit::lines::Lines;
use crate::ir::{self, Argument, Given, Solve, Statement, Style as _, Term};
use crate::number::Number;

/// A function to be printed.
pub(in crate::emit) struct Function<'a> {
    pub of: &'a ir::Function,
    pub module: &'a Module<'a>,
}

/// Whether a block can be left without a value.
pub(in crate::emit) fn may_fail(block: &Block) -> bool {
    block.held.output().is_some_and(Output::is_fallible)
}

impl Function<'_> {
    fn print(&self, term: &Term) -> String {
        term.print(&self.module.language)
    }

    fn real(&self) -> &'static str {
        self.module.language.real()
    }

    /// The head of the function of the joint values.
    pub fn by_joints(&self) -> String {
        let module = self.module;
        let name = format!("{}_{}", module.name(), self.of.full_name());
        self.head(&name, &module.parameters())
    }

    /// The head of the function of the posture.
    pub fn by_posture(&self) -> String {
        let module = self.module.name();
        let first = format!("const {module}_posture_t *posture");
        self.head(&format!("{module}_given_{}", self.of.full_name()), &first)
    }

    fn head(&self, name: &str, first: &str) -> String {
        let (real, module) = (self.real(), self.module.name());
        let returned =
            if self.of.fallible() { format!("{module}_status_t") } else { "void".to_string() };
        let size = |argument: &Argument| match argument.of {
            Given::Arm(input) if input.side() == Side::Joints => {
                format!("[{}_JOINTS]", module.to_uppercase())
            }
            _ => argument.size.map_or(String::new(), |size| format!("[{size}]")),
        };
        let beside: String = (self.of.arguments.iter())
            .map(|argument| {
                let constant = if argument.size.is_some() { "const " } else { "" };
                format!(", {constant}{real} {}{}", argument.name, size(argument))
            })
            .collect();
        let own = format!("{module}_{}", self.of.full_name());
        let out = match self.of.blocks() {
            [_] => format!("{real} out[{}_SIZE]", own.to_uppercase()),
            _ => format!("{own}_t *out"),
        };
        let linkage = self.module.language.linkage();
        format!("{linkage}{returned} {name}({first}{beside}, {out})")
    }

    /// The function of the joint values.
    pub fn write_by_joints(&self, out: &mut Lines) {
        let module = self.module.name();
        out.blank();
        out.code(&self.by_joints());
        out.braces(|out| {
            out.code(&format!("{module}_posture_t own = {{0}};"));
            if !self.of.reads.is_empty() {
                out.code(&format!("{module}_posture_t *const posture = &own;"));
            }
            out.blank();
            self.module.make_posture(out, &self.of.posture);
            let returned = if self.of.fallible() { "return " } else { "" };
            let beside = self.of.arguments.iter().map(|argument| format!(", {}", argument.name));
            let beside: String = beside.collect();
            let name = self.of.full_name();
            out.code(&format!("{returned}{module}_given_{name}(&own{beside}, out);"));
        });
    }

    /// The function of the posture: the kernel itself.
    pub fn write_by_posture(&self, out: &mut Lines) {
        let module = self.module.name();
        out.blank();
        out.code(&self.by_posture());
        out.braces(|out| {
            self.inputs(out);
            if self.of.fallible() {
                let upper = module.to_uppercase();
                out.code(&format!("{module}_status_t status = {upper}_OK;"));
            }
            out.blank();
            self.zeros(out, |block| !may_fail(block));
            let mut depth = 0;
            for step in &self.of.body {
                match step {
                    Statement::Let(name, value) => {
                        let value = self.print(value);
                        out.code(&format!("const {} {name} = {value};", self.real()));
                    }
                    Statement::Store { block, entry, value } => {
                        let place = self.place(*block, *entry);
                        out.code(&format!("{place} = {};", self.print(value)));
                    }
                    Statement::Solve(solve) => {
                        self.solve(out, depth, solve);
                        depth += 1;
                    }
                    Statement::SinCos(angles) => {
                        let pairs: Vec<Pair> =
                            angles.iter().map(|a| Pair::of(a, &self.module.language)).collect();
                        declare(out, &self.module.language, &pairs);
                    }
                }
            }
            self.zeros(out, may_fail);
            for _ in 0..depth {
                out.dedent();
                out.code("}");
            }
            if self.of.fallible() {
                out.code("return status;");
            }
        });
    }

    /// Whatever is read of the posture and the other inputs, as locals.
    fn inputs(&self, out: &mut Lines) {
        let real = self.real();
        for (name, field) in &self.of.reads {
            out.code(&format!("const {real} {name} = posture->{field};"));
        }
        for argument in &self.of.arguments {
            if !argument.is_read() {
                out.code(&format!("(void){};", argument.name));
            }
            let entries = argument.entries.iter().zip(&argument.read).enumerate();
            for (k, (name, _)) in entries.filter(|(_, (_, read))| **read && argument.size.is_some())
            {
                out.code(&format!("const {real} {name} = {}[{k}];", argument.name));
            }
        }
        if self.of.reads.is_empty() {
            out.code("(void)posture;");
        }
    }

    fn place(&self, block: usize, entry: usize) -> String {
        match self.of.blocks() {
            [_] => format!("out[{entry}]"),
            blocks => format!("out->{}[{entry}]", blocks[block].held.name()),
        }
    }

    /// Entries that are structurally zero.
    fn zeros(&self, out: &mut Lines, of: impl Fn(&Block) -> bool) {
        for (at, entry) in self.of.zeros().filter(|(at, _)| of(&self.of.blocks()[*at])) {
            out.code(&format!("{} = {};", self.place(at, entry), self.module.language.zero()));
        }
    }

    /// System `k`, and the block of what is worked out where it has a solution.
    fn solve(&self, out: &mut Lines, k: usize, solve: &Solve) {
        let (real, n) = (self.real(), solve.right.len());
        let array = |out: &mut Lines, name: &str, rows: &[Term]| {
            out.within(&format!("{real} {name}[{}] = {{", rows.len()), "};", |out| {
                for column in rows.chunks(n) {
                    let each: Vec<String> = column.iter().map(|term| self.print(term)).collect();
                    out.code(&format!("{},", each.join(", ")));
                }
            });
        };
        array(out, &format!("stiffness_{k}"), &solve.matrix);
        array(out, &format!("load_{k}"), &solve.right);
        out.blank();
        let function = solve_name(n, solve.leading);
        let margin = match solve.margin {
            Some(most) => {
                let [force, moment] = most.map(|most| self.module.language.number(most));
                format!("load_margin(wrench, {force}, {moment})")
            }
            // The pivots of a symmetric matrix are themselves the test.
            None => self.module.language.number(Number::integer(i128::from(solve.of_motion))),
        };
        out.code(&format!("status = {function}(stiffness_{k}, load_{k}, {margin});"));
        out.code(&format!("if (status == {})", self.module.constant("OK")));
        out.code("{");
        out.indent();
        for (row, unknown) in solve.unknowns.iter().enumerate() {
            if let Some(name) = unknown {
                out.code(&format!("const {real} {name} = load_{k}[{row}];"));
            }
        }
        out.blank();
    }
}
