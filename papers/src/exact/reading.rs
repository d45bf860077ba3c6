//! Expressions of the generator's graph as values of another kind: residues, polynomials, a paper's
//! own formulas.

use num_rational::Ratio;
use stiffarm_codegen::expr::{Expr, Graph, Node, Symbol};
use stiffarm_codegen::number::Number;

use super::arithmetic::Arithmetic;
use crate::latex::tree::{Angle, Function};

/// What stands for the joints and the wrench of a robot's graph in a paper's notation.
#[derive(Clone, Debug, Default)]
pub struct Reading<V> {
    /// The angle of each joint.
    pub joints: Vec<Angle>,
    /// The wrench on the tool; zero where it is not given.
    pub wrench: Vec<V>,
}

impl<V: Clone> Reading<V> {
    /// The values of some expressions of a graph.
    ///
    /// # Errors
    /// Why one has none.
    pub fn values<A: Arithmetic<Value = V>>(
        &self,
        to: &A,
        graph: &Graph,
        outputs: &[Expr],
    ) -> Result<Vec<V>, A::Error> {
        let used = graph.reachable(outputs);
        let mut values: Vec<Option<V>> = vec![None; used.len()];
        for at in (0..used.len()).filter(|at| used[*at]) {
            values[at] = Some(self.node(to, graph, graph.nodes()[at], &values)?);
        }
        outputs.iter().map(|e| signed(to, &values, *e)).collect()
    }

    fn node<A: Arithmetic<Value = V>>(
        &self,
        to: &A,
        graph: &Graph,
        node: Node,
        values: &[Option<V>],
    ) -> Result<V, A::Error> {
        let of = |e: Expr| signed(to, values, e);
        let trig = |function, of| to.trig(function, &self.sum(graph, of)?);
        match node {
            Node::Number(Number::Exact(n)) => to.number(n),
            Node::Number(Number::Rounded(_)) => Err("a rounded constant has no exact form".into()),
            Node::Symbol(s) => match graph.symbol_of(s) {
                Symbol::Wrench(k) => {
                    self.wrench.get(*k).cloned().map_or_else(|| to.number(Ratio::from(0)), Ok)
                }
                other => to.named(&self.angle(other).ok_or(UNNAMED)?.to_string()),
            },
            Node::Add(a, b) => to.add(of(a)?, of(b)?),
            Node::Mul(a, b) => to.mul(of(a)?, of(b)?),
            Node::Recip(a) => to.div(to.number(Ratio::from(1))?, of(a)?),
            Node::Sqrt(a) => to.sqrt(of(a)?),
            Node::Sign(_) | Node::Select(..) => {
                Err("a choice by the sign of a quantity has no exact form".into())
            }
            Node::Atan2(..) => Err("the angle of a direction has no exact form".into()),
            Node::Sin(a) => trig(Function::Sin, a),
            Node::Cos(a) => trig(Function::Cos, a),
        }
    }

    /// A symbol as an angle; a prismatic joint's coordinate is a length of its own name.
    fn angle(&self, symbol: &Symbol) -> Option<Angle> {
        Some(match symbol {
            Symbol::Parameter(name) => Angle::single(name),
            Symbol::Joint(joint) => match self.joints.get(*joint) {
                Some(angle) => angle.clone(),
                None => Angle::single(&format!("q{}", joint + 1)),
            },
            // The notation of Jweeg & Al-Khafaji: `\delta x_1`, `d\phi_1`.
            Symbol::Displacement { place, component } => {
                let names = ["deltax", "deltay", "deltaz", "dpsi", "dbeta", "dphi"];
                Angle::single(&format!("{}{place}", names[*component]))
            }
            _ => return None,
        })
    }

    /// An expression as a whole-number combination of angles.
    fn sum(&self, graph: &Graph, e: Expr) -> Result<Angle, &'static str> {
        let mut sum = Angle::default();
        for term in graph.terms(e) {
            let (times, angle) = match graph.node(term) {
                Node::Symbol(s) => (1, self.angle(graph.symbol_of(s)).ok_or(UNNAMED)?),
                Node::Mul(a, b) => match graph.number_of(a) {
                    Some(Number::Exact(n)) if n.is_integer() && n.numer().abs() < 1000 => {
                        (*n.numer() as i64, self.sum(graph, b)?)
                    }
                    _ => return Err(NO_ANGLE),
                },
                _ => return Err(NO_ANGLE),
            };
            let times = if term.is_negative() { -times } else { times };
            angle.terms().for_each(|(name, k)| sum.add(name, k * times));
        }
        Ok(sum)
    }
}

const UNNAMED: &str = "a quantity that no paper's notation names";
const NO_ANGLE: &str = "an angle that is no sum of angles";

fn signed<A: Arithmetic>(
    to: &A,
    values: &[Option<A::Value>],
    e: Expr,
) -> Result<A::Value, A::Error> {
    let value = values[e.node()].clone().ok_or("an operand stands behind its use")?;
    if e.is_negative() { to.sub(to.number(Ratio::from(0))?, value) } else { Ok(value) }
}
