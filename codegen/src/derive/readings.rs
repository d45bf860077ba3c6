//! From readings to joint values: what a controller believes, and where its joints are.

use num_traits::Float;

use crate::expr::{Expr, Graph, OpCount, Symbol, from};
use crate::number::Number;
use crate::robot::beyond::{Law, Move};
use crate::robot::{Motion, Robot};

/// The joint values of an arm whose readings are others, and how much larger it is than its table. The
/// joints of its graph are readings; those of every other graph are the values that it leads to.
#[derive(Clone, Debug)]
pub struct Readings {
    /// Its own graph.
    pub graph: Graph,
    /// Joint values, base to tip.
    pub joints: Vec<Expr>,
    /// What all lengths are of those of the table.
    pub growth: Expr,
    /// Whether the sides enter the arm's functions.
    pub takes_sides: bool,
    /// Whether the warming does.
    pub takes_warming: bool,
}

/// What is known of a posture beside readings and load.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Given {
    /// From which side each joint came to rest, −1, 0, 1; empty is 0 for all.
    pub sides: Vec<f64>,
    /// How much warmer the arm is than when it is as its table says, K.
    pub warming: f64,
    /// The elbow's angle, rad, where the inverse kinematics is given it; `None` is that of the readings.
    pub elbow_angle: Option<f64>,
}

impl Readings {
    /// Of an arm whose readings are its joint values, too.
    pub fn of(robot: &Robot) -> Readings {
        let (mut g, beyond) = (Graph::new(), &robot.beyond);
        let readings: Vec<Expr> = (0..robot.dof()).map(|j| g.symbol(Symbol::Joint(j))).collect();
        // What is small is summed first: a sum of a large and many small numbers rounds each time.
        let mut values = readings.clone();
        let mut small = vec![Expr::ZERO; robot.dof()];
        let mut growth = Expr::ONE;
        for each in &beyond.moves {
            let (joint, law) = match each {
                Move::Joint(joint, law) => (*joint, law),
                Move::Growth(expansion) => {
                    let (rate, warming) = (g.number(*expansion), g.symbol(Symbol::Warming));
                    let more = g.mul(rate, warming);
                    let grown = g.add(Expr::ONE, more);
                    growth = g.mul(growth, grown);
                    let slides = |j: &usize| robot.joints[*j].motion == Motion::Prismatic;
                    for j in (0..robot.dof()).filter(slides) {
                        let sum = g.add(values[j], std::mem::take(&mut small[j]));
                        values[j] = g.mul(grown, sum);
                    }
                    continue;
                }
            };
            let terms = match law {
                Law::Ratio(ratio) => vec![(*ratio, readings[joint])],
                Law::Coupling(other, ratio) => vec![(*ratio, readings[*other])],
                Law::Wave(order, [cos, sin]) => {
                    let order = g.number(Number::integer(*order as i128));
                    let angle = g.mul(order, readings[joint]);
                    let (s, c) = (g.sin(angle), g.cos(angle));
                    vec![(*cos, c), (*sin, s)]
                }
                Law::Backlash(width) => {
                    vec![(*width * Number::ratio(-1, 2), g.symbol(Symbol::Side(joint)))]
                }
                Law::Warming(rate) => vec![(*rate, g.symbol(Symbol::Warming))],
            };
            for (factor, of) in terms {
                let factor = g.number(factor);
                let product = g.mul(factor, of);
                small[joint] = g.add(small[joint], product);
            }
        }
        let joints = values.into_iter().zip(small).map(|(value, small)| g.add(value, small));
        let joints = joints.collect();
        let (takes_sides, takes_warming) = (beyond.takes_sides(), beyond.takes_warming());
        Readings { graph: g, joints, growth, takes_sides, takes_warming }
    }

    /// Whether every reading is the joint's value.
    pub fn are_joints(&self) -> bool {
        let own =
            |(j, e): (usize, &Expr)| self.graph.symbol_at(e.node()) == Some(&Symbol::Joint(j));
        self.joints.iter().enumerate().all(own)
    }

    /// Operations beyond sines and cosines.
    pub fn ops(&self) -> OpCount {
        self.graph.count(&self.joints)
    }

    /// The joint values at readings `q`, and what all lengths are of those of the table.
    pub fn evaluate<T: Float>(&self, q: &[T], given: &Given) -> (Vec<T>, T) {
        let outputs: Vec<Expr> = self.joints.iter().copied().chain([self.growth]).collect();
        let mut values = self.graph.evaluate(&outputs, |symbol| match symbol {
            Symbol::Joint(joint) => q[*joint],
            other => given.value(other),
        });
        let growth = values.pop().unwrap_or_else(T::one);
        (values, growth)
    }
}

impl Given {
    /// The number that a symbol of sides and warming stands for; 0 for another.
    pub(super) fn value<T: Float>(&self, symbol: &Symbol) -> T {
        from(match symbol {
            Symbol::Side(joint) => self.sides.get(*joint).copied().unwrap_or_default(),
            Symbol::Warming => self.warming,
            _ => 0.0,
        })
    }
}
