//! Statements in Rust, and the scopes that hold them.

use super::style::Rust;
use crate::emit::lines::Lines;
use crate::ir::{Angle, Block, Name, Solve, Statement, Term};
use crate::number::Number;

/// Names in one scope; rustc's recursion over a scope's statements overflows at a few thousand.
pub(super) const BLOCK: usize = 256;

/// Prints the statements of one function.
pub(super) struct Statements<'a> {
    pub body: &'a [Statement],
    pub style: &'a Rust,
    /// Where an entry of a block is stored.
    pub place: &'a dyn Fn(usize, usize) -> String,
}

/// The pattern of the sines and cosines of `angles`, and the call that takes them of `sums`.
pub(super) fn sin_cos(angles: &[Angle], sums: &[String]) -> [String; 2] {
    let names = |k: usize| {
        let each = angles.iter().map(|angle| angle.names()[k].clone());
        each.map(|name| name.map_or("_".to_string(), |n| n.to_string()))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let pattern = format!("let ([{}], [{}]) =", names(0), names(1));
    [pattern, format!("S::sin_cos_all([{}]);", sums.join(", "))]
}

impl Statements<'_> {
    pub fn print(&self, term: &Term) -> String {
        term.print(self.style)
    }

    pub fn all(&self, terms: &[Term]) -> String {
        terms.iter().map(|term| self.print(term)).collect::<Vec<_>>().join(", ")
    }

    pub fn steps(&self, out: &mut Lines, steps: core::ops::Range<usize>) {
        for step in &self.body[steps] {
            match step {
                Statement::Let(name, value) => {
                    out.code(&format!("let {name} = {};", self.print(value)));
                }
                Statement::Store { block, entry, value } => {
                    let place = (self.place)(*block, *entry);
                    out.code(&format!("{place} = {};", self.print(value)));
                }
                Statement::SinCos(angles) => {
                    let sums: Vec<String> = angles.iter().map(|a| self.print(&a.sum)).collect();
                    out.code(&sin_cos(angles, &sums).join(" "));
                }
                Statement::Solve(solve) => self.solve(out, solve),
            }
        }
    }

    fn solve(&self, out: &mut Lines, solve: &Solve) {
        let (n, leading) = (solve.right.len(), solve.leading);
        out.within("let stiffness = [", "];", |out| {
            for column in solve.matrix.chunks(n) {
                out.code(&format!("[{}],", self.all(column)));
            }
        });
        out.code(&format!("let load = [{}];", self.all(&solve.right)));
        let margin = match solve.margin {
            Some(most) => {
                let [force, moment] = most.map(|most| self.print(&Term::Number(most)));
                format!("margin(wrench, [{force}, {moment}])")
            }
            // The pivots of a symmetric matrix are themselves the test.
            None => self.print(&Term::Number(Number::integer(i128::from(solve.of_motion)))),
        };
        let names = solve.unknowns.iter().map(|name| name.as_deref().unwrap_or("_"));
        let names = names.collect::<Vec<_>>().join(", ");
        let call =
            format!("{}::<S, {n}, {leading}>(stiffness, load, {margin})?", self.style.solve());
        out.code(&format!("let [{names}] = {call};"));
    }

    /// A scope of its own that hands on what is still needed.
    pub fn block(&self, out: &mut Lines, block: &Block) {
        if self.body[block.steps.start].is_solve() {
            return self.steps(out, block.steps.clone());
        }
        let live = list(&block.live_out);
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
}

/// Names with commas between them.
pub(super) fn list(names: &[Name]) -> String {
    names.join(", ")
}
