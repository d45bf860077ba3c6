//! What an expression of the generator's graph is, exactly.

use std::collections::HashMap;

use num_rational::Ratio;
use num_traits::Zero;

use super::polynomial::Polynomial;
use super::rational::{Inexact, Rational};
use crate::latex::tree::{Angle, Function};
use stiffarm_codegen::expr::{Expr, Graph, Node, Symbol};
use stiffarm_codegen::number::Number;

/// What the symbols of a graph stand for in a paper's notation.
#[derive(Clone, Debug, Default)]
pub struct Reading {
    /// The angle of each joint.
    pub joints: Vec<Angle>,
    /// The wrench on the tool; zero where it is not given.
    pub wrench: Vec<Rational>,
    /// Parameters that stand for something else than a symbol of their own name.
    pub parameters: HashMap<String, Rational>,
}

impl Reading {
    /// The exact form of an expression of the graph.
    ///
    /// # Errors
    /// Why it has none.
    pub fn of(&self, graph: &Graph, e: Expr) -> Result<Rational, Inexact> {
        let used = graph.reachable(&[e]);
        let mut values: Vec<Option<Rational>> = vec![None; e.node() + 1];
        for at in 0..=e.node() {
            if used[at] && !self.only_angle(graph, at, &used, e.node()) {
                values[at] = Some(self.node(graph, at, &values)?);
            }
        }
        signed(&values, e)
    }

    fn node(
        &self,
        graph: &Graph,
        at: usize,
        values: &[Option<Rational>],
    ) -> Result<Rational, Inexact> {
        let of = |e: Expr| signed(values, e);
        match graph.nodes()[at] {
            Node::Number(Number::Exact(n)) => Ok(Rational::number(n)),
            Node::Number(Number::Rounded(_)) => Err(Inexact::Rounded),
            Node::Symbol(s) => self.symbol(graph.symbol_of(s)),
            Node::Add(a, b) => of(a)?.plus(&of(b)?, 1),
            Node::Mul(a, b) => of(a)?.times(&of(b)?),
            Node::Recip(a) => of(a)?.reciprocal(),
            Node::Sqrt(a) => of(a)?.root(),
            Node::Sign(_) => Err(Inexact::Rounded),
            Node::Sin(a) => self.trig(graph, Function::Sin, a),
            Node::Cos(a) => self.trig(graph, Function::Cos, a),
        }
    }

    fn symbol(&self, symbol: &Symbol) -> Result<Rational, Inexact> {
        match symbol {
            Symbol::Parameter(name) => Ok(match self.parameters.get(name) {
                Some(value) => value.clone(),
                None => Polynomial::symbol(name).into(),
            }),
            Symbol::Wrench(k) => {
                Ok(self.wrench.get(*k).cloned().unwrap_or_else(|| Rational::number(Ratio::zero())))
            }
            // A prismatic joint's coordinate is a length of its own name.
            Symbol::Joint(joint) => {
                let name = self.joints.get(*joint).map(ToString::to_string);
                Ok(Polynomial::symbol(&name.unwrap_or_else(|| format!("q{}", joint + 1))).into())
            }
            Symbol::Displacement { place, component } => {
                Ok(Polynomial::symbol(&displacement(*place, *component)).into())
            }
            // None of the papers' equations has these.
            Symbol::Deflection { .. }
            | Symbol::Rate(_)
            | Symbol::Acceleration(_)
            | Symbol::Torque(_)
            | Symbol::Side(_)
            | Symbol::Warming
            | Symbol::Growth
            | Symbol::Own { .. } => Err(Inexact::Root),
        }
    }

    fn trig(&self, graph: &Graph, function: Function, of: Expr) -> Result<Rational, Inexact> {
        let mut angle = Angle::default();
        self.collect(graph, of, 1, &mut angle)?;
        Ok(Polynomial::trig(function, &angle)?.into())
    }

    fn collect(&self, graph: &Graph, e: Expr, times: i64, into: &mut Angle) -> Result<(), Inexact> {
        let times = if e.is_negative() { -times } else { times };
        match graph.node(e) {
            Node::Symbol(s) => {
                match graph.symbol_of(s) {
                    Symbol::Joint(joint) => match self.joints.get(*joint) {
                        Some(angle) => angle.terms().for_each(|(n, k)| into.add(n, k * times)),
                        None => into.add(&format!("q{}", joint + 1), times),
                    },
                    Symbol::Parameter(name) => into.add(name, times),
                    Symbol::Displacement { place, component } => {
                        into.add(&displacement(*place, *component), times);
                    }
                    _ => return Err(Inexact::Rounded),
                }
                Ok(())
            }
            Node::Add(a, b) => {
                self.collect(graph, a, times, into)?;
                self.collect(graph, b, times, into)
            }
            _ => Err(Inexact::Rounded),
        }
    }

    /// Whether a node is used inside sines and cosines alone.
    fn only_angle(&self, graph: &Graph, at: usize, used: &[bool], last: usize) -> bool {
        at != last
            && matches!(graph.nodes()[at], Node::Add(..) | Node::Number(_))
            && (at + 1..=last).filter(|k| used[*k]).all(|k| {
                let node = graph.nodes()[k];
                let uses = node.operands().any(|o| o.node() == at);
                !uses || matches!(node, Node::Sin(_) | Node::Cos(_))
            })
    }
}

/// The name of a displacement in the notation of Jweeg & Al-Khafaji: `\delta x_1`, `d\phi_1`.
fn displacement(place: usize, component: usize) -> String {
    let names = ["deltax", "deltay", "deltaz", "dpsi", "dbeta", "dphi"];
    format!("{}{place}", names[component])
}

fn signed(values: &[Option<Rational>], e: Expr) -> Result<Rational, Inexact> {
    let value = values.get(e.node()).and_then(Option::as_ref).ok_or(Inexact::Rounded)?;
    if e.is_negative() { value.times(&Rational::number((-1).into())) } else { Ok(value.clone()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::evaluate::Arithmetic;
    use crate::exact::rational::Exact;
    use crate::latex::notation::Notation;
    use crate::latex::parser::parse;

    #[test]
    fn the_graph_and_the_formula_meet() {
        let mut g = Graph::new();
        let (x, y) = (g.symbol(Symbol::Joint(0)), g.symbol(Symbol::Joint(1)));
        let d = g.symbol(Symbol::Parameter("d2".into()));
        let sum = g.add(x, y);
        let s = g.sin(sum);
        let e = g.mul(d, s);
        let joints = vec![Angle::single("theta1"), Angle::single("theta2")];
        let printed = parse("-d_2\\sin(\\theta_1+\\theta_2)", &Notation::default()).unwrap();
        let reading = Reading { joints, ..Reading::default() };
        assert_eq!(reading.of(&g, -e).unwrap(), Exact(&HashMap::new()).tree(&printed).unwrap());
    }
}
