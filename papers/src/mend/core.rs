//! The part of a formula in which slips add up.

use crate::exact::arithmetic::Arithmetic;
use crate::exact::field::{Modular, minus};
use crate::latex::tree::Tree;

/// Values at the two points by which candidates are judged.
pub(super) type Pair = [u64; 2];

/// A formula `rest · value^(2 or 1)`: slips add up inside a square as well.
pub(super) struct Core {
    pub root: bool,
    pub rest: Pair,
    pub value: Pair,
}

impl Core {
    pub fn of(tree: &Tree, points: &[Modular; 2]) -> Option<Core> {
        let (rest, squared) = split(tree);
        let root = !squared.is_empty();
        let at = |k: usize| -> Option<(u64, u64)> {
            let f: &Modular = &points[k];
            if !root {
                return Some((1, f.tree(tree).ok()?));
            }
            let product = |trees: &[&Tree]| trees.iter().try_fold(1, |p, t| f.mul(p, f.tree(t)?));
            let over =
                |(above, below): &(Vec<&Tree>, Vec<&Tree>)| f.div(product(above)?, product(below)?);
            over(&rest).and_then(|rest| Ok((rest, product(&squared)?))).ok()
        };
        let (a, b) = (at(0)?, at(1)?);
        Some(Core { root, rest: [a.0, b.0], value: [a.1, b.1] })
    }

    /// What `value` should be.
    pub fn wanted(&self, truth: Pair, points: &[Modular; 2]) -> Option<Vec<Pair>> {
        if !self.root {
            return Some(vec![truth]);
        }
        let root = |k: usize| -> Option<u64> {
            let f: &Modular = &points[k];
            f.div(truth[k], self.rest[k]).and_then(|square| f.sqrt(square)).ok()
        };
        let (a, b) = (root(0)?, root(1)?);
        let (minus_a, minus_b) = (minus(0, a), minus(0, b));
        Some(vec![[a, b], [a, minus_b], [minus_a, b], [minus_a, minus_b]])
    }
}

/// Factors of a product that are squares (their roots), and the rest (above and below).
fn split(tree: &Tree) -> ((Vec<&Tree>, Vec<&Tree>), Vec<&Tree>) {
    let mut rest = (Vec::new(), Vec::new());
    let mut squared = Vec::new();
    let mut stack = vec![tree];
    while let Some(tree) = stack.pop() {
        match tree {
            Tree::Product(factors) => stack.extend(factors),
            Tree::Power(base, 2) => squared.push(base.as_ref()),
            Tree::Quotient(a, b) => {
                stack.push(a);
                rest.1.push(b.as_ref());
            }
            other => rest.0.push(other),
        }
    }
    (rest, squared)
}
