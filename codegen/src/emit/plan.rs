//! The plan of one function: what enters it, in which order it computes, and what everything is
//! called. All printers work from the same plan.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::angles::{Angle, last_joint, name};
use super::constants::Constants;
use super::posture::Plain;
use crate::derive::{COMPONENTS, Program};
use crate::expr::{Binding, Expr, Graph, Item, Node, Schedule, Symbol};
use crate::number::Number;

/// One function, ready to be printed.
pub(super) struct Plan<'p> {
    pub program: &'p Program,
    /// What each item of the schedule is.
    pub targets: Vec<Target>,
    pub schedule: Schedule,
    /// Angles whose sine or cosine enters, in the order of the joints.
    pub angles: Vec<Angle>,
    /// What enters as it is: displacements of prismatic joints, sides, growth.
    pub plain: Vec<Plain>,
    /// Fields of the constants that enter.
    pub constants: Vec<String>,
    /// Names of nodes: inputs, and what the schedule binds.
    names: HashMap<usize, String>,
}

/// What an item of the schedule stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// Entry `entry` of block `block`.
    Entry { block: usize, entry: usize },
    /// Linear system number `0`.
    Solve(usize),
}

/// Names of the wrench's components.
pub(super) const WRENCH: [&str; 6] = ["fx", "fy", "fz", "mx", "my", "mz"];

/// Names that generated functions use for other things.
const RESERVED: [&str; 8] = ["out", "posture", "constants", "q", "wrench", "live", "fn", "as"];

impl<'p> Plan<'p> {
    /// Plans the function that computes all of `program`; parameter-only values go to `constants`.
    pub fn new(program: &'p Program, constants: &mut Constants) -> Self {
        let g = &program.graph;
        let (items, targets) = items(program);
        let roots: Vec<Expr> = program.roots();
        let only = constants.hoisted(g);
        let reachable = reachable_outside(g, &roots, &only);
        let mut plan = Plan {
            program,
            schedule: g.schedule(&items, |node| is_input(g, &only, node)),
            targets,
            angles: Vec::new(),
            plain: Vec::new(),
            constants: Vec::new(),
            names: HashMap::new(),
        };
        plan.name_inputs(g, &only, &reachable, constants);
        plan.name_bindings(g);
        plan
    }

    /// The name of a node, if it has one; other nodes are written in place.
    pub fn name(&self, node: usize) -> Option<&str> {
        self.names.get(&node).map(String::as_str)
    }

    /// Inputs that a set of nodes reads directly or through what is written in place.
    pub fn inputs_of(&self, nodes: impl IntoIterator<Item = usize>) -> HashSet<usize> {
        let g = &self.program.graph;
        let mut found = HashSet::new();
        let mut stack: Vec<usize> = nodes.into_iter().collect();
        let mut entered = HashSet::new();
        while let Some(node) = stack.pop() {
            if self.names.contains_key(&node) && !self.schedule.bound[node] {
                found.insert(node);
            } else if entered.insert(node) {
                let inner = g.nodes()[node].operands().map(Expr::node);
                stack.extend(inner.filter(|o| !self.schedule.bound[*o]));
            }
        }
        found
    }

    /// Force and moment below which a load of system `k` needs no test: only where the wrench is read.
    pub fn margin(&self, k: usize) -> Option<[Number; 2]> {
        self.program.solves[k].margin.filter(|_| self.wrench().contains(&true))
    }

    /// Components of the wrench that are read.
    pub fn wrench(&self) -> [bool; 6] {
        let g = &self.program.graph;
        let mut read = [false; 6];
        for node in self.names.keys() {
            if let Node::Symbol(s) = g.nodes()[*node]
                && let Symbol::Wrench(k) = g.symbol_of(s)
            {
                read[*k] = true;
            }
        }
        read
    }

    fn name_inputs(
        &mut self,
        g: &Graph,
        only: &[bool],
        reachable: &[bool],
        constants: &mut Constants,
    ) {
        let mut angles: BTreeMap<Expr, (bool, bool)> = BTreeMap::new();
        for node in (0..g.nodes().len()).filter(|node| reachable[*node]) {
            match g.nodes()[node] {
                Node::Number(_) => {}
                _ if only[node] => {
                    let field = constants.field(g, node, g.name_of(node));
                    self.names.insert(node, format!("constants.{field}"));
                    self.constants.push(field);
                }
                Node::Sin(angle) => angles.entry(angle).or_default().0 = true,
                Node::Cos(angle) => angles.entry(angle).or_default().1 = true,
                Node::Symbol(s) => match g.symbol_of(s) {
                    Symbol::Joint(joint) => self.plain(node, Plain::Joint(*joint)),
                    Symbol::Side(joint) => self.plain(node, Plain::Side(*joint)),
                    Symbol::Growth => self.plain(node, Plain::Growth),
                    Symbol::Displacement { place, component } => {
                        self.names.insert(node, format!("{}{place}", COMPONENTS[*component]));
                    }
                    Symbol::Wrench(k) => drop(self.names.insert(node, WRENCH[*k].to_string())),
                    Symbol::Deflection { joint, weights } => {
                        let prefix = if *weights { "dqg" } else { "dq" };
                        self.names.insert(node, format!("{prefix}{}", joint + 1));
                    }
                    Symbol::Parameter(_) | Symbol::Warming => {}
                },
                _ => {}
            }
        }
        self.plain.sort_unstable();
        for sum in angles.keys().copied() {
            self.name_offsets(g, sum, only, constants);
        }
        let mut sums: Vec<(Expr, (bool, bool))> = angles.into_iter().collect();
        sums.sort_by_key(|(sum, _)| (last_joint(g, *sum), *sum));
        let mut taken = HashSet::new();
        for (sum, (sine, cosine)) in sums {
            let mut suffix = name(g, sum);
            while !taken.insert(suffix.clone()) {
                suffix.push('o');
            }
            self.angles.push(Angle { sum, suffix, sine, cosine });
        }
        for node in (0..g.nodes().len()).filter(|node| reachable[*node] && !only[*node]) {
            let (letter, angle) = match g.nodes()[node] {
                Node::Sin(angle) => ("s", angle),
                Node::Cos(angle) => ("c", angle),
                _ => continue,
            };
            if let Some(known) = self.angles.iter().find(|a| a.sum == angle) {
                self.names.insert(node, format!("{letter}{}", known.suffix));
            }
        }
    }

    fn plain(&mut self, node: usize, plain: Plain) {
        self.names.insert(node, plain.field());
        self.plain.push(plain);
    }

    /// Symbolic offsets inside an angle become constants too.
    fn name_offsets(&mut self, g: &Graph, sum: Expr, only: &[bool], constants: &mut Constants) {
        let mut stack = vec![sum.node()];
        while let Some(node) = stack.pop() {
            match g.nodes()[node] {
                Node::Number(_) => {}
                _ if only[node] => {
                    let field = constants.field(g, node, g.name_of(node));
                    self.names.insert(node, format!("constants.{field}"));
                }
                computed => stack.extend(computed.operands().map(Expr::node)),
            }
        }
    }

    fn name_bindings(&mut self, g: &Graph) {
        let mut taken: HashSet<String> = self.names.values().cloned().collect();
        taken.extend(RESERVED.map(str::to_string));
        taken.extend(WRENCH.map(str::to_string));
        let mut anonymous = 0;
        for step in &self.schedule.steps {
            let Binding::Let(node) = step else { continue };
            let wanted = g.name_of(*node).map(str::to_string).unwrap_or_else(|| {
                anonymous += 1;
                format!("t{anonymous}")
            });
            let mut name = wanted.clone();
            let mut k = 2;
            while !taken.insert(name.clone()) {
                name = format!("{wanted}_{k}");
                k += 1;
            }
            self.names.insert(*node, name);
        }
    }
}

/// Stores in the order of the outputs, each linear system just before the output that needs it.
fn items(program: &Program) -> (Vec<Item>, Vec<Target>) {
    let (mut items, mut targets) = (Vec::new(), Vec::new());
    let mut solved = vec![false; program.solves.len()];
    for (at, block) in program.blocks.iter().enumerate() {
        let used = program.graph.reachable(&block.entries);
        for (k, solve) in program.solves.iter().enumerate() {
            if !solved[k] && solve.unknowns.iter().any(|u| used[u.node()]) {
                solved[k] = true;
                let inputs = solve.matrix.iter().chain(&solve.right).copied().collect();
                items.push(Item::Solve { inputs, unknowns: solve.unknowns.clone() });
                targets.push(Target::Solve(k));
            }
        }
        for (entry, e) in block.entries.iter().enumerate().filter(|(_, e)| !e.is_zero()) {
            items.push(Item::Store(*e));
            targets.push(Target::Entry { block: at, entry });
        }
    }
    (items, targets)
}

fn is_input(g: &Graph, only: &[bool], node: usize) -> bool {
    only[node] || matches!(g.nodes()[node], Node::Symbol(_) | Node::Sin(_) | Node::Cos(_))
}

/// Nodes that are reached from the roots without entering inputs.
fn reachable_outside(g: &Graph, roots: &[Expr], only: &[bool]) -> Vec<bool> {
    let mut reached = vec![false; g.nodes().len()];
    roots.iter().for_each(|e| reached[e.node()] = true);
    for node in (0..reached.len()).rev() {
        if reached[node] && !is_input(g, only, node) {
            g.nodes()[node].operands().for_each(|o| reached[o.node()] = true);
        }
    }
    reached
}
