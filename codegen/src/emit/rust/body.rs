//! The kernel itself, cut into scopes and functions that the compiler can digest.

use super::super::angles::Angle;
use super::super::expression::Printer;
use super::super::plan::{Plan, Target};
use super::function::Function;
use super::inputs::{open_inputs, open_solve_inputs};
use super::posture::INLINE;
use crate::emit::lines::Lines;
use crate::expr::{Binding, Block, Expr};

/// Names in one scope; rustc's recursion over a scope's statements overflows at a few thousand.
pub(super) const BLOCK: usize = 256;
/// Blocks in one function.
const BLOCKS: usize = 7;

/// The kernel itself, cut into scopes that the compiler can digest.
pub(super) struct Body<'a> {
    plan: &'a Plan<'a>,
    function: &'a Function<'a>,
    printer: Printer<'a>,
    /// Sign changes that cost an operation of their own.
    pub negations: u32,
}

impl<'a> Body<'a> {
    pub fn new(function: &'a Function<'a>) -> Self {
        let plan = function.plan;
        let printer = Printer { plan, style: function.style };
        let negations = plan.program.roots().iter().map(|e| printer.negations(*e)).sum();
        Body { plan, function, printer, negations }
    }

    pub fn text(&self, out: &mut Lines) {
        let schedule = &self.plan.schedule;
        let solves = |item: usize| matches!(self.plan.targets[item], Target::Solve(_));
        let blocks = schedule.blocks(0..schedule.steps.len(), BLOCK, solves);
        let small = schedule.lets() <= BLOCK;
        let parts = if small { Vec::new() } else { self.parts(&blocks) };
        self.function.kernel_docs(out);
        self.kernel(out, (&blocks, &parts), false);
        if self.function.large() {
            out.blank();
            out.doc("The same, written into `out`, every entry of it: so many numbers take fewer instructions and less stack");
            out.doc("this way than as a value that is put there.");
            self.kernel(out, (&blocks, &parts), true);
        }
        if parts.len() > 1 {
            let computing = parts.iter().enumerate().filter(|(_, p)| !self.is_solve(&p.blocks[0]));
            computing.for_each(|(k, part)| self.part(out, k, part));
        }
    }

    /// The function of the posture, which returns its result or writes it. Each has the whole text: a value that the
    /// other one had filled would be zeroed before and copied behind.
    fn kernel(&self, out: &mut Lines, (blocks, parts): (&[Block], &[Part]), written: bool) {
        let function = self.function;
        let everything = 0..self.plan.schedule.steps.len();
        let small = self.plan.schedule.lets() <= BLOCK;
        if function.fallible() && self.plan.program.solves.is_empty() {
            out.code("#[allow(clippy::unnecessary_wraps)]");
        }
        if small {
            out.code(INLINE);
        }
        let mut parameters = function.parameters();
        if written {
            parameters.push(format!("out: &mut {}", function.ty()));
        }
        let parameters = parameters.join(", ");
        out.code(&match written {
            true => format!("pub fn write<S: Scalar>({parameters}) {{"),
            false => {
                format!("pub fn given<S: Scalar>({parameters}) -> {} {{", function.returned(true))
            }
        });
        out.indent();
        if parts.len() <= 1 {
            open_inputs(out, self.function, everything.clone());
        } else {
            open_solve_inputs(out, self.function);
        }
        if written {
            self.zeros(out);
        } else {
            out.code("let zero = S::lit(0.0);");
            let stored = self.plan.program.roots().iter().any(|e| !e.is_zero());
            let mutable = if stored { "mut " } else { "" };
            out.code(&format!("let {mutable}out = {};", function.zero()));
        }
        if small {
            self.steps(out, everything);
        } else if parts.len() <= 1 {
            blocks.iter().for_each(|block| self.block(out, block));
        } else {
            self.calls(out, parts, if written { "out" } else { "&mut out" });
        }
        if !written {
            out.code(if function.fallible() { "Ok(out)" } else { "out" });
        }
        out.dedent();
        out.code("}");
    }

    /// Entries that are structurally zero, one by one: the others are then stored once, too.
    fn zeros(&self, out: &mut Lines) {
        let blocks = self.plan.program.blocks.iter().enumerate();
        let places = blocks.flat_map(|(at, block)| {
            let zeros = block.entries.iter().enumerate().filter(|(_, e)| e.is_zero());
            zeros.map(move |(entry, _)| self.function.place(at, entry))
        });
        let places: Vec<String> = places.collect();
        if !places.is_empty() {
            out.code("let zero = S::lit(0.0);");
        }
        places.iter().for_each(|place| out.code(&format!("{place} = zero;")));
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

    fn steps(&self, out: &mut Lines, steps: core::ops::Range<usize>) {
        for step in &self.plan.schedule.steps[steps] {
            match step {
                Binding::Let(node) => {
                    let name = self.plan.name(*node).unwrap_or_default();
                    out.code(&format!("let {name} = {};", self.printer.definition(*node)));
                }
                Binding::Item(item) => match self.plan.targets[*item] {
                    Target::Solve(k) => self.solve(out, k),
                    Target::Angles(k) => self.angles(out, k),
                    Target::Entry { block, entry } => {
                        let e = self.plan.program.blocks[block].entries[entry];
                        let place = self.function.place(block, entry);
                        out.code(&format!("{place} = {};", self.printer.print(e)));
                    }
                },
            }
        }
    }

    fn solve(&self, out: &mut Lines, k: usize) {
        let solve = &self.plan.program.solves[k];
        let (n, leading) = (solve.right.len(), solve.leading());
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
        let margin = match self.plan.margin(k) {
            Some(most) => {
                let [force, moment] = most.map(|most| self.printer.style.number(most));
                format!("margin(wrench, [{force}, {moment}])")
            }
            None => "zero".to_string(),
        };
        let (names, solve) = (self.names(&unknowns), self.function.solve());
        let call = format!("{solve}::<S, {n}, {leading}>(stiffness, load, {margin})?");
        out.code(&format!("let [{names}] = {call};"));
    }

    /// Sines and cosines of angles that are not the posture's.
    fn angles(&self, out: &mut Lines, k: usize) {
        let angles = &self.plan.own_angles[k];
        let all = |text: &dyn Fn(&Angle) -> String| {
            angles.iter().map(text).collect::<Vec<_>>().join(", ")
        };
        let name = |letter: &str, used: bool, angle: &Angle| match used {
            true => format!("{letter}{}", angle.suffix),
            false => "_".to_string(),
        };
        let sines = all(&|angle| name("s", angle.sine, angle));
        let cosines = all(&|angle| name("c", angle.cosine, angle));
        let sums = all(&|angle| self.printer.print(angle.sum));
        out.code(&format!("let ([{sines}], [{cosines}]) = S::sin_cos_all([{sums}]);"));
    }

    fn names(&self, nodes: &[usize]) -> String {
        let names: Vec<&str> = nodes.iter().filter_map(|node| self.plan.name(*node)).collect();
        names.join(", ")
    }

    /// A scope of its own that hands on what is still needed.
    fn block(&self, out: &mut Lines, block: &Block) {
        if self.is_solve(block) {
            return self.steps(out, block.steps.clone());
        }
        let live = self.names(&block.live_out);
        let open = if live.is_empty() { "{".to_string() } else { format!("let [{live}] = {{") };
        out.code(&open);
        out.indent();
        self.steps(out, block.steps.clone());
        if !live.is_empty() {
            out.code(&format!("[{live}]"));
        }
        out.dedent();
        out.code(if live.is_empty() { "}" } else { "};" });
    }

    fn calls(&self, out: &mut Lines, parts: &[Part], place: &str) {
        for (k, part) in parts.iter().enumerate() {
            if self.is_solve(&part.blocks[0]) {
                self.steps(out, part.blocks[0].steps.clone());
                continue;
            }
            let (live_in, live_out) =
                (self.names(&part.whole.live_in), self.names(&part.whole.live_out));
            let binding =
                if live_out.is_empty() { String::new() } else { format!("let [{live_out}] = ") };
            let given = self.function.arguments("posture");
            out.code(&format!("{binding}part_{}({given}, [{live_in}], {place});", k + 1));
        }
    }

    fn part(&self, out: &mut Lines, k: usize, part: &Part) {
        let (ins, outs) = (part.whole.live_in.len(), part.whole.live_out.len());
        let mut parameters = self.function.parameters();
        parameters.push(format!("live: [S; {ins}]"));
        parameters.push(format!("out: &mut {}", self.function.ty()));
        let returned = if outs == 0 { String::new() } else { format!(" -> [S; {outs}]") };
        out.blank();
        // Which of the inputs a part reads depends on where the text was cut.
        out.code("#[allow(unused_variables)]");
        let head = format!("fn part_{}<S: Scalar>({}){returned} {{", k + 1, parameters.join(", "));
        out.code(&head);
        out.indent();
        open_inputs(out, self.function, part.whole.steps.clone());
        out.code(&format!("let [{}] = live;", self.names(&part.whole.live_in)));
        part.blocks.iter().for_each(|block| self.block(out, block));
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
