//! From readings to joint values: what of a corrected arm stands before the sines of its joint values.

use std::collections::HashMap;

use super::angle::Angle;
use super::lower::Lowering;
use super::term::Term;
use crate::derive;
use crate::expr::{Expr, Graph, Node, OpCount, Symbol};
use crate::robot::Robot;

/// Joint values as terms over readings, sides and warming.
pub(crate) struct Readings {
    /// Whether joint values are others than readings.
    pub moves: bool,
    /// The arguments that the arm's functions take beside readings and load.
    pub extras: Vec<Extra>,
    /// Angles whose sines and cosines enter the joint values.
    pub angles: Vec<Angle>,
    /// Joint values, base to tip.
    pub joints: Vec<Term>,
    /// What all lengths are of those of the table.
    pub growth: Term,
    /// Operations of the joint values beyond sines and cosines.
    pub ops: OpCount,
}

/// Arguments beside readings and load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Extra {
    /// From which side each joint came.
    Sides,
    /// How warm the arm is.
    Warming,
}

impl Extra {
    /// The argument's name.
    pub fn name(self) -> &'static str {
        match self {
            Extra::Sides => "sides",
            Extra::Warming => "warming",
        }
    }

    /// What it is and in which unit.
    pub fn sentence(self) -> &'static str {
        match self {
            Extra::Sides => "from which side each joint came to rest: -1, 0 (unknown), 1",
            Extra::Warming => "how much warmer the arm is than when it is as its table says, in K",
        }
    }
}

impl Readings {
    /// The arguments beside readings as they are handed on: `, sides, warming`.
    pub fn handed_on(&self) -> String {
        self.extras.iter().map(|extra| format!(", {}", extra.name())).collect()
    }

    pub fn of(robot: &Robot) -> Readings {
        let readings = derive::Readings::of(robot);
        let g = &readings.graph;
        let extras =
            [(readings.takes_sides, Extra::Sides), (readings.takes_warming, Extra::Warming)];
        let mut names: HashMap<usize, Term> =
            (0..g.nodes().len()).filter_map(|node| Some((node, symbol(g, node)?))).collect();
        let mut sums: Vec<(Expr, Angle)> = Vec::new();
        let used = g.reachable(&readings.joints);
        for node in (0..used.len()).filter(|node| used[*node]) {
            let (Node::Sin(of) | Node::Cos(of)) = g.nodes()[node] else { continue };
            let at = sums.iter().position(|(known, _)| *known == of).unwrap_or_else(|| {
                let sum = Lowering { graph: g, names: &names, fused: false }.term(of);
                let angle = Angle { sum, suffix: suffix(g, of), sine: false, cosine: false };
                sums.push((of, angle));
                sums.len() - 1
            });
            let angle = &mut sums[at].1;
            let sine = matches!(g.nodes()[node], Node::Sin(_));
            *(if sine { &mut angle.sine } else { &mut angle.cosine }) = true;
            let letter = if sine { 's' } else { 'c' };
            names.insert(node, Term::local(format!("{letter}{}", angle.suffix)));
        }
        let lowering = Lowering { graph: g, names: &names, fused: false };
        Readings {
            moves: !readings.are_joints(),
            extras: extras.into_iter().filter(|(taken, _)| *taken).map(|(_, e)| e).collect(),
            angles: sums.into_iter().map(|(_, angle)| angle).collect(),
            joints: readings.joints.iter().map(|e| lowering.term(*e)).collect(),
            growth: lowering.term(readings.growth),
            ops: readings.ops(),
        }
    }

    /// Whether the joint values depend on what is given beside the readings.
    pub fn reads(&self, extra: Extra) -> bool {
        let is = |leaf: &Term| match (leaf, extra) {
            (Term::Entry(array, _), Extra::Sides) => *array == extra.name(),
            (Term::Local(name), Extra::Warming) => **name == *extra.name(),
            _ => false,
        };
        self.joints.iter().any(|joint| joint.any(is))
    }
}

fn symbol(g: &Graph, node: usize) -> Option<Term> {
    match g.symbol_at(node)? {
        Symbol::Joint(joint) => Some(Term::Entry("q", vec![*joint])),
        Symbol::Side(joint) => Some(Term::Entry(Extra::Sides.name(), vec![*joint])),
        Symbol::Warming => Some(Term::local(Extra::Warming.name())),
        _ => None,
    }
}

/// What stands behind `s` and `c` for an angle: `2x3` for twice the reading of joint 3.
fn suffix(g: &Graph, angle: Expr) -> String {
    let joint = |e: Expr| match symbol(g, e.node()) {
        Some(Term::Entry(_, at)) => (at[0] + 1).to_string(),
        _ => String::new(),
    };
    match g.node(angle) {
        Node::Mul(order, of) => {
            let order = g.number_of(order).map_or(0.0, |n| n.to_f64());
            format!("{order}x{}", joint(of))
        }
        _ => joint(angle),
    }
}
