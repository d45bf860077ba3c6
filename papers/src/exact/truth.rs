//! What a printed equation should be, and the values of that.

use std::cell::RefCell;
use std::collections::{BTreeSet, HashMap};

use stiffarm_codegen::expr::{Expr, Graph, Node, Symbol};

use super::arithmetic::{Arithmetic, Real};
use super::field::Modular;
use super::forms::Forms;
use super::reading::Reading;
use crate::latex::tree::Tree;
#[cfg(test)]
use crate::latex::{notation::Notation, parser::parse};

/// What a printed equation should be: the entries of a matrix.
#[derive(Clone, Debug)]
pub struct Truth {
    pub(super) graph: Graph,
    /// Number of columns.
    pub columns: usize,
    /// The entries, row by row.
    pub entries: Vec<Expr>,
    /// What names of the equation stand for.
    pub names: HashMap<String, Expr>,
}

impl Truth {
    /// One of its expressions.
    pub fn form(&self, of: Expr) -> Form<'_> {
        Form { graph: &self.graph, of }
    }

    /// What is printed, its names standing for what they stand for here; none where it is no formula
    /// of numbers.
    pub fn read(&self, tree: &Tree) -> Option<Truth> {
        let (graph, names) = (RefCell::new(self.graph.clone()), self.names.clone());
        let forms = Forms { graph, names, infinite: Vec::new() };
        let entries = vec![forms.tree(tree).ok()?];
        Some(Truth { graph: forms.graph.into_inner(), columns: 1, entries, names: forms.names })
    }

    /// A formula as it is written.
    #[cfg(test)]
    pub fn written(text: &str, notation: &Notation) -> Truth {
        let forms = Forms::new(&[], &[]).unwrap();
        let entry = forms.tree(&parse(text, notation).unwrap()).unwrap();
        forms.truth(1, vec![entry]).unwrap()
    }
}

/// What cancels leaves rounding: no more than this part of the value, of formulas of a thousand terms.
const ROUNDING: f64 = 1e-9;

/// A formula of a graph whose symbols are all names.
#[derive(Clone, Copy, Debug)]
pub struct Form<'g> {
    pub(super) graph: &'g Graph,
    pub(super) of: Expr,
}

impl Form<'_> {
    /// Its value.
    ///
    /// # Errors
    /// Why it has none.
    pub fn value<A: Arithmetic>(self, to: &A) -> Result<A::Value, A::Error> {
        let reading = Reading { joints: Vec::new(), wrench: Vec::new() };
        let value = reading.values(to, self.graph, &[self.of])?.pop();
        value.ok_or_else(|| "no expression".into())
    }

    /// Its value in doubles, with values given by a function; what cancels needs none.
    ///
    /// # Errors
    /// A symbol on which it depends has no value.
    pub fn real(self, value: impl Fn(&str) -> Option<f64>) -> Result<f64, &'static str> {
        let with = |other: f64| self.value(&Real(|name: &str| value(name).or(Some(other))));
        let (one, other) = (with(0.7)?, with(1.3)?);
        let same = (one - other).abs() <= ROUNDING * one.abs().max(other.abs());
        same.then_some(one).ok_or("a symbol of the formula has no value")
    }

    fn nodes(self) -> impl Iterator<Item = Node> {
        let used = self.graph.reachable(&[self.of]);
        self.graph.nodes().iter().zip(used).filter(|(_, used)| *used).map(|(node, _)| *node)
    }

    /// Whether a square root stands in it.
    pub fn has_root(self) -> bool {
        self.nodes().any(|node| matches!(node, Node::Sqrt(_)))
    }

    /// Whether it is zero.
    pub fn is_zero(self) -> bool {
        self.value(&Modular::point(1)) == Ok(0)
    }

    /// Adds the angles and the plain symbols that its value depends on.
    pub fn names(self, angles: &mut BTreeSet<String>, symbols: &mut BTreeSet<String>) {
        let mut turned = BTreeSet::new();
        for node in self.nodes() {
            if let Node::Sin(a) | Node::Cos(a) = node {
                turned.extend(self.reached(a));
            }
        }
        for name in self.reached(self.of) {
            let (here, mut there) = (Modular::point(1), Modular::point(1));
            there.moved = Some(name.clone());
            if self.value(&here) != self.value(&there) {
                if turned.contains(&name) { &mut *angles } else { &mut *symbols }.insert(name);
            }
        }
    }

    fn reached(self, of: Expr) -> Vec<String> {
        let name = |node| match node {
            Node::Symbol(s) => match self.graph.symbol_of(s) {
                Symbol::Parameter(name) => Some(name.clone()),
                _ => None,
            },
            _ => None,
        };
        Form { of, ..self }.nodes().filter_map(name).collect()
    }
}
