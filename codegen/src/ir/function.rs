//! One function: what enters it, and what it does, statement by statement.

use stiffarm_kernels::{Input, Output};

use super::Angle;
use super::constants::Constants;
use super::lower::Lowering;
use super::naming::{Naming, OwnAngle, component};
use super::posture::{Plain, Posture};
use super::schedule::{Binding, Item, schedule};
use super::statement::{Solve, Statement, read};
use super::term::Name;
use crate::derive::{Block, Own, Program};
use crate::expr::{Expr, Graph, Node};

/// A function of one output, of those of `all`, or of one's own.
#[derive(Clone, Debug)]
pub(crate) struct Function {
    pub program: Program,
    /// The frame or marker that it is of; `None` is the tool.
    pub place: Option<String>,
    /// What it is given beside the posture.
    pub arguments: Vec<Argument>,
    pub body: Vec<Statement>,
    /// Angles of the posture whose sine or cosine enters, in the order of the joints.
    pub angles: Vec<Angle>,
    /// What enters as it is: displacements of prismatic joints, sides, growth.
    pub plain: Vec<Plain>,
    /// Whether it reads constants.
    pub constants: bool,
    /// Sign changes that cost an operation of their own.
    pub negations: u32,
    /// What it needs of the module's posture.
    pub posture: Posture,
    /// What it calls a field of the posture, and the field.
    pub reads: Vec<(Name, Name)>,
}

/// What a function is given beside the posture.
#[derive(Clone, Debug)]
pub(crate) struct Argument {
    pub name: String,
    /// How many numbers; `None` is one by itself.
    pub size: Option<usize>,
    pub of: Given,
    /// What the text calls each of them.
    pub entries: Vec<Name>,
    /// Which of them are read.
    pub read: Vec<bool>,
}

/// Whose an argument is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Given {
    /// The arm's.
    Arm(Input),
    /// One's own.
    Own,
}

impl Argument {
    pub fn is_read(&self) -> bool {
        self.read.contains(&true)
    }
}

impl Function {
    /// The function that computes all of `program`; parameter-only values go to `constants`.
    pub fn new(program: Program, constants: &mut Constants, fused: bool) -> Self {
        let g = &program.graph;
        let roots = program.roots();
        let only = constants.hoisted(g);
        let reached = reachable_outside(g, &roots, &only);
        let own_angles = own_angles(g, &reached, &only);
        let mut naming = Naming::new(&program, &own_angles, (&only, &reached), constants);
        let (items, targets) = items(&program, &own_angles);
        let steps = schedule(g, &items, |node| is_input(g, &only, node));
        let mut arguments = arguments(&program);
        naming.bindings(g, &steps, &arguments);
        let lowering = Lowering { graph: g, names: &naming.names, fused };
        let lowered =
            Lowered { program: &program, naming: &naming, lowering, own_angles: &own_angles };
        let body: Vec<Statement> =
            steps.into_iter().filter_map(|step| lowered.statement(step, &targets)).collect();
        let negations = roots.iter().map(|e| lowered.lowering.negations(*e)).sum();
        let Naming { angles, plain, constants, .. } = naming;
        let (place, posture, reads) = (None, Posture::default(), Vec::new());
        let names = read(&body);
        for argument in &mut arguments {
            argument.read = argument.entries.iter().map(|name| names.contains(&**name)).collect();
        }
        let loaded = |a: &Argument| a.of == Given::Arm(Input::Wrench) && a.is_read();
        let loaded = arguments.iter().any(loaded);
        let body = body.into_iter().map(|step| match step {
            Statement::Solve(solve) => {
                Statement::Solve(Solve { margin: solve.margin.filter(|_| loaded), ..solve })
            }
            step => step,
        });
        let body = body.collect();
        Function {
            program,
            place,
            arguments,
            body,
            angles,
            plain,
            constants,
            negations,
            posture,
            reads,
        }
    }

    /// What it computes, result by result.
    pub fn blocks(&self) -> &[Block] {
        &self.program.blocks
    }

    /// What it says of itself, where it is one's own.
    pub fn own(&self) -> Option<&Own> {
        self.program.own.as_ref()
    }

    /// The output's name, or `all`, or its own.
    pub fn name(&self) -> &str {
        match (self.own(), self.blocks()) {
            (Some(own), _) => &own.name,
            (None, [block]) => block.held.name(),
            _ => "all",
        }
    }

    /// The same where the functions of all places stand together: `at_elbow_jacobian`.
    pub fn full_name(&self) -> String {
        match &self.place {
            Some(place) => format!("at_{place}_{}", self.name()),
            None => self.name().to_owned(),
        }
    }

    /// The arm's outputs that it computes.
    pub fn outputs(&self) -> impl Iterator<Item = Output> {
        self.blocks().iter().filter_map(|block| block.held.output())
    }

    pub fn fallible(&self) -> bool {
        self.outputs().any(Output::is_fallible)
    }

    pub fn solves(&self) -> impl Iterator<Item = &Solve> {
        self.body.iter().filter_map(|step| match step {
            Statement::Solve(solve) => Some(solve),
            _ => None,
        })
    }

    /// Whether all that it computes is structurally zero.
    pub fn is_zero(&self) -> bool {
        self.blocks().iter().flat_map(|block| &block.entries).all(|e| e.is_zero())
    }

    /// Block and entry of what is structurally zero.
    pub fn zeros(&self) -> impl Iterator<Item = (usize, usize)> {
        self.blocks().iter().enumerate().flat_map(|(at, block)| {
            let zeros = block.entries.iter().enumerate().filter(|(_, e)| e.is_zero());
            zeros.map(move |(entry, _)| (at, entry))
        })
    }
}

/// What it is given beside the posture; what of it is read is not known yet.
fn arguments(program: &Program) -> Vec<Argument> {
    let of_arm = program.inputs().filter(|input| *input != Input::Joints).map(|input| {
        let size = input.side().count(program.dof);
        let entries = (0..size).map(|k| component(input, k).into()).collect();
        let (name, of) = (input.name().to_string(), Given::Arm(input));
        Argument { name, size: Some(size), of, entries, read: Vec::new() }
    });
    let own = program.own.iter().flat_map(|own| &own.inputs).map(|input| {
        let entries = (0..input.size.unwrap_or(1)).map(|k| input.entry(k).into()).collect();
        let name = input.name.clone();
        Argument { name, size: input.size, of: Given::Own, entries, read: Vec::new() }
    });
    of_arm.chain(own).collect()
}

/// What an item of the schedule stands for.
enum Target {
    /// Entry `entry` of block `block`.
    Entry { block: usize, entry: usize },
    /// Linear system number `0`.
    Solve(usize),
    /// Sines and cosines of own angles.
    Angles(usize),
}

/// What statements are made from.
struct Lowered<'a> {
    program: &'a Program,
    naming: &'a Naming,
    lowering: Lowering<'a>,
    own_angles: &'a [Vec<OwnAngle>],
}

impl Lowered<'_> {
    fn statement(&self, step: Binding, targets: &[Target]) -> Option<Statement> {
        Some(match step {
            Binding::Let(node) => {
                Statement::Let(self.naming.local(node)?, self.lowering.definition(node))
            }
            Binding::Item(item) => match targets[item] {
                Target::Entry { block, entry } => {
                    let value = self.lowering.term(self.program.blocks[block].entries[entry]);
                    Statement::Store { block, entry, value }
                }
                Target::Solve(k) => Statement::Solve(self.solve(k)),
                Target::Angles(k) => {
                    let angles = self.own_angles[k].iter();
                    let lowered = angles.map(|angle| angle.lowered(self.lowering.term(angle.sum)));
                    Statement::SinCos(lowered.collect())
                }
            },
        })
    }

    fn solve(&self, k: usize) -> Solve {
        let solve = &self.program.solves[k];
        let terms = |e: &[Expr]| e.iter().map(|e| self.lowering.term(*e)).collect();
        let unknowns = solve.unknowns.iter().map(|e| self.naming.local(e.node()));
        Solve {
            matrix: terms(&solve.matrix),
            right: terms(&solve.right),
            unknowns: unknowns.collect(),
            leading: solve.leading(),
            margin: solve.margin,
            of_motion: solve.output.is_of_motion(),
        }
    }
}

/// Own sines and cosines, then stores in the order of the outputs, each linear system just before the output that
/// needs it.
fn items(program: &Program, own_angles: &[Vec<OwnAngle>]) -> (Vec<Item>, Vec<Target>) {
    let (mut items, mut targets) = (Vec::new(), Vec::new());
    for (k, angles) in own_angles.iter().enumerate() {
        items.push(Item::Solve(angles.iter().map(|angle| angle.sum).collect()));
        targets.push(Target::Angles(k));
    }
    let mut solved = vec![false; program.solves.len()];
    for (at, block) in program.blocks.iter().enumerate() {
        let used = program.graph.reachable(&block.entries);
        for (k, solve) in program.solves.iter().enumerate() {
            if !solved[k] && solve.unknowns.iter().any(|u| used[u.node()]) {
                solved[k] = true;
                items.push(Item::Solve(solve.inputs().copied().collect()));
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
fn own_angles(g: &Graph, reached: &[bool], only: &[bool]) -> Vec<Vec<OwnAngle>> {
    let mut lots: Vec<Vec<OwnAngle>> = Vec::new();
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
            lots[lot].push(OwnAngle { sum, suffix: format!("a{count}"), nodes: [None; 2] });
            lots[lot].len() - 1
        });
        let cosine = matches!(g.nodes()[node], Node::Cos(_));
        lots[lot][at].nodes[usize::from(cosine)] = Some(Expr::of_node(node));
    }
    lots
}
