//! The plan of one function: what enters it, in which order it computes, and what everything is
//! called. All printers work from the same plan.

use std::collections::{BTreeMap, HashMap, HashSet};

use stiffarm_kernels::Input;

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
    /// Angles of the posture whose sine or cosine enters, in the order of the joints.
    pub angles: Vec<Angle>,
    /// Angles that the function takes sines and cosines of itself, by the item of the schedule.
    pub own_angles: Vec<Vec<Angle>>,
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
    /// Sines and cosines of own angles.
    Angles(usize),
}

/// What a function is given beside the posture.
pub(super) struct Argument {
    pub name: String,
    /// How many numbers; `None` is one by itself.
    pub size: Option<usize>,
    pub of: Given,
}

/// Whose an argument is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Given {
    /// The arm's.
    Arm(Input),
    /// One's own: which one.
    Own(usize),
}

/// Names of the wrench's components.
const WRENCH: [&str; 6] = ["fx", "fy", "fz", "mx", "my", "mz"];

/// The name of a number of an input.
pub(super) fn component(input: Input, k: usize) -> String {
    match input {
        Input::Wrench => WRENCH[k].to_string(),
        of_joints => format!("{}{}", of_joints.name(), k + 1),
    }
}

/// Names that generated functions use for other things.
const RESERVED: [&str; 8] = ["out", "posture", "constants", "live", "zero", "status", "fn", "as"];

impl<'p> Plan<'p> {
    /// Plans the function that computes all of `program`; parameter-only values go to `constants`.
    pub fn new(program: &'p Program, constants: &mut Constants) -> Self {
        let g = &program.graph;
        let only = constants.hoisted(g);
        let own_angles = own_angles(g, &program.roots(), &only);
        let (items, targets) = items(program, &own_angles);
        let reachable = reachable_outside(g, &program.roots(), &only);
        let mut plan = Plan {
            program,
            schedule: g.schedule(&items, |node| is_input(g, &only, node)),
            targets,
            angles: Vec::new(),
            own_angles,
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
        let wrench = |argument: &Argument| argument.of == Given::Arm(Input::Wrench);
        let read = self.arguments().iter().any(|argument| wrench(argument) && self.reads(argument));
        self.program.solves[k].margin.filter(|_| read)
    }

    /// What the function is given beside the posture.
    pub fn arguments(&self) -> Vec<Argument> {
        let (program, n) = (self.program, self.program.dof);
        let of_arm = program.inputs().filter(|input| *input != Input::Joints).map(|input| {
            let size = Some(input.side().count(n));
            Argument { name: input.name().to_string(), size, of: Given::Arm(input) }
        });
        let own = program.own.iter().flat_map(|own| &own.inputs).enumerate();
        let own = own.map(|(k, input)| Argument {
            name: input.name.clone(),
            size: input.size,
            of: Given::Own(k),
        });
        of_arm.chain(own).collect()
    }

    /// Which numbers of an argument are among some nodes.
    pub fn read<'n>(
        &self,
        argument: &Argument,
        among: impl IntoIterator<Item = &'n usize>,
    ) -> Vec<bool> {
        let g = &self.program.graph;
        let mut read = vec![false; argument.size.unwrap_or(1)];
        for node in among {
            let Node::Symbol(s) = g.nodes()[*node] else { continue };
            let given = match g.symbol_of(s) {
                Symbol::Own { input, entry } => Some((Given::Own(*input), *entry)),
                symbol => symbol.input().map(|(input, k)| (Given::Arm(input), k)),
            };
            if let Some((of, k)) = given
                && of == argument.of
            {
                read[k] = true;
            }
        }
        read
    }

    /// What the text calls a number of an argument.
    pub fn entry(&self, argument: &Argument, k: usize) -> String {
        match (argument.of, &self.program.own) {
            (Given::Arm(input), _) => component(input, k),
            (Given::Own(which), Some(own)) => own.inputs[which].entry(k),
            (Given::Own(_), None) => argument.name.clone(),
        }
    }

    /// Every node that has a name.
    pub fn named(&self) -> impl Iterator<Item = &usize> {
        self.names.keys()
    }

    /// Whether anything of an argument is read.
    pub fn reads(&self, argument: &Argument) -> bool {
        self.read(argument, self.named()).contains(&true)
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
                    Symbol::Rate(_)
                    | Symbol::Acceleration(_)
                    | Symbol::Torque(_)
                    | Symbol::Wrench(_) => {
                        let named = g.symbol_of(s).input().map(|(input, k)| component(input, k));
                        self.names.extend(named.map(|name| (node, name)));
                    }
                    Symbol::Deflection { joint, weights } => {
                        let prefix = if *weights { "dqg" } else { "dq" };
                        self.names.insert(node, format!("{prefix}{}", joint + 1));
                    }
                    Symbol::Own { input, entry } => {
                        let name = self.program.own.as_ref().map(|own| &own.inputs[*input]);
                        self.names.extend(name.map(|input| (node, input.entry(*entry))));
                    }
                    Symbol::Parameter(_) | Symbol::Warming => {}
                },
                _ => {}
            }
        }
        self.plain.sort_unstable();
        for angle in self.own_angles.iter().flatten() {
            angles.remove(&angle.sum);
        }
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
            self.angles.push(Angle { sum, suffix, sine, cosine, nodes: [None; 2] });
        }
        for node in (0..g.nodes().len()).filter(|node| reachable[*node] && !only[*node]) {
            let (letter, angle) = match g.nodes()[node] {
                Node::Sin(angle) => ("s", angle),
                Node::Cos(angle) => ("c", angle),
                _ => continue,
            };
            let mut all = self.angles.iter().chain(self.own_angles.iter().flatten());
            if let Some(known) = all.find(|a| a.sum == angle) {
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
        taken.extend(Input::EACH.map(|input| input.name().to_string()));
        taken.extend(WRENCH.map(str::to_string));
        let own = self.program.own.iter().flat_map(|own| &own.inputs);
        taken.extend(own.map(|input| input.name.clone()));
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

/// Own sines and cosines, then stores in the order of the outputs, each linear system just before the output that
/// needs it.
fn items(program: &Program, own_angles: &[Vec<Angle>]) -> (Vec<Item>, Vec<Target>) {
    let (mut items, mut targets) = (Vec::new(), Vec::new());
    for (k, angles) in own_angles.iter().enumerate() {
        let inputs = angles.iter().map(|angle| angle.sum).collect();
        let unknowns = angles.iter().flat_map(|a| a.nodes.into_iter().flatten()).collect();
        items.push(Item::Solve { inputs, unknowns });
        targets.push(Target::Angles(k));
    }
    let mut solved = vec![false; program.solves.len()];
    for (at, block) in program.blocks.iter().enumerate() {
        let used = program.graph.reachable(&block.entries);
        for (k, solve) in program.solves.iter().enumerate() {
            if !solved[k] && solve.unknowns.iter().any(|u| used[u.node()]) {
                solved[k] = true;
                let inputs = solve.inputs().copied().collect();
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

/// Nodes that are reached from the roots without entering inputs of the function.
fn reachable_outside(g: &Graph, roots: &[Expr], only: &[bool]) -> Vec<bool> {
    let mut reached = vec![false; g.nodes().len()];
    roots.iter().for_each(|e| reached[e.node()] = true);
    for node in (0..reached.len()).rev() {
        if reached[node] && (!is_input(g, only, node) || own_angle(g, only, node).is_some()) {
            g.nodes()[node].operands().for_each(|o| reached[o.node()] = true);
        }
    }
    reached
}

/// The angle of a sine or cosine that is not the posture's.
fn own_angle(g: &Graph, only: &[bool], node: usize) -> Option<Expr> {
    match g.nodes()[node] {
        Node::Sin(angle) | Node::Cos(angle) if !only[node] => {
            (!g.is_of_posture(angle, only)).then_some(angle)
        }
        _ => None,
    }
}

/// The angles that are not the posture's: first those that no other enters, then those that only these enter, and so
/// on, so that each lot is taken at once.
fn own_angles(g: &Graph, roots: &[Expr], only: &[bool]) -> Vec<Vec<Angle>> {
    let reached = reachable_outside(g, roots, only);
    let mut lots: Vec<Vec<Angle>> = Vec::new();
    // How many lots have to be taken before a node.
    let mut depth = vec![0; reached.len()];
    let mut count = 0;
    for node in (0..reached.len()).filter(|node| reached[*node]) {
        depth[node] = g.nodes()[node].operands().map(|o| depth[o.node()]).max().unwrap_or(0);
        let Some(sum) = own_angle(g, only, node) else { continue };
        let lot = depth[sum.node()];
        depth[node] = lot + 1;
        lots.resize_with(lots.len().max(lot + 1), Vec::new);
        let known = lots[lot].iter().position(|angle| angle.sum == sum);
        let at = known.unwrap_or_else(|| {
            count += 1;
            let suffix = format!("a{count}");
            lots[lot].push(Angle { sum, suffix, sine: false, cosine: false, nodes: [None; 2] });
            lots[lot].len() - 1
        });
        let angle = &mut lots[lot][at];
        let sine = matches!(g.nodes()[node], Node::Sin(_));
        *(if sine { &mut angle.sine } else { &mut angle.cosine }) = true;
        angle.nodes[usize::from(!sine)] = Some(Expr::of_node(node));
    }
    lots
}
