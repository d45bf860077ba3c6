//! From the graph to a sequence: what gets a name, in which order.

use crate::expr::{Expr, Graph, Node};

/// Something that a function does in order: it stores a result, or solves for unknowns.
#[derive(Clone, Debug)]
pub(super) enum Item {
    /// Stores the value of an expression.
    Store(Expr),
    /// Works out what is no arithmetic of the graph from matrix and right-hand side of a linear system, or from angles.
    Solve(Vec<Expr>),
}

/// One step of the sequence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Binding {
    /// Gives the node a name.
    Let(usize),
    /// Carries out item number `0` of the list that was scheduled.
    Item(usize),
}

/// A single expression is broken by a name when it would hold more operations than this.
const LONGEST: usize = 9;

/// Schedules `items`: steps in a valid order of evaluation; what gets no name is written where it is used. `is_input`
/// tells which nodes are given from outside (sines and cosines, the wrench, hoisted constants): they are neither
/// named nor entered.
///
/// Results are computed on demand, in the order of the items, the operand with the larger
/// subexpression first: values are made late and consumed early, so few are alive at a time.
pub(super) fn schedule(
    g: &Graph,
    items: &[Item],
    is_input: impl Fn(usize) -> bool,
) -> Vec<Binding> {
    let inner = |e: Expr| {
        let node = e.node();
        (!is_input(node) && !matches!(g.nodes()[node], Node::Number(_) | Node::Symbol(_)))
            .then_some(node)
    };
    let roots: Vec<Vec<usize>> = items
        .iter()
        .map(|item| item.inputs().iter().copied().filter_map(inner).collect())
        .collect();
    let operands: Vec<Vec<usize>> = (0..g.nodes().len())
        .map(|at| match is_input(at) {
            true => Vec::new(),
            false => g.nodes()[at].operands().filter_map(inner).collect(),
        })
        .collect();
    let (uses, size) = weigh(g, &roots, &operands);
    // What is only stored is written where it is stored; what enters a system gets a name.
    let (mut stored, mut solved) = (vec![false; uses.len()], vec![false; uses.len()]);
    for (item, inputs) in items.iter().zip(&roots) {
        let mask = if matches!(item, Item::Store(_)) { &mut stored } else { &mut solved };
        inputs.iter().for_each(|node| mask[*node] = true);
    }
    let long = |at: usize| g.name_of(at).is_some() || size[at].1;
    let wanted = |at: usize| solved[at] || !stored[at] && long(at);
    let bound: Vec<bool> =
        (0..g.nodes().len()).map(|at| uses[at] > 1 || uses[at] == 1 && wanted(at)).collect();
    let mut order =
        Order { operands: &operands, size: &size, bound: &bound, seen: vec![], out: vec![] };
    order.seen = vec![false; g.nodes().len()];
    for (at, inputs) in roots.iter().enumerate() {
        inputs.iter().for_each(|node| order.visit(*node));
        order.out.push(Binding::Item(at));
    }
    order.out
}

/// Use counts, and for every node the operations written in its place with a flag that says that
/// it is too long to be written inside another one.
fn weigh(
    g: &Graph,
    roots: &[Vec<usize>],
    operands: &[Vec<usize>],
) -> (Vec<u32>, Vec<(usize, bool)>) {
    let mut uses = vec![0u32; g.nodes().len()];
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
            .filter(|o| uses[**o] == 1 && !size[**o].1 && g.name_of(**o).is_none());
        let total = 1 + inlined.map(|o| size[*o].0).sum::<usize>();
        size[at] = (total, total > LONGEST);
    }
    (uses, size)
}

impl Item {
    fn inputs(&self) -> &[Expr] {
        match self {
            Item::Store(e) => core::slice::from_ref(e),
            Item::Solve(inputs) => inputs,
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
    use super::*;
    use crate::expr::Symbol;

    fn lets(steps: &[Binding]) -> usize {
        steps.iter().filter(|step| matches!(step, Binding::Let(_))).count()
    }

    #[test]
    fn single_uses_are_written_in_place_until_they_are_long() {
        let mut g = Graph::new();
        let x: Vec<Expr> = (0..30).map(|k| g.symbol(Symbol::Joint(k))).collect();
        let sum = x.iter().fold(Expr::ZERO, |sum, e| g.add(sum, *e));
        let schedule = schedule(&g, &[Item::Store(sum)], |_| false);
        assert!((2..=4).contains(&lets(&schedule)), "{schedule:?}");
    }

    #[test]
    fn inputs_are_neither_named_nor_entered() {
        let mut g = Graph::new();
        let x = g.symbol(Symbol::Joint(0));
        let s = g.sin(x);
        let square = g.mul(s, s);
        let schedule =
            schedule(&g, &[Item::Store(square), Item::Store(-square)], |n| n == s.node());
        assert_eq!(lets(&schedule), 1);
    }
}
