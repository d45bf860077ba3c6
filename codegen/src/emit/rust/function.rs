//! One function of a generated module: what it returns and where its entries go.

use super::shapes;
use super::style::Rust;
use crate::derive::Block;
use crate::ir::{self, Module};

/// A result of more numbers can also be written where it is to stand, as several things always can. A value that is put
/// there is held together first: the 360 numbers of a regressor of six joints then take three times the stack on a Cortex-M4F, and four times on an M7;
/// the 216 of a Hessian take no more, nor more instructions.
const LARGE: usize = 256;

/// A function to be printed.
pub(super) struct Function<'m> {
    pub of: &'m ir::Function,
    pub module: &'m Module<'m>,
    /// How its text is spelt.
    pub style: &'m Rust,
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

impl Function<'_> {
    /// The kernel's parameters; those that it does not read begin with `_`.
    pub fn parameters(&self) -> Vec<String> {
        let unread = |read: bool| if read { "" } else { "_" };
        let constants = format!("{}constants: &super::Constants<S>", unread(self.of.constants));
        let posture = format!("{}posture: &Posture<S>", unread(!self.of.reads.is_empty()));
        let beside = self.of.arguments.iter().map(|argument| {
            format!("{}{}", unread(argument.is_read()), parameter(&argument.name, argument.size))
        });
        let first = self.module.is_symbolic().then_some(constants).into_iter().chain([posture]);
        first.chain(beside).collect()
    }

    /// What the kernel is called with, where the inputs are called so.
    pub fn arguments(&self, posture: &str) -> String {
        let first = self.module.is_symbolic().then_some("constants").into_iter().chain([posture]);
        let beside = self.of.arguments.iter().map(|argument| argument.name.as_str());
        first.chain(beside).collect::<Vec<&str>>().join(", ")
    }

    /// Whether it computes several things.
    pub fn fused(&self) -> bool {
        self.of.blocks().len() > 1
    }

    /// Whether it has a second kernel with the whole text, which writes its result: that is no struct, and never refused.
    pub fn large(&self) -> bool {
        let [Block { entries, .. }] = self.of.blocks() else { return false };
        !self.of.fallible() && entries.len() > LARGE && entries.iter().any(|e| !e.is_zero())
    }

    /// The struct of several things: `All`, or called like the function.
    pub fn structure(&self) -> String {
        let word = |word: &str| {
            let mut letters = word.chars();
            letters.next().map(|first| first.to_uppercase().chain(letters).collect::<String>())
        };
        self.of.name().split('_').filter_map(word).collect()
    }

    pub fn ty(&self) -> String {
        match self.of.blocks() {
            [block] => shapes::ty(&block.held, self.of.program.dof),
            _ => format!("{}<S>", self.structure()),
        }
    }

    pub fn returned(&self, inside: bool) -> String {
        let ty = match self.fused() && !inside {
            true => format!("{}::{}", self.of.name(), self.ty()),
            false => self.ty(),
        };
        if self.of.fallible() { format!("Result<{ty}, Unstable>") } else { ty }
    }

    pub fn zero(&self) -> String {
        let n = self.of.program.dof;
        if let [block] = self.of.blocks() {
            return shapes::zero(&block.held, n);
        }
        let field =
            |Block { held, .. }: &Block| format!("{}: {}", held.name(), shapes::zero(held, n));
        let fields: Vec<String> = self.of.blocks().iter().map(field).collect();
        format!("{} {{ {} }}", self.structure(), fields.join(", "))
    }

    pub fn place(&self, block: usize, entry: usize) -> String {
        let held = &self.of.blocks()[block].held;
        let place = shapes::place(held, self.of.program.dof, entry);
        if self.fused() { format!("out.{}{place}", held.name()) } else { format!("out{place}") }
    }
}
