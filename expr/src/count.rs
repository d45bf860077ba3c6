//! Operation count of the nodes that a set of outputs needs.

use std::collections::HashSet;

use super::graph::{Expr, Graph, Node, Symbol};

/// Operations, each shared node counted once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OpCount {
    /// Additions and subtractions.
    pub add: u32,
    /// Multiplications.
    pub mul: u32,
    /// Reciprocals and square roots.
    pub div: u32,
    /// Sine-cosine pairs: a sine and a cosine of one angle are one.
    pub sin_cos: u32,
    /// Angles of directions.
    pub atan2: u32,
}

impl OpCount {
    /// Additions and multiplications.
    pub fn flops(self) -> u32 {
        self.add + self.mul
    }

    /// One number to compare ways of computing the same thing: a sine-cosine pair weighs as much as
    /// the polynomial it takes, the angle of a direction as much as its own, a division as much as its latency.
    pub fn cost(self) -> u32 {
        self.flops() + 12 * (self.sin_cos + self.atan2) + 6 * self.div
    }
}

impl Graph {
    /// The nodes that `outputs` depend on, themselves included, as a mask over the arena.
    pub fn reachable(&self, outputs: &[Expr]) -> Vec<bool> {
        let mut used = vec![false; self.nodes().len()];
        for e in outputs {
            used[e.node()] = true;
        }
        for at in (0..used.len()).rev() {
            if used[at] {
                for operand in self.nodes()[at].operands() {
                    used[operand.node()] = true;
                }
            }
        }
        used
    }

    /// Nodes that depend on parameters, and on nothing that a posture or a load changes.
    pub fn parameter_only(&self) -> Vec<bool> {
        let mut only = Vec::with_capacity(self.nodes().len());
        for node in self.nodes() {
            let is = match node {
                Node::Number(_) => true,
                Node::Symbol(s) => matches!(self.symbol_of(*s), Symbol::Parameter(_)),
                computed => computed.operands().all(|o| only[o.node()]),
            };
            only.push(is);
        }
        only
    }

    /// Counts what `outputs` cost together at every evaluation: what depends on parameters alone is
    /// worked out once and free. What the angles of the posture are made of (sums of joint
    /// angles) is not counted: it belongs to the trigonometry.
    pub fn count(&self, outputs: &[Expr]) -> OpCount {
        self.count_without(&self.parameter_only(), outputs)
    }

    /// The same with the mask of what is free given, for many counts on one graph.
    pub fn count_without(&self, once: &[bool], outputs: &[Expr]) -> OpCount {
        let mut count = OpCount::default();
        let mut angles = HashSet::new();
        let mut used = vec![false; self.nodes().len()];
        for e in outputs {
            used[e.node()] = true;
        }
        for at in (0..used.len()).rev() {
            if !used[at] || once[at] {
                continue;
            }
            match self.nodes()[at] {
                Node::Sin(a) | Node::Cos(a) => {
                    angles.insert(a);
                    if self.is_of_posture(a, once) {
                        continue;
                    }
                }
                Node::Add(..) => count.add += 1,
                Node::Mul(..) => count.mul += 1,
                Node::Recip(_) | Node::Sqrt(_) => count.div += 1,
                Node::Atan2(..) => count.atan2 += 1,
                // A comparison: neither a sum nor a product.
                Node::Sign(_) | Node::Select(..) | Node::Number(_) | Node::Symbol(_) => {}
            }
            for operand in self.nodes()[at].operands() {
                used[operand.node()] = true;
            }
        }
        count.sin_cos = angles.len() as u32;
        count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shared_nodes_count_once() {
        let mut g = Graph::new();
        let (x, y) = (g.symbol(Symbol::Joint(0)), g.symbol(Symbol::Joint(1)));
        let sum = g.add(x, y);
        let (s, c) = (g.sin(sum), g.cos(sum));
        let product = g.mul(s, c);
        let square = g.mul(product, product);
        let total = g.add(square, product);
        let expected = OpCount { add: 1, mul: 2, sin_cos: 1, ..OpCount::default() };
        assert_eq!(g.count(&[total, -product]), expected);
        assert_eq!(g.count(&[s]).flops(), 0);
        assert!(g.reachable(&[s])[x.node()]);
    }
}
