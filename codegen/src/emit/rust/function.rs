//! One function of a generated module: what it returns and where its entries go.

use stiffarm_kernels::{Input, Output};

use super::shapes;
use super::style::Rust;
use crate::derive::Program;

/// A function to be printed.
pub(super) struct Function<'p> {
    pub program: &'p Program,
    pub name: &'static str,
    pub outputs: Vec<Output>,
    /// Whether it takes the constants of a table with symbolic parameters.
    pub symbolic: bool,
    style: Rust,
}

impl<'p> Function<'p> {
    /// The function of `outputs`: one, or those of `all`; `fused` fuses products into sums.
    pub fn new(program: &'p Program, outputs: &[Output], symbolic: bool, fused: bool) -> Self {
        let name = match outputs {
            [output] => output.name(),
            _ => "all",
        };
        let style = Rust { fused, constants: "constants" };
        Function { program, name, outputs: outputs.to_vec(), symbolic, style }
    }

    /// How its text is spelt.
    pub fn style(&self) -> &Rust {
        &self.style
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
            false => shapes::ty(self.outputs[0], self.program.dof),
        }
    }

    pub fn returned(&self, inside: bool) -> String {
        let ty = if self.fused() && !inside { "all::All<S>".to_string() } else { self.ty() };
        if self.fallible() { format!("Result<{ty}, Unstable>") } else { ty }
    }

    pub fn zero(&self) -> String {
        let n = self.program.dof;
        if !self.fused() {
            return shapes::zero(self.outputs[0], n);
        }
        let field = |o: &Output| format!("{}: {}", o.name(), shapes::zero(*o, n));
        format!("All {{ {} }}", self.outputs.iter().map(field).collect::<Vec<_>>().join(", "))
    }

    pub fn place(&self, block: usize, entry: usize) -> String {
        let output = self.program.blocks[block].output;
        let place = shapes::place(output, self.program.dof, entry);
        if self.fused() { format!("out.{}{place}", output.name()) } else { format!("out{place}") }
    }
}
