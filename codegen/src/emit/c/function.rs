//! One function in C: from the joint values, and from the posture.

use stiffarm_kernels::{Input, Output};

use super::super::expression::{Printer, Style as _};
use super::super::plan::{Plan, Target, WRENCH};
use super::super::posture::Needs;
use super::posture::Entrance;
use super::solve::solve_name;
use super::style::C;
use crate::emit::lines::Lines;
use crate::expr::Binding;

/// A function to be printed: of one output, or of all of `Output::ALL`.
pub(super) struct Function<'a> {
    pub plan: &'a Plan<'a>,
    pub outputs: &'a [Output],
    pub needs: &'a Needs,
    pub language: &'a C,
    pub entrance: &'a Entrance<'a>,
}

impl Function<'_> {
    /// The output's name, or `all`.
    pub fn name(&self) -> &'static str {
        match self.outputs {
            [output] => output.name(),
            _ => "all",
        }
    }

    fn fallible(&self) -> bool {
        self.outputs.iter().any(|o| o.is_fallible())
    }

    /// Sizes of the linear systems, and of their leading blocks.
    pub fn systems(&self) -> impl Iterator<Item = (usize, usize)> {
        self.plan.program.solves.iter().map(|solve| (solve.right.len(), solve.leading()))
    }

    /// Sign changes that cost an operation of their own.
    pub fn negations(&self) -> u32 {
        let printer = self.printer();
        self.plan.program.roots().iter().map(|e| printer.negations(*e)).sum()
    }

    fn printer(&self) -> Printer<'_> {
        Printer { plan: self.plan, style: self.language }
    }

    /// The head of the function of the joint values.
    pub fn by_joints(&self, module: &str) -> String {
        self.head(&format!("{module}_{}", self.name()), &self.entrance.parameters(), module)
    }

    /// The head of the function of the posture.
    pub fn by_posture(&self, module: &str) -> String {
        let first = format!("const {module}_posture_t *posture");
        self.head(&format!("{module}_given_{}", self.name()), &first, module)
    }

    fn head(&self, name: &str, first: &str, module: &str) -> String {
        let real = self.language.real();
        let returned =
            if self.fallible() { format!("{module}_status_t") } else { "void".to_string() };
        let wrench =
            if self.wrench() { format!(", const {real} wrench[6]") } else { String::new() };
        let out = match self.outputs {
            [output] => {
                let size = format!("{module}_{}", output.name()).to_uppercase();
                format!("{real} out[{size}_SIZE]")
            }
            _ => format!("{module}_all_t *out"),
        };
        format!("{returned} {name}({first}{wrench}, {out})")
    }

    fn wrench(&self) -> bool {
        self.outputs.iter().any(|o| o.takes(Input::Wrench))
    }

    /// The function of the joint values.
    pub fn write_by_joints(&self, out: &mut Lines, module: &str) {
        out.blank();
        out.code(&self.by_joints(module));
        out.braces(|out| {
            out.code(&format!("{module}_posture_t own = {{0}};"));
            if !self.needs.reads.is_empty() {
                out.code(&format!("{module}_posture_t *const posture = &own;"));
            }
            out.blank();
            self.entrance.statements(out, &self.needs.posture);
            let returned = if self.fallible() { "return " } else { "" };
            let wrench = if self.wrench() { ", wrench" } else { "" };
            out.code(&format!("{returned}{module}_given_{}(&own{wrench}, out);", self.name()));
        });
    }

    /// The function of the posture: the kernel itself.
    pub fn write_by_posture(&self, out: &mut Lines, module: &str) {
        out.blank();
        out.code(&self.by_posture(module));
        out.braces(|out| {
            self.inputs(out);
            if self.fallible() {
                let upper = module.to_uppercase();
                out.code(&format!("{module}_status_t status = {upper}_OK;"));
            }
            out.blank();
            self.zeros(out, |output| !output.is_fallible());
            let mut depth = 0;
            for step in &self.plan.schedule.steps {
                match step {
                    Binding::Let(node) => self.local(out, *node),
                    Binding::Item(item) => match self.plan.targets[*item] {
                        Target::Entry { block, entry } => self.store(out, block, entry),
                        Target::Solve(k) => {
                            self.solve(out, k, module);
                            depth += 1;
                        }
                    },
                }
            }
            self.zeros(out, Output::is_fallible);
            for _ in 0..depth {
                out.dedent();
                out.code("}");
            }
            if self.fallible() {
                out.code("return status;");
            }
        });
    }

    /// Whatever is read of the posture and the wrench, as locals.
    fn inputs(&self, out: &mut Lines) {
        let real = self.language.real();
        for (name, field) in &self.needs.reads {
            out.code(&format!("const {real} {name} = posture->{field};"));
        }
        let components = self.plan.wrench();
        for (k, name) in WRENCH.iter().enumerate().filter(|(k, _)| components[*k]) {
            out.code(&format!("const {real} {name} = wrench[{k}];"));
        }
        if self.needs.reads.is_empty() {
            out.code("(void)posture;");
        }
        if self.wrench() && !components.contains(&true) {
            out.code("(void)wrench;");
        }
    }

    fn local(&self, out: &mut Lines, node: usize) {
        let name = self.plan.name(node).unwrap_or_default();
        let value = self.printer().definition(node);
        out.code(&format!("const {} {name} = {value};", self.language.real()));
    }

    fn place(&self, block: usize, entry: usize) -> String {
        match self.outputs {
            [_] => format!("out[{entry}]"),
            _ => format!("out->{}[{entry}]", self.plan.program.blocks[block].output.name()),
        }
    }

    fn store(&self, out: &mut Lines, block: usize, entry: usize) {
        let value = self.printer().print(self.plan.program.blocks[block].entries[entry]);
        out.code(&format!("{} = {value};", self.place(block, entry)));
    }

    /// Entries that are structurally zero.
    fn zeros(&self, out: &mut Lines, of: impl Fn(Output) -> bool) {
        let blocks = self.plan.program.blocks.iter().enumerate();
        for (at, block) in blocks.filter(|(_, b)| of(b.output)) {
            for (entry, _) in block.entries.iter().enumerate().filter(|(_, e)| e.is_zero()) {
                out.code(&format!("{} = {};", self.place(at, entry), self.language.zero()));
            }
        }
    }

    /// The system, and the block of what is worked out where it has a solution.
    fn solve(&self, out: &mut Lines, k: usize, module: &str) {
        let solve = &self.plan.program.solves[k];
        let (real, n, printer) = (self.language.real(), solve.right.len(), self.printer());
        let array = |out: &mut Lines, name: &str, rows: &[crate::expr::Expr]| {
            out.code(&format!("{real} {name}[{}] = {{", rows.len()));
            out.indent();
            for column in rows.chunks(n) {
                let each: Vec<String> = column.iter().map(|e| printer.print(*e)).collect();
                out.code(&format!("{},", each.join(", ")));
            }
            out.dedent();
            out.code("};");
        };
        array(out, &format!("stiffness_{k}"), &solve.matrix);
        array(out, &format!("load_{k}"), &solve.right);
        out.blank();
        let function = solve_name(n, solve.leading());
        let margin = match self.plan.margin(k) {
            Some(most) => {
                let [force, moment] = most.map(|most| self.language.number(most));
                format!("load_margin(wrench, {force}, {moment})")
            }
            None => self.language.zero(),
        };
        out.code(&format!("status = {function}(stiffness_{k}, load_{k}, {margin});"));
        out.code(&format!("if (status == {}_OK)", module.to_uppercase()));
        out.code("{");
        out.indent();
        for (row, unknown) in solve.unknowns.iter().enumerate() {
            if let Some(name) = self.plan.name(unknown.node()) {
                out.code(&format!("const {real} {name} = load_{k}[{row}];"));
            }
        }
        out.blank();
    }
}
