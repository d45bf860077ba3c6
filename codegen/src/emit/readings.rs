//! From readings to joint values, as text: the same operations in the same order in every language.

use super::expression::Style;
use crate::derive::Readings;
use crate::expr::{Expr, Node, Symbol};
use crate::robot::Robot;

/// What of a corrected arm stands between readings and the sines of its joint values.
pub(super) struct Stage {
    pub readings: Readings,
    /// Whether joint values are others than readings.
    pub moves: bool,
}

/// Arguments beside readings and load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extra {
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

impl Stage {
    pub fn of(robot: &Robot) -> Stage {
        let readings = Readings::of(robot);
        let moves = !readings.are_joints();
        Stage { readings, moves }
    }

    /// The arguments that the arm's functions take beside readings and load.
    pub fn extras(&self) -> Vec<Extra> {
        let each = [
            (self.readings.takes_sides, Extra::Sides),
            (self.readings.takes_warming, Extra::Warming),
        ];
        each.into_iter().filter(|(taken, _)| *taken).map(|(_, extra)| extra).collect()
    }

    /// The extras of `joints`' arguments that it reads.
    pub fn reads(&self, extra: Extra) -> bool {
        let g = &self.readings.graph;
        let used = g.reachable(&self.readings.joints);
        (0..used.len()).filter(|node| used[*node]).any(|node| match g.nodes()[node] {
            Node::Symbol(s) => match g.symbol_of(s) {
                Symbol::Side(_) => extra == Extra::Sides,
                Symbol::Warming => extra == Extra::Warming,
                _ => false,
            },
            _ => false,
        })
    }

    /// The angles whose sines and cosines enter, in the order in which they came about.
    pub fn angles(&self) -> Vec<Expr> {
        let g = &self.readings.graph;
        let used = g.reachable(&self.readings.joints);
        let mut angles = Vec::new();
        for node in (0..used.len()).filter(|node| used[*node]) {
            if let Node::Sin(angle) | Node::Cos(angle) = g.nodes()[node]
                && !angles.contains(&angle)
            {
                angles.push(angle);
            }
        }
        angles
    }

    /// What stands behind `s` and `c` for an angle: `2x3` for twice the reading of joint 3.
    pub fn suffix(&self, angle: Expr) -> String {
        let g = &self.readings.graph;
        let joint = |e: Expr| match g.node(e) {
            Node::Symbol(s) => match g.symbol_of(s) {
                Symbol::Joint(joint) => Some((joint + 1).to_string()),
                _ => None,
            },
            _ => None,
        };
        match g.node(angle) {
            Node::Mul(order, of) => {
                let order = g.number_of(order).map_or(0.0, |n| n.to_f64());
                format!("{order}x{}", joint(of).unwrap_or_default())
            }
            _ => joint(angle).unwrap_or_default(),
        }
    }

    /// What all lengths are of those of the table.
    pub fn growth(&self, style: &dyn Style) -> String {
        self.print(self.readings.growth, style)
    }

    /// An expression written out over `q`, `sides`, `warming`, and the sines and cosines of the angles.
    pub fn print(&self, e: Expr, style: &dyn Style) -> String {
        let inner = self.unsigned(e, style);
        match (e.is_negative(), self.readings.graph.node(e)) {
            (false, _) => inner,
            (true, Node::Number(n)) => style.number(-n),
            (true, Node::Add(..)) => format!("-{}", style.bracket(&inner)),
            (true, _) => format!("-{inner}"),
        }
    }

    fn unsigned(&self, e: Expr, style: &dyn Style) -> String {
        let g = &self.readings.graph;
        let factor = |e: Expr| match g.node(e) {
            Node::Add(..) => style.bracket(&self.print(e, style)),
            _ => self.print(e, style),
        };
        match g.node(e) {
            Node::Number(n) => style.number(n),
            Node::Symbol(s) => match g.symbol_of(s) {
                Symbol::Joint(joint) => format!("q[{joint}]"),
                Symbol::Side(joint) => format!("sides[{joint}]"),
                _ => "warming".to_string(),
            },
            Node::Sin(angle) => format!("s{}", self.suffix(angle)),
            Node::Cos(angle) => format!("c{}", self.suffix(angle)),
            Node::Mul(a, b) => style.product(&factor(a), &factor(b)),
            Node::Add(a, b) => {
                let (sign, right) = if b.is_negative() { ("-", -b) } else { ("+", b) };
                let right = match g.node(right) {
                    Node::Add(..) => style.bracket(&self.print(right, style)),
                    _ => self.print(right, style),
                };
                format!("{} {sign} {right}", self.print(a, style))
            }
            Node::Recip(a) => style.recip(&self.print(a, style)),
            Node::Sqrt(a) => style.sqrt(&self.print(a, style)),
            Node::Sign(a) => style.sign(&self.print(a, style)),
        }
    }
}
