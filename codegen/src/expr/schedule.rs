//! From the graph to a sequence: what gets a name, in which order.

use super::graph::{Expr, Graph, Node};

/// Something that a function does in order: it stores a result, or solves for unknowns.
#[derive(Clone, Debug)]
pub enum Item {
    /// Stores the value of an expression.
    Store(Expr),
    /// Works out what is no arithmetic of the graph: a linear system, or sines and cosines of own angles.
    Solve {
        /// Matrix and right-hand side; the angles.
        inputs: Vec<Expr>,
        /// The symbols that it defines; the sines and cosines.
        unknowns: Vec<Expr>,
    },
}

/// One step of the sequence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Binding {
    /// Gives the node a name.
    Let(usize),
    /// Carries out item number `0` of the list that was scheduled.
    Item(usize),
}

/// A valid order of evaluation.
#[derive(Clone, Debug)]
pub struct Schedule {
    /// The steps, operands before uses.
    pub steps: Vec<Binding>,
    /// By node: whether it has a name of its own; other nodes are written where they are used.
    pub bound: Vec<bool>,
    pub(super) items: Vec<Vec<usize>>,
    pub(super) unknowns: Vec<Vec<usize>>,
    pub(super) operands: Vec<Vec<usize>>,
}

/// A single expression is broken by a name when it would hold more operations than this.
const LONGEST: usize = 9;

impl Graph {
    /// Schedules `items`. `is_input` tells which nodes are given from outside (sines and cosines, the
    /// wrench, hoisted constants): they are neither named nor entered.
    ///
    /// Results are computed on demand, in the order of the items, the operand with the larger
    /// subexpression first: values are made late and consumed early, so few are alive at a time.
    pub fn schedule(&self, items: &[Item], is_input: impl Fn(usize) -> bool) -> Schedule {
        let inner = |e: Expr| {
            let node = e.node();
            (!is_input(node) && !matches!(self.nodes()[node], Node::Number(_) | Node::Symbol(_)))
                .then_some(node)
        };
        let roots: Vec<Vec<usize>> = items
            .iter()
            .map(|item| item.inputs().iter().copied().filter_map(inner).collect())
            .collect();
        let operands: Vec<Vec<usize>> = (0..self.nodes().len())
            .map(|at| match is_input(at) {
                true => Vec::new(),
                false => self.nodes()[at].operands().filter_map(inner).collect(),
            })
            .collect();
        let (uses, size) = self.weigh(&roots, &operands);
        // What is only stored is written where it is stored; what enters a system gets a name.
        let (mut stored, mut solved) = (vec![false; uses.len()], vec![false; uses.len()]);
        for (item, inputs) in items.iter().zip(&roots) {
            let mask = if matches!(item, Item::Store(_)) { &mut stored } else { &mut solved };
            inputs.iter().for_each(|node| mask[*node] = true);
        }
        let long = |at: usize| self.name_of(at).is_some() || size[at].1;
        let wanted = |at: usize| solved[at] || !stored[at] && long(at);
        let bound: Vec<bool> =
            (0..self.nodes().len()).map(|at| uses[at] > 1 || uses[at] == 1 && wanted(at)).collect();
        let mut order =
            Order { operands: &operands, size: &size, bound: &bound, seen: vec![], out: vec![] };
        order.seen = vec![false; self.nodes().len()];
        for (at, inputs) in roots.iter().enumerate() {
            inputs.iter().for_each(|node| order.visit(*node));
            order.out.push(Binding::Item(at));
        }
        let steps = order.out;
        let unknowns = items.iter().map(|item| item.unknowns().iter().map(|e| e.node()).collect());
        let unknowns = unknowns.collect();
        Schedule { steps, bound, items: roots, unknowns, operands: self.all_operands(&is_input) }
    }

    /// Use counts, and for every node the operations written in its place with a flag that says that
    /// it is too long to be written inside another one.
    fn weigh(
        &self,
        roots: &[Vec<usize>],
        operands: &[Vec<usize>],
    ) -> (Vec<u32>, Vec<(usize, bool)>) {
        let mut uses = vec![0u32; self.nodes().len()];
        roots.iter().flatten().for_each(|node| uses[*node] += 1);
        for at in (0..uses.len()).rev() {
            if uses[at] > 0 {
                operands[at].iter().for_each(|o| uses[*o] += 1);
            }
        }
        let mut size = vec![(0usize, false); uses.len()];
        for at in 0..uses.len() {
            let inlined = operands[at]
                .iter()
                .filter(|o| uses[**o] == 1 && !size[**o].1 && self.name_of(**o).is_none());
            let total = 1 + inlined.map(|o| size[*o].0).sum::<usize>();
            size[at] = (total, total > LONGEST);
        }
        (uses, size)
    }

    /// Operands including symbols, for liveness: the unknowns of a solve are symbols.
    fn all_operands(&self, is_input: impl Fn(usize) -> bool) -> Vec<Vec<usize>> {
        (0..self.nodes().len())
            .map(|at| match is_input(at) {
                true => Vec::new(),
                false => self.nodes()[at].operands().map(Expr::node).collect(),
            })
            .collect()
    }
}

impl Item {
    fn inputs(&self) -> &[Expr] {
        match self {
            Item::Store(e) => core::slice::from_ref(e),
            Item::Solve { inputs, .. } => inputs,
        }
    }

    fn unknowns(&self) -> &[Expr] {
        match self {
            Item::Store(_) => &[],
            Item::Solve { unknowns, .. } => unknowns,
        }
    }
}

struct Order<'a> {
    operands: &'a [Vec<usize>],
    size: &'a [(usize, bool)],
    bound: &'a [bool],
    seen: Vec<bool>,
    out: Vec<Binding>,
}

impl Order<'_> {
    /// Post-order with an explicit stack: a chain of many joints is deeper than a thread's stack.
    fn visit(&mut self, root: usize) {
        let mut stack = vec![(root, false)];
        while let Some((node, expanded)) = stack.pop() {
            if expanded {
                if self.bound[node] {
                    self.out.push(Binding::Let(node));
                }
                continue;
            }
            if core::mem::replace(&mut self.seen[node], true) {
                continue;
            }
            stack.push((node, true));
            let mut operands = self.operands[node].clone();
            operands.sort_by_key(|o| (self.size[*o].0, core::cmp::Reverse(*o)));
            stack.extend(operands.into_iter().map(|o| (o, false)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::graph::Symbol;
    use super::*;

    #[test]
    fn single_uses_are_written_in_place_until_they_are_long() {
        let mut g = Graph::new();
        let x: Vec<Expr> = (0..30).map(|k| g.symbol(Symbol::Joint(k))).collect();
        let sum = x.iter().fold(Expr::ZERO, |sum, e| g.add(sum, *e));
        let schedule = g.schedule(&[Item::Store(sum)], |_| false);
        assert!((2..=4).contains(&schedule.lets()), "{}", schedule.lets());
    }

    #[test]
    fn inputs_are_neither_named_nor_entered() {
        let mut g = Graph::new();
        let x = g.symbol(Symbol::Joint(0));
        let s = g.sin(x);
        let square = g.mul(s, s);
        let schedule = g.schedule(&[Item::Store(square), Item::Store(-square)], |n| n == s.node());
        assert_eq!(schedule.lets(), 1);
    }
}
