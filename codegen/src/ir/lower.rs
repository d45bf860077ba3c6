//! From expressions of the graph to terms: where signs go, and in which order operands are written.

use std::collections::HashMap;

use super::term::{Operation, Term};
use crate::expr::{Expr, Graph, Node, Symbol};

/// Writes expressions of one graph down.
pub(super) struct Lowering<'a> {
    pub graph: &'a Graph,
    /// What has a name; everything else is written in place.
    pub names: &'a HashMap<usize, Term>,
    /// Whether products are fused into sums.
    pub fused: bool,
}

impl Lowering<'_> {
    /// A signed expression.
    pub fn term(&self, e: Expr) -> Term {
        match self.names.get(&e.node()) {
            Some(name) if e.is_negative() => negative(name.clone()),
            Some(name) => name.clone(),
            None => self.written_out(e.node(), e.is_negative()),
        }
    }

    /// What a named node is, not what it is called.
    pub fn definition(&self, node: usize) -> Term {
        self.written_out(node, false)
    }

    /// Sign changes that writing `e` cannot absorb.
    pub fn negations(&self, e: Expr) -> u32 {
        u32::from(e.is_negative() && !self.absorbs(e.node()))
    }

    /// A sum of angles, term by term, over the arguments themselves.
    pub fn angle(&self, sum: Expr) -> Term {
        let term = |e: Expr| match self.graph.symbol_at(e.node()) {
            Some(Symbol::Joint(joint)) => Term::Entry("q", vec![*joint]),
            Some(Symbol::Displacement { place, component }) => {
                Term::Entry("e", vec![*place, *component])
            }
            _ => self.term(e.abs()),
        };
        Term::sum(self.graph.terms(sum).into_iter().map(|e| (term(e), e.is_negative())))
    }

    fn written_out(&self, node: usize, minus: bool) -> Term {
        let of = |operation, numbers: &[Expr]| {
            let term = Term::Of(operation, numbers.iter().map(|e| self.term(*e)).collect());
            if minus { negative(term) } else { term }
        };
        match self.graph.nodes()[node] {
            Node::Number(n) => Term::Number(if minus { -n } else { n }),
            Node::Add(a, b) => self.sum(a, b, minus),
            Node::Mul(a, b) => self.product(a, b, minus),
            Node::Recip(a) => of(Operation::Reciprocal, &[a]),
            Node::Sqrt(a) => of(Operation::Root, &[a]),
            Node::Sign(a) => of(Operation::Sign, &[a]),
            Node::Sin(a) => of(Operation::Sine, &[a]),
            Node::Cos(a) => of(Operation::Cosine, &[a]),
            Node::Atan2(y, x) => of(Operation::Atan2, &[y, x]),
            Node::Select(on, a, b) => of(Operation::Select, &[on, a, b]),
            // Symbols always have names.
            Node::Symbol(_) => Term::local(format!("node{node}")),
        }
    }

    fn sum(&self, a: Expr, b: Expr, minus: bool) -> Term {
        if let Some(term) = self.fused(a.signed(minus), b.signed(minus)) {
            return term;
        }
        let sum = |a, b| Term::Sum(Box::new([self.term(a), self.term(b)]));
        let difference = |a, b| Term::Difference(Box::new([self.term(a), self.term(b)]));
        match (minus, b.is_negative()) {
            (false, false) if self.is_inline_sum(b) && !self.is_inline_sum(a) => sum(b, a),
            (false, false) => sum(a, b),
            (false, true) => difference(a, -b),
            (true, true) => difference(-b, a),
            (true, false) => negative(sum(a, b)),
        }
    }

    /// `a + b` with the product that is one of them taken into the sum.
    fn fused(&self, a: Expr, b: Expr) -> Option<Term> {
        let (product, other) = match (self.is_inline_product(a), self.is_inline_product(b)) {
            _ if !self.fused => return None,
            (_, true) => (b, a),
            (true, false) => (a, b),
            (false, false) => return None,
        };
        let Node::Mul(x, y) = self.graph.node(product) else { return None };
        let x = x.signed(product.is_negative());
        Some(Term::Fused(Box::new([self.term(x), self.term(y), self.term(other)])))
    }

    fn product(&self, a: Expr, b: Expr, minus: bool) -> Term {
        // A product on the left needs no brackets; a constant reads best in front.
        let (mut a, mut b) = match self.is_inline_product(b) && !self.is_inline_product(a) {
            true => (b, a),
            false => (a, b),
        };
        let mut outer = minus;
        if minus && self.absorbs(a.node()) {
            (a, outer) = (-a, false);
        } else if minus && self.absorbs(b.node()) {
            (b, outer) = (-b, false);
        }
        let term = Term::Product(Box::new([self.term(a), self.term(b)]));
        if outer { negative(term) } else { term }
    }

    /// Whether `-node` can be written without a sign change of its own.
    fn absorbs(&self, node: usize) -> bool {
        let inline = !self.names.contains_key(&node);
        inline
            && match self.graph.nodes()[node] {
                Node::Number(_) => true,
                Node::Add(_, b) => b.is_negative(),
                Node::Mul(a, b) => self.absorbs(a.node()) || self.absorbs(b.node()),
                _ => false,
            }
    }

    fn is_inline_sum(&self, e: Expr) -> bool {
        !self.names.contains_key(&e.node()) && matches!(self.graph.node(e), Node::Add(..))
    }

    fn is_inline_product(&self, e: Expr) -> bool {
        !self.names.contains_key(&e.node()) && matches!(self.graph.node(e), Node::Mul(..))
    }
}

fn negative(term: Term) -> Term {
    Term::Negative(Box::new(term))
}
