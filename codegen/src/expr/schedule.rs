//! From the graph to a sequence: what gets a name, in which order, in blocks of bounded length.

use super::graph::{Expr, Graph, Node};

/// Something that a function does in order: it stores a result, or solves for unknowns.
#[derive(Clone, Debug)]
pub enum Item {
    /// Stores the value of an expression.
    Store(Expr),
    /// Solves a linear system.
    Solve {
        /// Matrix and right-hand side.
        inputs: Vec<Expr>,
        /// The symbols that it defines.
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
    items: Vec<Vec<usize>>,
    unknowns: Vec<Vec<usize>>,
    operands: Vec<Vec<usize>>,
}

/// A run of steps with the names that cross its borders.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// The steps of the block, as a range of [`Schedule::steps`].
    pub steps: core::ops::Range<usize>,
    /// Nodes named before the block and used in it.
    pub live_in: Vec<usize>,
    /// Nodes named in the block and used after it.
    pub live_out: Vec<usize>,
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

impl Schedule {
    /// Number of names.
    pub fn lets(&self) -> usize {
        self.steps.iter().filter(|s| matches!(s, Binding::Let(_))).count()
    }

    /// Cuts a range of steps into blocks of at most `limit` names, and always before and after the
    /// items for which `alone` holds.
    pub fn blocks(
        &self,
        range: core::ops::Range<usize>,
        limit: usize,
        alone: impl Fn(usize) -> bool,
    ) -> Vec<Block> {
        let mut cuts = vec![range.start];
        let mut lets = 0;
        for at in range.clone() {
            match self.steps[at] {
                Binding::Item(item) if alone(item) => {
                    cuts.extend([at, at + 1]);
                    lets = 0;
                }
                Binding::Let(_) if lets == limit => {
                    cuts.push(at);
                    lets = 1;
                }
                Binding::Let(_) => lets += 1,
                Binding::Item(_) => {}
            }
        }
        cuts.push(range.end);
        cuts.dedup();
        cuts.windows(2).filter(|w| w[0] < w[1]).map(|w| self.block(w[0]..w[1])).collect()
    }

    /// A range of steps with the names that cross its borders.
    pub fn block(&self, steps: core::ops::Range<usize>) -> Block {
        let defined = |range: core::ops::Range<usize>| {
            let nodes = self.steps[range].iter().flat_map(|step| match step {
                Binding::Let(node) => core::slice::from_ref(node),
                Binding::Item(item) => &self.unknowns[*item][..],
            });
            nodes.copied().collect::<Vec<usize>>()
        };
        let used = |range| {
            let mut mask = vec![false; self.bound.len()];
            self.mark_uses(range, &mut mask);
            mask
        };
        let (inside, after) = (used(steps.clone()), used(steps.end..self.steps.len()));
        let live_in = defined(0..steps.start).into_iter().filter(|n| inside[*n]).collect();
        let live_out = defined(steps.clone()).into_iter().filter(|n| after[*n]).collect();
        Block { steps, live_in, live_out }
    }

    /// Marks the names that a range of steps reads, looking through what is written in place.
    fn mark_uses(&self, range: core::ops::Range<usize>, mask: &mut [bool]) {
        let mut stack: Vec<usize> = Vec::new();
        for step in &self.steps[range] {
            match step {
                Binding::Let(node) => stack.extend(&self.operands[*node]),
                Binding::Item(item) => stack.extend(&self.items[*item]),
            }
        }
        let mut entered = vec![false; mask.len()];
        while let Some(node) = stack.pop() {
            mask[node] = true;
            if !self.bound[node] && !core::mem::replace(&mut entered[node], true) {
                stack.extend(&self.operands[node]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::graph::Symbol;
    use super::*;

    /// A chain of `n` products, each used twice.
    fn chain(n: usize) -> (Graph, Vec<Item>) {
        let mut g = Graph::new();
        let x = g.symbol(Symbol::Joint(0));
        let mut items = Vec::new();
        let mut e = x;
        for _ in 0..n {
            e = g.mul(e, x);
            items.push(Item::Store(e));
        }
        (g, items)
    }

    #[test]
    fn operands_come_before_uses_and_blocks_are_bounded() {
        let (g, items) = chain(1000);
        let schedule = g.schedule(&items, |_| false);
        let mut named = vec![false; g.nodes().len()];
        for step in &schedule.steps {
            if let Binding::Let(node) = step {
                for o in g.nodes()[*node].operands() {
                    assert!(!schedule.bound[o.node()] || named[o.node()]);
                }
                named[*node] = true;
            }
        }
        let blocks = schedule.blocks(0..schedule.steps.len(), 256, |_| false);
        assert_eq!(blocks.len(), schedule.lets().div_ceil(256));
        for pair in blocks.windows(2) {
            assert_eq!(pair[0].steps.end, pair[1].steps.start);
            assert_eq!(pair[0].live_out, pair[1].live_in, "a chain keeps one value alive");
            assert_eq!(pair[0].live_out.len(), 1);
        }
    }

    #[test]
    fn single_uses_are_written_in_place_until_they_are_long() {
        let mut g = Graph::new();
        let x: Vec<Expr> = (0..30).map(|k| g.symbol(Symbol::Joint(k))).collect();
        let sum = x.iter().fold(Expr::ZERO, |sum, e| g.add(sum, *e));
        let schedule = g.schedule(&[Item::Store(sum)], |_| false);
        assert!((2..=4).contains(&schedule.lets()), "{}", schedule.lets());
    }

    #[test]
    fn unknowns_of_a_solve_live_across_blocks() {
        let mut g = Graph::new();
        let (x, u) =
            (g.symbol(Symbol::Joint(0)), g.symbol(Symbol::Deflection { joint: 0, weights: false }));
        let square = g.mul(x, x);
        let result = g.mul(square, u);
        let items = [
            Item::Store(square),
            Item::Solve { inputs: vec![square], unknowns: vec![u] },
            Item::Store(result),
        ];
        let schedule = g.schedule(&items, |_| false);
        let blocks = schedule.blocks(0..schedule.steps.len(), 256, |item| item == 1);
        assert_eq!(blocks.len(), 3);
        assert_eq!(blocks[1].live_out, [u.node()]);
        assert!(
            blocks[2].live_in.contains(&u.node()) && blocks[2].live_in.contains(&square.node())
        );
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
