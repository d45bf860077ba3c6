//! The kernel itself, cut into scopes and functions that the compiler can digest.

use std::collections::HashSet;

use super::super::expression::{Printer, Style, constant};
use super::super::plan::{Plan, Target, WRENCH};
use super::function::Function;
use super::posture::{INLINE, field_names, has_posture, uses_wrench};
use crate::emit::lines::Lines;
use crate::expr::{Binding, Block, Expr, Node, Symbol};
use crate::number::Number;

/// Names in one scope; rustc's recursion over a scope's statements overflows at a few thousand.
pub(super) const BLOCK: usize = 256;
/// Blocks in one function.
const BLOCKS: usize = 7;

/// The kernel itself, cut into scopes that the compiler can digest.
pub(super) struct Body<'a> {
    plan: &'a Plan<'a>,
    printer: Printer<'a>,
    /// Sign changes that cost an operation of their own.
    pub negations: u32,
}

impl<'a> Body<'a> {
    pub fn new(function: &Function, plan: &'a Plan<'a>) -> Self {
        let style: &dyn Style = if function.fused_products { &FusedRust } else { &Rust };
        let printer = Printer { plan, style };
        let negations = function.program.roots().iter().map(|e| printer.negations(*e)).sum();
        Body { plan, printer, negations }
    }

    pub fn text(&self, out: &mut Lines, function: &Function) {
        let schedule = &self.plan.schedule;
        let everything = 0..schedule.steps.len();
        let solves = |item: usize| matches!(self.plan.targets[item], Target::Solve(_));
        let blocks = schedule.blocks(everything.clone(), BLOCK, solves);
        let small = schedule.lets() <= BLOCK;
        let parts = if small { Vec::new() } else { self.parts(&blocks) };

        out.doc(
            "The kernel: additions and multiplications only, where no load is to be solved for.",
        );
        if function.fallible() {
            out.doc("");
            out.doc("# Errors");
            out.doc("`Unstable` where the loaded arm has no stable equilibrium.");
        }
        if function.fallible() && function.program.solves.is_empty() {
            out.code("#[allow(clippy::unnecessary_wraps)]");
        }
        if small {
            out.code(INLINE);
        }
        out.code(&format!(
            "pub fn given<S: Scalar>({}) -> {} {{",
            self.signature(function).join(", "),
            function.returned(true)
        ));
        out.indent();
        if small || parts.len() <= 1 {
            self.open_inputs(out, everything.clone());
        } else {
            let read: Vec<usize> = self.solve_inputs();
            self.destructure(out, &self.plan.inputs_of(read));
        }
        out.code("let zero = S::lit(0.0);");
        let mutable =
            if function.program.roots().iter().any(|e| !e.is_zero()) { "mut " } else { "" };
        out.code(&format!("let {mutable}out = {};", function.zero()));
        if small {
            self.steps(out, function, everything);
        } else if parts.len() <= 1 {
            blocks.iter().for_each(|block| self.block(out, function, block));
        } else {
            self.calls(out, function, &parts);
        }
        out.code(if function.fallible() { "Ok(out)" } else { "out" });
        out.dedent();
        out.code("}");
        if parts.len() > 1 {
            let computing = parts.iter().enumerate().filter(|(_, p)| !self.is_solve(&p.blocks[0]));
            computing.for_each(|(k, part)| self.part(out, function, k, part));
        }
    }

    /// Runs of blocks, each a function of its own; a solve is a run by itself.
    fn parts(&self, blocks: &[Block]) -> Vec<Part> {
        let mut parts: Vec<Part> = Vec::new();
        for block in blocks {
            let alone = self.is_solve(block);
            let full = parts.last().is_none_or(|p| {
                p.blocks.len() == BLOCKS || p.blocks.first().is_some_and(|b| self.is_solve(b))
            });
            if alone || full {
                parts.push(Part { blocks: Vec::new(), whole: block.clone() });
            }
            if let Some(part) = parts.last_mut() {
                part.blocks.push(block.clone());
            }
        }
        for part in &mut parts {
            let (start, end) =
                (part.blocks[0].steps.start, part.blocks[part.blocks.len() - 1].steps.end);
            part.whole = self.plan.schedule.block(start..end);
        }
        parts
    }

    fn is_solve(&self, block: &Block) -> bool {
        let first = self.plan.schedule.steps[block.steps.start];
        matches!(first, Binding::Item(item) if matches!(self.plan.targets[item], Target::Solve(_)))
    }

    fn signature(&self, function: &Function) -> Vec<String> {
        let mut parameters = Vec::new();
        if !self.plan.constants.is_empty() {
            parameters.push("constants: &super::Constants<S>".to_string());
        }
        if has_posture(self.plan) {
            parameters.push("posture: &Posture<S>".to_string());
        }
        if function.wrench() && uses_wrench(self.plan) {
            parameters.push("wrench: &[S; 6]".to_string());
        }
        parameters
    }

    /// Nodes that a range of steps reads without their being named in the schedule.
    fn reads(&self, steps: core::ops::Range<usize>) -> Vec<usize> {
        let mut nodes = Vec::new();
        for step in &self.plan.schedule.steps[steps] {
            match step {
                Binding::Let(node) => {
                    let operands = self.plan.program.graph.nodes()[*node].operands();
                    nodes.extend(operands.map(Expr::node));
                }
                Binding::Item(item) => nodes.extend(self.item_inputs(*item)),
            }
        }
        let bound = &self.plan.schedule.bound;
        nodes.retain(|node| !bound[*node]);
        nodes
    }

    fn item_inputs(&self, item: usize) -> Vec<usize> {
        match self.plan.targets[item] {
            Target::Solve(k) => {
                let solve = &self.plan.program.solves[k];
                solve.matrix.iter().chain(&solve.right).map(|e| e.node()).collect()
            }
            Target::Entry { block, entry } => {
                vec![self.plan.program.blocks[block].entries[entry].node()]
            }
        }
    }

    fn solve_inputs(&self) -> Vec<usize> {
        let items = 0..self.plan.targets.len();
        let solves = items.filter(|i| matches!(self.plan.targets[*i], Target::Solve(_)));
        let bound = &self.plan.schedule.bound;
        solves.flat_map(|i| self.item_inputs(i)).filter(|node| !bound[*node]).collect()
    }

    fn open_inputs(&self, out: &mut Lines, steps: core::ops::Range<usize>) {
        let inputs = self.plan.inputs_of(self.reads(steps));
        self.destructure(out, &inputs);
    }

    /// `let Posture { s1, c1, .. } = *posture;` and the wrench, whatever of them is read.
    fn destructure(&self, out: &mut Lines, inputs: &HashSet<usize>) {
        let g = &self.plan.program.graph;
        let mut fields: Vec<(usize, String)> = Vec::new();
        let mut wrench = [false; 6];
        for node in inputs {
            let name = self.plan.name(*node).unwrap_or_default().to_string();
            match g.nodes()[*node] {
                _ if name.starts_with("constants.") => {}
                Node::Sin(_) | Node::Cos(_) => fields.push((*node, name)),
                Node::Symbol(s) => match g.symbol_of(s) {
                    Symbol::Joint(_) => fields.push((*node, name)),
                    Symbol::Wrench(k) => wrench[*k] = true,
                    _ => {}
                },
                _ => {}
            }
        }
        let order = field_names(self.plan);
        fields.sort_by_key(|(_, name)| order.iter().position(|f| f == name));
        if !fields.is_empty() {
            let names: Vec<String> = fields.iter().map(|(_, name)| name.clone()).collect();
            let rest = if names.len() < order.len() { ", .." } else { "" };
            out.code(&format!("let Posture {{ {}{rest} }} = *posture;", names.join(", ")));
        }
        if wrench.contains(&true) {
            let names: Vec<&str> =
                WRENCH.iter().zip(wrench).map(|(n, used)| if used { *n } else { "_" }).collect();
            out.code(&format!("let [{}] = *wrench;", names.join(", ")));
        }
    }

    fn steps(&self, out: &mut Lines, function: &Function, steps: core::ops::Range<usize>) {
        for step in &self.plan.schedule.steps[steps] {
            match step {
                Binding::Let(node) => {
                    let name = self.plan.name(*node).unwrap_or_default();
                    out.code(&format!("let {name} = {};", self.printer.definition(*node)));
                }
                Binding::Item(item) => match self.plan.targets[*item] {
                    Target::Solve(k) => self.solve(out, function, k),
                    Target::Entry { block, entry } => {
                        let e = function.program.blocks[block].entries[entry];
                        let place = function.place(block, entry);
                        out.code(&format!("{place} = {};", self.printer.print(e)));
                    }
                },
            }
        }
    }

    fn solve(&self, out: &mut Lines, function: &Function, k: usize) {
        let solve = &function.program.solves[k];
        let n = solve.right.len();
        let print = |e: &Expr| self.printer.print(*e);
        out.code("let stiffness = [");
        out.indent();
        for column in solve.matrix.chunks(n) {
            out.code(&format!("[{}],", column.iter().map(print).collect::<Vec<_>>().join(", ")));
        }
        out.dedent();
        out.code("];");
        let right: Vec<String> = solve.right.iter().map(print).collect();
        out.code(&format!("let load = [{}];", right.join(", ")));
        let unknowns: Vec<usize> = solve.unknowns.iter().map(|u| u.node()).collect();
        let (names, (solve, constants)) = (self.names(&unknowns), function.solve(k));
        out.code(&format!("let [{names}] = {solve}{constants}(stiffness, load)?;"));
    }

    fn names(&self, nodes: &[usize]) -> String {
        let names: Vec<&str> = nodes.iter().filter_map(|node| self.plan.name(*node)).collect();
        names.join(", ")
    }

    /// A scope of its own that hands on what is still needed.
    fn block(&self, out: &mut Lines, function: &Function, block: &Block) {
        if self.is_solve(block) {
            return self.steps(out, function, block.steps.clone());
        }
        let live = self.names(&block.live_out);
        let open = if live.is_empty() { "{".to_string() } else { format!("let [{live}] = {{") };
        out.code(&open);
        out.indent();
        self.steps(out, function, block.steps.clone());
        if !live.is_empty() {
            out.code(&format!("[{live}]"));
        }
        out.dedent();
        out.code(if live.is_empty() { "}" } else { "};" });
    }

    fn calls(&self, out: &mut Lines, function: &Function, parts: &[Part]) {
        for (k, part) in parts.iter().enumerate() {
            if self.is_solve(&part.blocks[0]) {
                self.steps(out, function, part.blocks[0].steps.clone());
                continue;
            }
            let names = self.arguments(function);
            let (live_in, live_out) =
                (self.names(&part.whole.live_in), self.names(&part.whole.live_out));
            let binding =
                if live_out.is_empty() { String::new() } else { format!("let [{live_out}] = ") };
            let arguments: Vec<String> =
                names.into_iter().chain([format!("[{live_in}]"), "&mut out".to_string()]).collect();
            out.code(&format!("{binding}part_{}({});", k + 1, arguments.join(", ")));
        }
    }

    fn arguments(&self, function: &Function) -> Vec<String> {
        let names = self.signature(function);
        let bare = names.iter().filter_map(|p| p.split(':').next());
        bare.map(str::to_string).collect()
    }

    fn part(&self, out: &mut Lines, function: &Function, k: usize, part: &Part) {
        let (ins, outs) = (part.whole.live_in.len(), part.whole.live_out.len());
        let mut parameters = self.signature(function);
        parameters.push(format!("live: [S; {ins}]"));
        parameters.push(format!("out: &mut {}", function.ty()));
        let returned = if outs == 0 { String::new() } else { format!(" -> [S; {outs}]") };
        out.blank();
        // Which of the inputs a part reads depends on where the text was cut.
        out.code("#[allow(unused_variables)]");
        let head = format!("fn part_{}<S: Scalar>({}){returned} {{", k + 1, parameters.join(", "));
        out.code(&head);
        out.indent();
        self.open_inputs(out, part.whole.steps.clone());
        out.code(&format!("let [{}] = live;", self.names(&part.whole.live_in)));
        part.blocks.iter().for_each(|block| self.block(out, function, block));
        if outs > 0 {
            out.code(&format!("[{}]", self.names(&part.whole.live_out)));
        }
        out.dedent();
        out.code("}");
    }
}

/// A run of blocks, and the names that cross its borders.
struct Part {
    blocks: Vec<Block>,
    whole: Block,
}

/// Rust over the scalar trait.
pub(super) struct Rust;

impl Style for Rust {
    fn number(&self, n: Number) -> String {
        format!("S::lit({})", constant(n))
    }
    fn name(&self, name: &str) -> String {
        name.to_string()
    }
    fn product(&self, a: &str, b: &str) -> String {
        format!("{a} * {b}")
    }
    fn bracket(&self, inner: &str) -> String {
        format!("({inner})")
    }
    fn recip(&self, a: &str) -> String {
        format!("({a}).recip()")
    }
    fn sqrt(&self, a: &str) -> String {
        format!("({a}).sqrt()")
    }
}

/// The same with products fused into sums.
struct FusedRust;

impl Style for FusedRust {
    fn number(&self, n: Number) -> String {
        Rust.number(n)
    }
    fn name(&self, name: &str) -> String {
        Rust.name(name)
    }
    fn product(&self, a: &str, b: &str) -> String {
        Rust.product(a, b)
    }
    fn bracket(&self, inner: &str) -> String {
        Rust.bracket(inner)
    }
    fn recip(&self, a: &str) -> String {
        Rust.recip(a)
    }
    fn sqrt(&self, a: &str) -> String {
        Rust.sqrt(a)
    }
    fn fused(&self, a: &str, b: &str, c: &str) -> Option<String> {
        Some(format!("S::mul_add({a}, {b}, {c})"))
    }
}
