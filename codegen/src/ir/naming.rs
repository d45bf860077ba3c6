//! What the nodes of a function's graph are called: inputs first, then what the schedule binds.

use std::collections::{BTreeMap, HashMap, HashSet};

use stiffarm_kernels::Input;

use super::angle::{Angle, last_joint, name};
use super::constants::Constants;
use super::function::Argument;
use super::lower::Lowering;
use super::posture::Plain;
use super::schedule::Binding;
use super::term::{Name, Term};
use crate::derive::{COMPONENTS, Program};
use crate::expr::{Expr, Graph, Node, Symbol};

/// Names of the wrench's components.
const WRENCH: [&str; 6] = ["fx", "fy", "fz", "mx", "my", "mz"];

/// The name of a number of an input.
pub(crate) fn component(input: Input, k: usize) -> String {
    match input {
        Input::Wrench => WRENCH[k].to_string(),
        of_joints => format!("{}{}", of_joints.name(), k + 1),
    }
}

/// Names that generated functions use for other things.
const RESERVED: [&str; 8] = ["out", "posture", "constants", "live", "zero", "status", "fn", "as"];

/// Names of a program's nodes, and what of the joint values enters.
#[derive(Default)]
pub(super) struct Naming {
    pub names: HashMap<usize, Term>,
    /// Angles of the posture whose sine or cosine enters, in the order of the joints.
    pub angles: Vec<Angle>,
    /// What enters as it is: displacements of prismatic joints, sides, growth.
    pub plain: Vec<Plain>,
    /// Whether fields of the constants enter beside those in the angles.
    pub constants: bool,
}

/// An angle that is not the posture's, with the nodes of its sine and cosine.
pub(super) struct OwnAngle {
    pub sum: Expr,
    pub suffix: String,
    pub nodes: [Option<Expr>; 2],
}

impl OwnAngle {
    /// Its sines and cosines by name, where the sum is written down as `sum`.
    pub fn lowered(&self, sum: Term) -> Angle {
        let [sine, cosine] = self.nodes.map(|node| node.is_some());
        Angle { sum, suffix: self.suffix.clone(), sine, cosine }
    }
}

impl Naming {
    /// Names the inputs that are reached; `only` tells what depends on parameters alone.
    pub fn new(
        program: &Program,
        own_angles: &[Vec<OwnAngle>],
        (only, reached): (&[bool], &[bool]),
        constants: &mut Constants,
    ) -> Naming {
        let g = &program.graph;
        let mut naming = Naming::default();
        let mut angles: BTreeMap<Expr, [bool; 2]> = BTreeMap::new();
        for node in (0..g.nodes().len()).filter(|node| reached[*node]) {
            match g.nodes()[node] {
                Node::Number(_) => {}
                _ if only[node] => {
                    naming.constant(g, node, constants);
                    naming.constants = true;
                }
                Node::Sin(angle) => angles.entry(angle).or_default()[0] = true,
                Node::Cos(angle) => angles.entry(angle).or_default()[1] = true,
                Node::Symbol(s) => naming.symbol(program, node, g.symbol_of(s)),
                _ => {}
            }
        }
        naming.plain.sort_unstable();
        for angle in own_angles.iter().flatten() {
            angles.remove(&angle.sum);
        }
        for sum in angles.keys().copied() {
            naming.offsets(g, sum, only, constants);
        }
        naming.angles(g, angles);
        for angle in own_angles.iter().flatten() {
            for (node, letter) in angle.nodes.into_iter().zip(['s', 'c']) {
                let name = || Term::local(format!("{letter}{}", angle.suffix));
                naming.names.extend(node.map(|e| (e.node(), name())));
            }
        }
        naming
    }

    fn symbol(&mut self, program: &Program, node: usize, symbol: &Symbol) {
        let name = match symbol {
            Symbol::Joint(joint) => return self.plain(node, Plain::Joint(*joint)),
            Symbol::Side(joint) => return self.plain(node, Plain::Side(*joint)),
            Symbol::Growth => return self.plain(node, Plain::Growth),
            Symbol::Displacement { place, component } => {
                Some(format!("{}{place}", COMPONENTS[*component]))
            }
            Symbol::Rate(_) | Symbol::Acceleration(_) | Symbol::Torque(_) | Symbol::Wrench(_) => {
                symbol.input().map(|(input, k)| component(input, k))
            }
            Symbol::Response(joint) => Some(format!("ddq{}", joint + 1)),
            Symbol::Deflection { joint, weights } => {
                Some(format!("{}{}", if *weights { "dqg" } else { "dq" }, joint + 1))
            }
            Symbol::Own { input, entry } => {
                program.own.as_ref().map(|own| own.inputs[*input].entry(*entry))
            }
            Symbol::Parameter(_) | Symbol::Warming => None,
        };
        self.names.extend(name.map(|name| (node, Term::local(name))));
    }

    fn plain(&mut self, node: usize, plain: Plain) {
        self.names.insert(node, Term::Local(plain.field()));
        self.plain.push(plain);
    }

    fn constant(&mut self, g: &Graph, node: usize, constants: &mut Constants) {
        let field = constants.field(g, node, g.name_of(node));
        self.names.insert(node, Term::Constant(field));
    }

    /// Symbolic offsets inside an angle become constants too.
    fn offsets(&mut self, g: &Graph, sum: Expr, only: &[bool], constants: &mut Constants) {
        let mut stack = vec![sum.node()];
        while let Some(node) = stack.pop() {
            match g.nodes()[node] {
                Node::Number(_) => {}
                _ if only[node] => self.constant(g, node, constants),
                computed => stack.extend(computed.operands().map(Expr::node)),
            }
        }
    }

    /// Names sines and cosines of the posture's angles, each with whether the two are needed.
    fn angles(&mut self, g: &Graph, angles: BTreeMap<Expr, [bool; 2]>) {
        let mut sums: Vec<(Expr, [bool; 2])> = angles.into_iter().collect();
        sums.sort_by_key(|(sum, _)| (last_joint(g, *sum), *sum));
        let mut taken = HashSet::new();
        let mut suffixes = HashMap::new();
        for (sum, [sine, cosine]) in sums {
            let mut suffix = name(g, sum);
            while !taken.insert(suffix.clone()) {
                suffix.push('o');
            }
            suffixes.insert(sum, suffix.clone());
            let lowering = Lowering { graph: g, names: &self.names, fused: false };
            let sum = lowering.angle(sum);
            self.angles.push(Angle { sum, suffix, sine, cosine });
        }
        for (node, kind) in g.nodes().iter().enumerate() {
            let (letter, angle) = match kind {
                Node::Sin(angle) => ('s', angle),
                Node::Cos(angle) => ('c', angle),
                _ => continue,
            };
            let name = suffixes.get(angle).map(|suffix| Term::local(format!("{letter}{suffix}")));
            if !self.names.contains_key(&node) {
                self.names.extend(name.map(|name| (node, name)));
            }
        }
    }

    /// Names what the schedule binds, each name once.
    pub fn bindings(&mut self, g: &Graph, steps: &[Binding], arguments: &[Argument]) {
        let local = |term: &Term| match term {
            Term::Local(name) => Some(name.clone()),
            _ => None,
        };
        let mut taken: HashSet<Name> = self.names.values().filter_map(local).collect();
        taken.extend(RESERVED.into_iter().chain(WRENCH).map(Name::from));
        taken.extend(Input::EACH.map(|input| input.name().into()));
        taken.extend(arguments.iter().map(|argument| argument.name.as_str().into()));
        let mut anonymous = 0;
        for step in steps {
            let Binding::Let(node) = step else { continue };
            let wanted = g.name_of(*node).map(str::to_string).unwrap_or_else(|| {
                anonymous += 1;
                format!("t{anonymous}")
            });
            let mut name: Name = wanted.as_str().into();
            let mut k = 2;
            while !taken.insert(name.clone()) {
                name = format!("{wanted}_{k}").into();
                k += 1;
            }
            self.names.insert(*node, Term::Local(name));
        }
    }

    /// The name of a node that is a local.
    pub fn local(&self, node: usize) -> Option<Name> {
        match self.names.get(&node) {
            Some(Term::Local(name)) => Some(name.clone()),
            _ => None,
        }
    }
}
