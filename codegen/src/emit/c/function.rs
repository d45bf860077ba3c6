//! One function in C: from the joint values, and from the posture.

use stiffarm_kernels::{Output, Side};

use super::super::expression::{Printer, Style as _};
use super::super::plan::{Argument, Given, Plan, Target};
use super::super::posture::Needs;
use super::posture::Entrance;
use super::solve::solve_name;
use super::style::C;
use super::trigonometry::{Pair, declare};
use crate::derive::{Block, Own};
use crate::emit::lines::Lines;
use crate::expr::Binding;

/// A function to be printed: of one output, of those of `all`, or of one's own.
pub(super) struct Function<'a> {
    pub plan: &'a Plan<'a>,
    /// The frame or marker that it is of; `None` is the tool.
    pub place: Option<&'a str>,
    pub needs: &'a Needs,
    pub language: &'a C,
    pub entrance: &'a Entrance<'a>,
}

impl<'a> Function<'a> {
    /// The output's name, with the place that it is of: `at_elbow_jacobian`; or `all`, or its own.
    pub fn name(&self) -> String {
        match (self.own(), self.blocks(), self.place) {
            (Some(own), ..) => own.name.clone(),
            (None, [block], None) => block.held.name().to_owned(),
            (None, [block], Some(place)) => format!("at_{place}_{}", block.held.name()),
            _ => "all".to_owned(),
        }
    }

    pub fn blocks(&self) -> &'a [Block] {
        &self.plan.program.blocks
    }

    /// What it says of itself, where it is one's own.
    pub fn own(&self) -> Option<&'a Own> {
        self.plan.program.own.as_ref()
    }

    /// Whether a block can be left without a value.
    fn may_fail(block: &Block) -> bool {
        block.held.output().is_some_and(Output::is_fallible)
    }

    pub fn fallible(&self) -> bool {
        self.blocks().iter().any(Self::may_fail)
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
        let size = |argument: &Argument| match argument.of {
            Given::Arm(input) if input.side() == Side::Joints => {
                format!("[{}_JOINTS]", module.to_uppercase())
            }
            _ => argument.size.map_or(String::new(), |size| format!("[{size}]")),
        };
        let beside: String = (self.plan.arguments().iter())
            .map(|argument| {
                let constant = if argument.size.is_some() { "const " } else { "" };
                format!(", {constant}{real} {}{}", argument.name, size(argument))
            })
            .collect();
        let out = match self.blocks() {
            [_] => {
                let size = format!("{module}_{}", self.name()).to_uppercase();
                format!("{real} out[{size}_SIZE]")
            }
            _ => format!("{module}_{}_t *out", self.name()),
        };
        format!("{returned} {name}({first}{beside}, {out})")
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
            let beside: String = self
                .plan
                .arguments()
                .iter()
                .map(|argument| format!(", {}", argument.name))
                .collect();
            out.code(&format!("{returned}{module}_given_{}(&own{beside}, out);", self.name()));
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
            self.zeros(out, |block| !Self::may_fail(block));
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
                        Target::Angles(k) => self.angles(out, k),
                    },
                }
            }
            self.zeros(out, Self::may_fail);
            for _ in 0..depth {
                out.dedent();
                out.code("}");
            }
            if self.fallible() {
                out.code("return status;");
            }
        });
    }

    /// Whatever is read of the posture and the other inputs, as locals.
    fn inputs(&self, out: &mut Lines) {
        let real = self.language.real();
        for (name, field) in &self.needs.reads {
            out.code(&format!("const {real} {name} = posture->{field};"));
        }
        for argument in &self.plan.arguments() {
            let read = self.plan.read(argument, self.plan.named());
            if !read.contains(&true) {
                out.code(&format!("(void){};", argument.name));
            }
            for k in (0..read.len()).filter(|k| read[*k] && argument.size.is_some()) {
                let name = self.plan.entry(argument, k);
                out.code(&format!("const {real} {name} = {}[{k}];", argument.name));
            }
        }
        if self.needs.reads.is_empty() {
            out.code("(void)posture;");
        }
    }

    fn local(&self, out: &mut Lines, node: usize) {
        let name = self.plan.name(node).unwrap_or_default();
        let value = self.printer().definition(node);
        out.code(&format!("const {} {name} = {value};", self.language.real()));
    }

    fn place(&self, block: usize, entry: usize) -> String {
        match self.blocks() {
            [_] => format!("out[{entry}]"),
            blocks => format!("out->{}[{entry}]", blocks[block].held.name()),
        }
    }

    fn store(&self, out: &mut Lines, block: usize, entry: usize) {
        let value = self.printer().print(self.plan.program.blocks[block].entries[entry]);
        out.code(&format!("{} = {value};", self.place(block, entry)));
    }

    /// Entries that are structurally zero.
    fn zeros(&self, out: &mut Lines, of: impl Fn(&Block) -> bool) {
        for (at, block) in self.blocks().iter().enumerate().filter(|(_, block)| of(block)) {
            for (entry, _) in block.entries.iter().enumerate().filter(|(_, e)| e.is_zero()) {
                out.code(&format!("{} = {};", self.place(at, entry), self.language.zero()));
            }
        }
    }

    /// Sines and cosines of angles that are not the posture's.
    fn angles(&self, out: &mut Lines, k: usize) {
        let name = |letter, used: bool, suffix: &str| used.then(|| format!("{letter}{suffix}"));
        let pairs = self.plan.own_angles[k].iter().map(|angle| Pair {
            angle: self.printer().print(angle.sum),
            sine: name('s', angle.sine, &angle.suffix),
            cosine: name('c', angle.cosine, &angle.suffix),
        });
        declare(out, self.language, &pairs.collect::<Vec<_>>());
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
