//! Constructors: exact folding of 0, ±1, signs and constants, and one canonical operand order.

use super::graph::{Expr, Graph, Node};
use stiffarm_table::number::Number;

impl Graph {
    /// A constant.
    pub fn number(&mut self, n: Number) -> Expr {
        self.intern(Node::Number(n.abs())).signed(n.is_negative())
    }

    /// `a + b`.
    pub fn add(&mut self, a: Expr, b: Expr) -> Expr {
        if a.is_zero() {
            return b;
        }
        if b.is_zero() {
            return a;
        }
        if a == -b {
            return Expr::ZERO;
        }
        if a == b {
            let two = self.number(Number::integer(2));
            return self.mul(two, a);
        }
        if let Some(sum) = self.add_constants(a, b) {
            return sum;
        }
        let (first, second) = self.ordered(a, b);
        // The first operand is stored unsigned; the handle of the sum carries its sign.
        let flip = first.is_negative();
        self.intern(Node::Add(first.abs(), second.signed(flip))).signed(flip)
    }

    /// `a - b`.
    pub fn sub(&mut self, a: Expr, b: Expr) -> Expr {
        self.add(a, -b)
    }

    /// `a · b`.
    pub fn mul(&mut self, a: Expr, b: Expr) -> Expr {
        if a.is_zero() || b.is_zero() {
            return Expr::ZERO;
        }
        let negative = a.is_negative() != b.is_negative();
        let (a, b) = (a.abs(), b.abs());
        if a == Expr::ONE {
            return b.signed(negative);
        }
        if b == Expr::ONE {
            return a.signed(negative);
        }
        let (first, second) = self.ordered(a, b);
        let product = self
            .mul_constants(first, second)
            .or_else(|| self.cancel(first, second))
            .unwrap_or_else(|| self.intern(Node::Mul(first, second)));
        product.signed(negative)
    }

    /// `1/a`. The caller has ruled out a structural zero.
    pub fn recip(&mut self, a: Expr) -> Expr {
        let negative = a.is_negative();
        let folded = match self.node(a) {
            Node::Number(n) => n.recip().map(|r| self.number(r)),
            Node::Recip(inner) => Some(inner),
            _ => None,
        };
        folded.unwrap_or_else(|| self.intern(Node::Recip(a.abs()))).signed(negative)
    }

    /// `√a`.
    pub fn sqrt(&mut self, a: Expr) -> Expr {
        match self.number_of(a).and_then(Number::sqrt) {
            Some(root) => self.number(root),
            None => self.intern(Node::Sqrt(a)),
        }
    }

    /// The sign of `a`, which is no constant but zero.
    pub fn sign(&mut self, a: Expr) -> Expr {
        if a.is_zero() {
            return a;
        }
        self.intern(Node::Sign(a.abs())).signed(a.is_negative())
    }

    /// `sin a`; [`Turn`](super::Turn) folds multiples of π exactly before.
    pub fn sin(&mut self, a: Expr) -> Expr {
        match self.number_of(a) {
            Some(n) => self.number(Number::cosine(libm::sin(n.to_f64()))),
            None => self.intern(Node::Sin(a.abs())).signed(a.is_negative()),
        }
    }

    /// `cos a`.
    pub fn cos(&mut self, a: Expr) -> Expr {
        match self.number_of(a) {
            Some(n) => self.number(Number::cosine(libm::cos(n.to_f64()))),
            None => self.intern(Node::Cos(a.abs())),
        }
    }

    /// The angle of the direction (x, y). A direction and its opposite are one node and half a turn.
    pub fn atan2(&mut self, y: Expr, x: Expr) -> Expr {
        if let (Some(up), Some(along)) = (self.number_of(y), self.number_of(x)) {
            let angle = libm::atan2(up.to_f64(), along.to_f64());
            return self.number(Number::rounded(angle));
        }
        let angle = self.intern(Node::Atan2(y.abs(), x.abs()));
        let folded = match x.is_negative() {
            false => angle,
            true => {
                let half = self.number(Number::rounded(core::f64::consts::PI));
                // At y = 0 the angle of the opposite direction is π or 0, never −π.
                let half = self.select(-y.abs(), -half, half);
                self.sub(half, angle)
            }
        };
        folded.signed(y.is_negative())
    }

    /// `a` where `on` is above zero, else `b`.
    pub fn select(&mut self, on: Expr, a: Expr, b: Expr) -> Expr {
        match self.number_of(on) {
            _ if a == b => a,
            Some(n) if n.is_zero() || n.is_negative() => b,
            Some(_) => a,
            None => self.intern(Node::Select(on, a, b)),
        }
    }

    /// The larger of zero and `a`.
    pub fn positive_part(&mut self, a: Expr) -> Expr {
        self.select(a, a, Expr::ZERO)
    }

    /// The canonical order of two operands: constants first, then the older node.
    fn ordered(&self, a: Expr, b: Expr) -> (Expr, Expr) {
        let key = |e: Expr| (!matches!(self.node(e), Node::Number(_)), e.node());
        if key(a) < key(b) { (a, b) } else { (b, a) }
    }

    /// The sum of two constants, or of a constant and a sum that ends in one.
    fn add_constants(&mut self, a: Expr, b: Expr) -> Option<Expr> {
        if let (Some(x), Some(y)) = (self.number_of(a), self.number_of(b)) {
            return Some(self.number(x + y));
        }
        let (constant, other) = match (self.number_of(a), self.number_of(b)) {
            (Some(x), None) => (x, b),
            (None, Some(y)) => (y, a),
            _ => return None,
        };
        let Node::Add(low, high) = self.node(other) else { return None };
        let flip = other.is_negative();
        let (low, high) = (low.signed(flip), high.signed(flip));
        let (inner, rest) = match (self.number_of(low), self.number_of(high)) {
            (Some(n), _) => (n, high),
            (_, Some(n)) => (n, low),
            _ => return None,
        };
        let folded = self.number(constant + inner);
        Some(self.add(folded, rest))
    }

    /// The product of two constants, or of a constant and a product that begins with one.
    fn mul_constants(&mut self, a: Expr, b: Expr) -> Option<Expr> {
        let (constant, other) = match (self.number_of(a), self.number_of(b)) {
            (Some(x), Some(y)) => return Some(self.number(x * y)),
            (Some(x), None) => (x, b),
            (None, Some(y)) => (y, a),
            _ => return None,
        };
        let Node::Mul(low, high) = self.node(other) else { return None };
        let (inner, rest) = match (self.number_of(low), self.number_of(high)) {
            (Some(n), _) => (n, high),
            (_, Some(n)) => (n, low),
            _ => return None,
        };
        let folded = self.number(constant * inner);
        Some(self.mul(folded, rest))
    }

    /// `a · (1/a) = 1` and `√a · √a = a`.
    fn cancel(&mut self, a: Expr, b: Expr) -> Option<Expr> {
        match (self.node(a), self.node(b)) {
            (_, Node::Recip(inner)) if inner == a => Some(Expr::ONE),
            (Node::Recip(inner), _) if inner == b => Some(Expr::ONE),
            (Node::Sqrt(inner), _) if a == b => Some(inner),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::graph::Symbol;
    use super::*;

    fn two() -> (Graph, Expr, Expr) {
        let mut g = Graph::new();
        let (a, b) = (g.symbol(Symbol::Joint(0)), g.symbol(Symbol::Joint(1)));
        (g, a, b)
    }

    #[test]
    fn sums_are_canonical() {
        let (mut g, a, b) = two();
        assert_eq!(g.add(a, b), g.add(b, a));
        assert_eq!(g.sub(a, b), -g.sub(b, a));
        assert_eq!(g.add(-a, -b), -g.add(a, b));
        assert_eq!(g.sub(a, a), Expr::ZERO);
        let two = g.number(Number::integer(2));
        assert_eq!(g.add(a, a), g.mul(a, two));
    }

    #[test]
    fn products_are_canonical() {
        let (mut g, a, b) = two();
        assert_eq!(g.mul(a, b), g.mul(b, a));
        assert_eq!(g.mul(-a, b), -g.mul(a, b));
        assert_eq!(g.mul(-a, -b), g.mul(a, b));
        assert_eq!(g.mul(a, -Expr::ONE), -a);
        assert_eq!(g.mul(a, Expr::ZERO), Expr::ZERO);
    }

    #[test]
    fn constants_collect() {
        let (mut g, a, _) = two();
        let half = g.number(Number::ratio(1, 2));
        let two = g.number(Number::integer(2));
        let scaled = g.mul(half, a);
        assert_eq!(g.mul(two, scaled), a);
        let shifted = g.add(a, half);
        assert_eq!(g.sub(shifted, half), a);
        let (minus, third) = (g.sub(half, a), g.number(Number::ratio(3, 2)));
        assert_eq!(g.add(minus, third), g.sub(two, a));
    }

    #[test]
    fn reciprocals_and_roots_cancel() {
        let (mut g, a, _) = two();
        let inverse = g.recip(a);
        assert_eq!(g.mul(inverse, a), Expr::ONE);
        assert_eq!(g.recip(inverse), a);
        assert_eq!(g.recip(-a), -inverse);
        let root = g.sqrt(a);
        assert_eq!(g.mul(root, root), a);
    }

    #[test]
    fn opposite_directions_share_an_angle() {
        let (mut g, a, b) = two();
        let angle = g.atan2(a, b);
        assert_eq!(g.atan2(-a, b), -angle);
        let opposite = g.atan2(-a, -b);
        let angles = g.nodes().iter().filter(|node| matches!(node, Node::Atan2(..))).count();
        assert_eq!(angles, 1);
        for (y, x) in [(0.3, 0.4), (-0.3, 0.4), (0.3, -0.4), (-0.3, -0.4)] {
            let value = |s: &Symbol| if *s == Symbol::Joint(0) { y } else { x };
            let difference: f64 = g.evaluate(&[opposite], value)[0] - f64::atan2(-y, -x);
            assert!(difference.abs() < 1e-15, "{difference}");
        }
    }

    #[test]
    fn what_is_known_is_not_chosen() {
        let (mut g, a, b) = two();
        let half = g.number(Number::ratio(1, 2));
        assert_eq!((g.select(half, a, b), g.select(-half, a, b)), (a, b));
        assert_eq!((g.select(Expr::ZERO, a, b), g.select(a, b, b)), (b, b));
    }

    #[test]
    fn parity_of_sine_and_cosine() {
        let (mut g, a, _) = two();
        assert_eq!(g.sin(-a), -g.sin(a));
        assert_eq!(g.cos(-a), g.cos(a));
    }
}
