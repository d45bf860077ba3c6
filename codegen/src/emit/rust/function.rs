//! One function of a generated module: what it returns and where its entries go.

use stiffarm_kernels::{Input, Output};

use super::super::plan::Plan;
use super::super::posture::{Needs, Posture};
use super::super::readings::Stage;
use super::shapes;
use super::style::Rust;
use crate::derive::Program;

/// A function to be printed: of one output, or of those of `all`.
pub(super) struct Function<'p> {
    pub plan: &'p Plan<'p>,
    pub outputs: &'p [Output],
    pub needs: &'p Needs,
    /// The posture of the whole module.
    pub posture: &'p Posture,
    /// Whether it takes the constants of a table with symbolic parameters.
    pub symbolic: bool,
    /// What stands between readings and joint values.
    pub stage: &'p Stage,
    /// How its text is spelt.
    pub style: &'p Rust,
}

impl<'p> Function<'p> {
    /// The output's name, or `all`.
    pub fn name(&self) -> &'static str {
        match self.outputs {
            [output] => output.name(),
            _ => "all",
        }
    }

    pub fn program(&self) -> &'p Program {
        self.plan.program
    }

    /// The kernel's parameters; those that it does not read begin with `_`.
    pub fn parameters(&self) -> Vec<String> {
        let unread = |read: bool| if read { "" } else { "_" };
        let constants = unread(!self.plan.constants.is_empty());
        let constants = format!("{constants}constants: &super::Constants<S>");
        let posture = format!("{}posture: &Posture<S>", unread(!self.needs.reads.is_empty()));
        let wrench = format!("{}wrench: &[S; 6]", unread(self.plan.wrench().contains(&true)));
        let first = self.symbolic.then_some(constants).into_iter().chain([posture]);
        first.chain(self.wrench().then_some(wrench)).collect()
    }

    /// What the kernel is called with, where the inputs are called so.
    pub fn arguments(&self, posture: &str) -> String {
        let first = self.symbolic.then_some("constants").into_iter().chain([posture]);
        first.chain(self.wrench().then_some("wrench")).collect::<Vec<_>>().join(", ")
    }

    /// Whether it is `all`.
    pub fn fused(&self) -> bool {
        self.outputs.len() > 1
    }

    pub fn wrench(&self) -> bool {
        self.outputs.iter().any(|o| o.takes(Input::Wrench))
    }

    pub fn fallible(&self) -> bool {
        self.outputs.iter().any(|o| o.is_fallible())
    }

    /// The function of the runtime that solves a system.
    pub fn solve(&self) -> &'static str {
        if self.style.fused { "solve_fused" } else { "solve" }
    }

    pub fn ty(&self) -> String {
        match self.fused() {
            true => "All<S>".to_string(),
            false => shapes::ty(self.outputs[0], self.program().dof),
        }
    }

    pub fn returned(&self, inside: bool) -> String {
        let ty = if self.fused() && !inside { "all::All<S>".to_string() } else { self.ty() };
        if self.fallible() { format!("Result<{ty}, Unstable>") } else { ty }
    }

    pub fn zero(&self) -> String {
        let n = self.program().dof;
        if !self.fused() {
            return shapes::zero(self.outputs[0], n);
        }
        let field = |o: &Output| format!("{}: {}", o.name(), shapes::zero(*o, n));
        format!("All {{ {} }}", self.outputs.iter().map(field).collect::<Vec<_>>().join(", "))
    }

    pub fn place(&self, block: usize, entry: usize) -> String {
        let output = self.program().blocks[block].output;
        let place = shapes::place(output, self.program().dof, entry);
        if self.fused() { format!("out.{}{place}", output.name()) } else { format!("out{place}") }
    }
}
