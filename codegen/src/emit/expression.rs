//! Writing expressions: where brackets and signs go, whatever the language.

use super::plan::Plan;
use crate::expr::{Expr, Node};
use crate::number::Number;

/// How a language spells the pieces.
pub(super) trait Style {
    /// A constant.
    fn number(&self, n: Number) -> String;
    /// A named node.
    fn name(&self, name: &str) -> String;
    /// A product.
    fn product(&self, a: &str, b: &str) -> String;
    /// A bracketed expression.
    fn bracket(&self, inner: &str) -> String;
    /// `1/a`, `a` bare.
    fn recip(&self, a: &str) -> String;
    /// `√a`, `a` bare.
    fn sqrt(&self, a: &str) -> String;
    /// The sign of `a`, a name.
    fn sign(&self, a: &str) -> String;
    /// `a·b + c`, each bare, where the text asks for one rounding.
    fn fused(&self, _a: &str, _b: &str, _c: &str) -> Option<String> {
        None
    }
}

/// A printed expression: how strongly it binds decides whether it needs brackets.
#[derive(Clone, Debug)]
struct Text {
    text: String,
    binds: Binds,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Binds {
    Sum,
    Negation,
    Product,
    Atom,
}

/// Prints expressions of one plan.
pub(super) struct Printer<'a> {
    pub plan: &'a Plan<'a>,
    pub style: &'a dyn Style,
}

impl Printer<'_> {
    /// A signed expression.
    pub fn print(&self, e: Expr) -> String {
        self.signed(e, false).text
    }

    /// The right-hand side of a named node: what it is, not what it is called.
    pub fn definition(&self, node: usize) -> String {
        self.written_out(node, false).text
    }

    /// Sign changes that printing `e` cannot absorb.
    pub fn negations(&self, e: Expr) -> u32 {
        u32::from(e.is_negative() && !self.absorbs(e.node()))
    }

    fn signed(&self, e: Expr, force_brackets: bool) -> Text {
        let node = e.node();
        let printed = match self.plan.name(node) {
            Some(name) if e.is_negative() => {
                Text { text: format!("-{}", self.style.name(name)), binds: Binds::Negation }
            }
            Some(name) => Text { text: self.style.name(name), binds: Binds::Atom },
            None => self.written_out(node, e.is_negative()),
        };
        if force_brackets && printed.binds != Binds::Atom {
            return Text { text: self.style.bracket(&printed.text), binds: Binds::Atom };
        }
        printed
    }

    fn written_out(&self, node: usize, negative: bool) -> Text {
        match self.plan.program.graph.nodes()[node] {
            Node::Number(n) => {
                let n = if negative { -n } else { n };
                Text { text: self.style.number(n), binds: Binds::Atom }
            }
            Node::Add(a, b) => self.sum(a, b, negative),
            Node::Mul(a, b) => self.product(a, b, negative),
            Node::Recip(a) => self.function(|s, a| s.recip(a), a, negative),
            Node::Sqrt(a) => self.function(|s, a| s.sqrt(a), a, negative),
            Node::Sign(a) => self.function(|s, a| s.sign(a), a, negative),
            // Symbols, sines and cosines always have names.
            Node::Symbol(_) | Node::Sin(_) | Node::Cos(_) => {
                Text { text: format!("node{node}"), binds: Binds::Atom }
            }
        }
    }

    fn function(
        &self,
        spell: impl Fn(&dyn Style, &str) -> String,
        a: Expr,
        negative: bool,
    ) -> Text {
        let text = spell(self.style, &self.print(a));
        match negative {
            true => Text { text: format!("-{text}"), binds: Binds::Negation },
            false => Text { text, binds: Binds::Atom },
        }
    }

    fn sum(&self, a: Expr, b: Expr, negative: bool) -> Text {
        if let Some(text) = self.fused(a.signed(negative), b.signed(negative)) {
            return Text { text, binds: Binds::Atom };
        }
        let text = match (negative, b.is_negative()) {
            (false, false) if self.is_inline_sum(b) && !self.is_inline_sum(a) => {
                self.plus(b, a, "+")
            }
            (false, false) => self.plus(a, b, "+"),
            (false, true) => self.plus(a, -b, "-"),
            (true, true) => self.plus(-b, a, "-"),
            (true, false) => {
                let inner = self.plus(a, b, "+");
                let text = format!("-{}", self.style.bracket(&inner));
                return Text { text, binds: Binds::Negation };
            }
        };
        Text { text, binds: Binds::Sum }
    }

    /// `a + b` with the product that is one of them taken into the sum, where the style has that.
    fn fused(&self, a: Expr, b: Expr) -> Option<String> {
        let (product, other) = match (self.is_inline_product(a), self.is_inline_product(b)) {
            (_, true) => (b, a),
            (true, false) => (a, b),
            (false, false) => return None,
        };
        let Node::Mul(x, y) = self.plan.program.graph.node(product) else { return None };
        let x = x.signed(product.is_negative());
        self.style.fused(&self.print(x), &self.print(y), &self.print(other))
    }

    /// `a + b` or `a - b`; a sum on the right is bracketed, which keeps the order of the operations.
    fn plus(&self, a: Expr, b: Expr, operator: &str) -> String {
        let (left, right) = (self.signed(a, false), self.signed(b, false));
        let right = match right.binds {
            Binds::Sum | Binds::Negation => self.style.bracket(&right.text),
            _ => right.text,
        };
        format!("{} {operator} {right}", left.text)
    }

    fn product(&self, a: Expr, b: Expr, negative: bool) -> Text {
        // A product on the left needs no brackets; a constant reads best in front.
        let (mut a, mut b) = match self.is_inline_product(b) && !self.is_inline_product(a) {
            true => (b, a),
            false => (a, b),
        };
        let mut outer = negative;
        if negative && self.absorbs(a.node()) {
            (a, outer) = (-a, false);
        } else if negative && self.absorbs(b.node()) {
            (b, outer) = (-b, false);
        }
        let (left, right) = (self.signed(a, false), self.signed(b, false));
        let left =
            if left.binds == Binds::Sum { self.style.bracket(&left.text) } else { left.text };
        let right =
            if right.binds != Binds::Atom { self.style.bracket(&right.text) } else { right.text };
        let text = self.style.product(&left, &right);
        match outer {
            true => Text { text: format!("-{text}"), binds: Binds::Negation },
            false => Text { text, binds: Binds::Product },
        }
    }

    /// Whether `-node` can be written without a sign change of its own.
    fn absorbs(&self, node: usize) -> bool {
        self.plan.name(node).is_none() && self.absorbs_written_out(node)
    }

    fn absorbs_written_out(&self, node: usize) -> bool {
        match self.plan.program.graph.nodes()[node] {
            Node::Number(_) => true,
            Node::Add(_, b) => b.is_negative(),
            Node::Mul(a, b) => self.absorbs(a.node()) || self.absorbs(b.node()),
            _ => false,
        }
    }

    fn is_inline_sum(&self, e: Expr) -> bool {
        let node = e.node();
        self.plan.name(node).is_none()
            && matches!(self.plan.program.graph.nodes()[node], Node::Add(..))
    }

    fn is_inline_product(&self, e: Expr) -> bool {
        let node = e.node();
        self.plan.name(node).is_none()
            && matches!(self.plan.program.graph.nodes()[node], Node::Mul(..))
    }
}
