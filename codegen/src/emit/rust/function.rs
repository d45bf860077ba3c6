//! One function of a generated module: what it returns and where its entries go.

use stiffarm_kernels::Output;

use super::super::plan::{Argument, Plan};
use super::super::posture::{Needs, Posture};
use super::super::readings::Stage;
use super::shapes;
use super::style::Rust;
use crate::derive::{Block, Held, Own, Program};

/// A result of more numbers can also be written where it is to stand. A value that is put there is held together first:
/// the 360 numbers of a regressor of six joints then take three times the stack on a Cortex-M4F, and four times on an M7;
/// the 216 of a Hessian take no more, nor more instructions.
const LARGE: usize = 256;

/// A function to be printed: of one output, of those of `all`, or of one's own.
pub(super) struct Function<'p> {
    pub plan: &'p Plan<'p>,
    pub needs: &'p Needs,
    /// The posture of the whole module.
    pub posture: &'p Posture,
    /// Whether it takes the constants of a table with symbolic parameters.
    pub symbolic: bool,
    /// What stands between readings and joint values.
    pub stage: &'p Stage,
    /// How its text is spelt.
    pub style: &'p Rust,
    /// How many modules the text stands in, below the arm's.
    pub depth: usize,
}

/// An input beside the posture as a parameter: so many numbers, or one by itself.
pub(super) fn parameter(name: &str, size: Option<usize>) -> String {
    match size {
        Some(size) => format!("{name}: &[S; {size}]"),
        None => format!("{name}: S"),
    }
}

impl<'p> Function<'p> {
    /// The output's name, or `all`, or its own.
    pub fn name(&self) -> &'p str {
        match (self.own(), self.blocks()) {
            (Some(own), _) => &own.name,
            (None, [block]) => block.held.name(),
            _ => "all",
        }
    }

    pub fn program(&self) -> &'p Program {
        self.plan.program
    }

    pub fn blocks(&self) -> &'p [Block] {
        &self.program().blocks
    }

    /// What it says of itself, where it is one's own.
    pub fn own(&self) -> Option<&'p Own> {
        self.program().own.as_ref()
    }

    /// The arm's outputs that it computes.
    pub fn outputs(&self) -> impl Iterator<Item = Output> {
        self.blocks().iter().filter_map(|block| block.held.output())
    }

    /// The kernel's parameters; those that it does not read begin with `_`.
    pub fn parameters(&self) -> Vec<String> {
        let unread = |read: bool| if read { "" } else { "_" };
        let constants = unread(!self.plan.constants.is_empty());
        let constants = format!("{constants}constants: &super::Constants<S>");
        let posture = format!("{}posture: &Posture<S>", unread(!self.needs.reads.is_empty()));
        let beside = self.plan.arguments();
        let beside = beside.iter().map(|argument| {
            let Argument { name, size, .. } = argument;
            format!("{}{}", unread(self.plan.reads(argument)), parameter(name, *size))
        });
        let first = self.symbolic.then_some(constants).into_iter().chain([posture]);
        first.chain(beside).collect()
    }

    /// What the kernel is called with, where the inputs are called so.
    pub fn arguments(&self, posture: &str) -> String {
        let first = self.symbolic.then_some("constants").into_iter().chain([posture]);
        let beside = self.plan.arguments().into_iter().map(|argument| argument.name);
        first.map(str::to_string).chain(beside).collect::<Vec<String>>().join(", ")
    }

    /// Whether it computes several things.
    pub fn fused(&self) -> bool {
        self.blocks().len() > 1
    }

    pub fn fallible(&self) -> bool {
        self.outputs().any(|o| o.is_fallible())
    }

    /// Whether it has a second kernel, which writes its result: that is no struct, and never refused.
    pub fn large(&self) -> bool {
        let [Block { entries, .. }] = self.blocks() else { return false };
        !self.fallible() && entries.len() > LARGE && entries.iter().any(|e| !e.is_zero())
    }

    /// The function of the runtime that solves a system.
    pub fn solve(&self) -> &'static str {
        if self.style.fused { "solve_fused" } else { "solve" }
    }

    /// The struct of several things: `All`, or called like the function.
    pub fn structure(&self) -> String {
        let word = |word: &str| {
            let mut letters = word.chars();
            letters.next().map(|first| first.to_uppercase().chain(letters).collect::<String>())
        };
        self.name().split('_').filter_map(word).collect()
    }

    pub fn ty(&self) -> String {
        match self.blocks() {
            [block] => shapes::ty(&block.held, self.program().dof),
            _ => format!("{}<S>", self.structure()),
        }
    }

    pub fn returned(&self, inside: bool) -> String {
        let ty = match self.fused() && !inside {
            true => format!("{}::{}", self.name(), self.ty()),
            false => self.ty(),
        };
        if self.fallible() { format!("Result<{ty}, Unstable>") } else { ty }
    }

    pub fn zero(&self) -> String {
        let n = self.program().dof;
        if let [block] = self.blocks() {
            return shapes::zero(&block.held, n);
        }
        let field =
            |Block { held, .. }: &Block| format!("{}: {}", held.name(), shapes::zero(held, n));
        let fields: Vec<String> = self.blocks().iter().map(field).collect();
        format!("{} {{ {} }}", self.structure(), fields.join(", "))
    }

    pub fn place(&self, block: usize, entry: usize) -> String {
        let held: &Held = &self.blocks()[block].held;
        let place = shapes::place(held, self.program().dof, entry);
        if self.fused() { format!("out.{}{place}", held.name()) } else { format!("out{place}") }
    }
}
