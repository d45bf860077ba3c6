//! A sequence cut into blocks of bounded length, with the names that cross their borders.

use super::schedule::{Binding, Schedule};

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

impl Schedule {
    /// Number of names.
    pub fn lets(&self) -> usize {
        self.steps.iter().filter(|s| matches!(s, Binding::Let(_))).count()
    }

    /// Cuts a range of steps into blocks of at most `limit` names, and always before and after the
    /// items for which `apart` holds.
    pub fn blocks(
        &self,
        range: core::ops::Range<usize>,
        limit: usize,
        apart: impl Fn(usize) -> bool,
    ) -> Vec<Block> {
        let mut cuts = vec![range.start];
        let mut lets = 0;
        for at in range.clone() {
            match self.steps[at] {
                Binding::Item(item) if apart(item) => {
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
    use super::super::graph::{Graph, Symbol};
    use super::super::schedule::Item;
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
}
