//! The kernel itself, cut into scopes and functions that the compiler can digest.

use super::function::Function;
use super::inputs::open_inputs;
use super::posture::INLINE;
use super::statements::{BLOCK, Statements, list};
use crate::emit::lines::Lines;
use crate::ir::{Block, blocks, lets, lively};

/// Blocks in one function.
const BLOCKS: usize = 7;

/// A run of blocks, and the names that cross its borders.
struct Part {
    blocks: Vec<Block>,
    whole: Block,
}

impl Function<'_> {
    pub fn kernels(&self, out: &mut Lines) {
        let body = &self.of.body;
        let blocks = lively(body, blocks(body, BLOCK));
        let parts = if lets(body) <= BLOCK { Vec::new() } else { self.parts(&blocks) };
        self.kernel_docs(out);
        match self.fused() {
            true => self.filled(out, parts.is_empty()),
            false => self.kernel(out, (&blocks, &parts), false),
        }
        if self.fused() || self.large() {
            out.blank();
            out.doc("The same, written into `out`, every entry of it: so many numbers take fewer instructions and less stack this way than as a value that is put there.");
            if self.of.fallible() {
                out.doc("");
                out.doc("# Errors");
                out.doc(&format!("{} `out` then holds some of what is new.", self.refusal()));
            }
            self.kernel(out, (&blocks, &parts), true);
        }
        if parts.len() > 1 {
            let computing = parts.iter().enumerate().filter(|(_, part)| !self.solves(part));
            computing.for_each(|(k, part)| self.part(out, k, part));
        }
    }

    /// Hands the function's statements to `with`.
    fn statements<T>(&self, with: impl FnOnce(&Statements) -> T) -> T {
        let place = |block, entry| self.place(block, entry);
        with(&Statements { body: &self.of.body, style: self.style, place: &place })
    }

    /// The function of the posture that returns several things: written in the place where they are returned, so that none
    /// waits in a register, or beside the stack's top, for the solution of a linear system.
    fn filled(&self, out: &mut Lines, small: bool) {
        if small {
            out.code(INLINE);
        }
        // It hands on what `write` may not read.
        let parameters = self.parameters();
        let named: Vec<&str> = parameters.iter().map(|p| p.trim_start_matches('_')).collect();
        out.within(
            &format!("pub fn given<S: Scalar>({}) -> {} {{", named.join(", "), self.returned(true)),
            "}",
            |out| {
                let write = format!("write({}, ", self.arguments("posture"));
                let structure = self.structure();
                if self.of.fallible() {
                    out.code(&format!("let mut result = Ok({structure}::zero());"));
                    out.within("if let Ok(out) = &mut result {", "}", |out| {
                        out.code(&format!("{write}out)?;"));
                    });
                    out.code("result");
                } else {
                    out.code(&format!("let mut out = {structure}::zero();"));
                    out.code(&format!("{write}&mut out);"));
                    out.code("out");
                }
            },
        );
    }

    /// The function of the posture, which returns its result or writes it. Each has the whole text: a value that the
    /// other one had filled would be zeroed before and copied behind.
    fn kernel(&self, out: &mut Lines, (blocks, parts): (&[Block], &[Part]), written: bool) {
        let body = &self.of.body;
        let fallible = self.of.fallible();
        if fallible && self.of.program.solves.is_empty() {
            out.code("#[allow(clippy::unnecessary_wraps)]");
        }
        let small = lets(body) <= BLOCK;
        if small {
            out.code(INLINE);
        }
        let mut parameters = self.parameters();
        if written {
            parameters.push(format!("out: &mut {}", self.ty()));
        }
        let parameters = parameters.join(", ");
        out.within(
            &match written {
                true if fallible => {
                    format!("pub fn write<S: Scalar>({parameters}) -> Result<(), Unstable> {{")
                }
                true => format!("pub fn write<S: Scalar>({parameters}) {{"),
                false => {
                    format!("pub fn given<S: Scalar>({parameters}) -> {} {{", self.returned(true))
                }
            },
            "}",
            |out| {
                // Of a function in parts each part opens its own; a linear system stands between them.
                open_inputs(
                    out,
                    self,
                    body.iter().filter(|step| parts.len() <= 1 || step.is_solve()),
                );
                if written {
                    self.zeros(out);
                } else {
                    out.code("let zero = S::lit(0.0);");
                    let stored = self.of.program.roots().iter().any(|e| !e.is_zero());
                    let mutable = if stored { "mut " } else { "" };
                    out.code(&format!("let {mutable}out = {};", self.zero()));
                }
                self.statements(|statements| {
                    if small {
                        statements.steps(out, 0..body.len());
                    } else if parts.len() <= 1 {
                        blocks.iter().for_each(|block| statements.block(out, block));
                    } else {
                        self.calls(out, parts, if written { "out" } else { "&mut out" });
                    }
                });
                match (written, fallible) {
                    (true, true) => out.code("Ok(())"),
                    (true, false) => {}
                    (false, true) => out.code("Ok(out)"),
                    (false, false) => out.code("out"),
                }
            },
        );
    }

    /// Entries that are structurally zero, one by one: the others are then stored once, too.
    fn zeros(&self, out: &mut Lines) {
        let mut places = self.of.zeros().map(|(block, entry)| self.place(block, entry)).peekable();
        if places.peek().is_some() {
            out.code("let zero = S::lit(0.0);");
        }
        places.for_each(|place| out.code(&format!("{place} = zero;")));
    }

    /// Runs of blocks, each a function of its own; a solve is a run by itself.
    fn parts(&self, blocks: &[Block]) -> Vec<Part> {
        let solve = |block: &Block| self.of.body[block.steps.start].is_solve();
        let mut runs: Vec<Vec<Block>> = Vec::new();
        for block in blocks {
            match runs.last_mut() {
                Some(run) if run.len() < BLOCKS && !solve(&run[0]) && !solve(block) => {
                    run.push(block.clone());
                }
                _ => runs.push(vec![block.clone()]),
            }
        }
        let ranges = runs.iter().map(|run| run[0].steps.start..run[run.len() - 1].steps.end);
        let wholes = lively(&self.of.body, ranges);
        runs.into_iter().zip(wholes).map(|(blocks, whole)| Part { blocks, whole }).collect()
    }

    fn solves(&self, part: &Part) -> bool {
        self.of.body[part.whole.steps.start].is_solve()
    }

    fn calls(&self, out: &mut Lines, parts: &[Part], place: &str) {
        for (k, part) in parts.iter().enumerate() {
            if self.solves(part) {
                self.statements(|statements| statements.steps(out, part.whole.steps.clone()));
                continue;
            }
            let (live_in, live_out) = (list(&part.whole.live_in), list(&part.whole.live_out));
            let binding =
                if live_out.is_empty() { String::new() } else { format!("let [{live_out}] = ") };
            let given = self.arguments("posture");
            out.code(&format!("{binding}part_{}({given}, [{live_in}], {place});", k + 1));
        }
    }

    fn part(&self, out: &mut Lines, k: usize, Part { blocks, whole }: &Part) {
        let (ins, outs) = (whole.live_in.len(), whole.live_out.len());
        let mut parameters = self.parameters();
        parameters.push(format!("live: [S; {ins}]"));
        parameters.push(format!("out: &mut {}", self.ty()));
        let returned = if outs == 0 { String::new() } else { format!(" -> [S; {outs}]") };
        out.blank();
        // Which of the inputs a part reads depends on where the text was cut.
        out.code("#[allow(unused_variables)]");
        let head = format!("fn part_{}<S: Scalar>({}){returned} {{", k + 1, parameters.join(", "));
        out.within(&head, "}", |out| {
            open_inputs(out, self, &self.of.body[whole.steps.clone()]);
            out.code(&format!("let [{}] = live;", list(&whole.live_in)));
            self.statements(|statements| {
                blocks.iter().for_each(|block| statements.block(out, block))
            });
            if outs > 0 {
                out.code(&format!("[{}]", list(&whole.live_out)));
            }
        });
    }
}
