//! The posture: sines and cosines of all angles that any function of a module needs, and the displacements
//! of prismatic joints. One struct for all functions, so that a control loop makes it once.

use super::expression::Style;
use super::plan::Plan;
use crate::expr::{Expr, Node, Symbol};
use crate::robot::{Motion, Robot};

/// Fields of the posture: all of them, or what one function needs.
#[derive(Default)]
pub(super) struct Posture {
    pub angles: Vec<Pair>,
    pub plain: Vec<Plain>,
}

/// What is a field as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Plain {
    /// The value of a joint: of a prismatic one its displacement.
    Joint(usize),
    /// From which side a joint came.
    Side(usize),
    /// What all lengths are of those of the table.
    Growth,
}

impl Plain {
    /// The field.
    pub fn field(self) -> String {
        match self {
            Plain::Joint(joint) => format!("q{}", joint + 1),
            Plain::Side(joint) => format!("side{}", joint + 1),
            Plain::Growth => "growth".to_string(),
        }
    }

    /// Where it comes from.
    pub fn source(self) -> String {
        match self {
            Plain::Joint(joint) => format!("q[{joint}]"),
            Plain::Side(joint) => format!("sides[{joint}]"),
            Plain::Growth => "growth".to_string(),
        }
    }

    /// What it is, behind where it comes from.
    pub fn meaning(self, robot: &Robot) -> &'static str {
        match self {
            Plain::Joint(joint) => match robot.joints[joint].motion {
                Motion::Revolute => "rad",
                Motion::Prismatic => "m",
            },
            Plain::Side(_) => "-1, 0 or 1",
            Plain::Growth => "what all lengths are of those of the table",
        }
    }
}

/// The sine and the cosine of one angle.
#[derive(Clone)]
pub(super) struct Pair {
    /// The angle in terms of `q`.
    pub sum: String,
    /// What stands behind `s` and `c`.
    pub suffix: String,
    pub sine: bool,
    pub cosine: bool,
}

/// What one function takes of the posture.
pub(super) struct Needs {
    pub posture: Posture,
    /// What the function calls a field, and the field.
    pub reads: Vec<(String, String)>,
}

impl Posture {
    /// Takes in what a function needs and tells what it reads.
    pub fn admit(&mut self, plan: &Plan, style: &dyn Style) -> Needs {
        let mut needs = Needs { posture: Posture::default(), reads: Vec::new() };
        for angle in &plan.angles {
            let sum = sum(plan, angle.sum, style);
            let (sine, cosine) = (angle.sine, angle.cosine);
            let suffix = self.admit_angle(&sum, &angle.suffix, (sine, cosine));
            let pair = Pair { sum, suffix, sine, cosine };
            let read = |field: String| (format!("{}{}", &field[..1], angle.suffix), field);
            needs.reads.extend(pair.fields().map(read));
            needs.posture.angles.push(pair);
        }
        for &plain in &plan.plain {
            self.admit_plain(plain);
            needs.posture.plain.push(plain);
            needs.reads.push((plain.field(), plain.field()));
        }
        needs
    }

    fn admit_angle(&mut self, sum: &str, wanted: &str, (sine, cosine): (bool, bool)) -> String {
        if let Some(known) = self.angles.iter_mut().find(|pair| pair.sum == sum) {
            (known.sine, known.cosine) = (known.sine || sine, known.cosine || cosine);
            return known.suffix.clone();
        }
        let mut suffix = wanted.to_string();
        while self.angles.iter().any(|pair| pair.suffix == suffix) {
            suffix.push('o');
        }
        self.angles.push(Pair { sum: sum.to_string(), suffix: suffix.clone(), sine, cosine });
        suffix
    }

    /// Takes in what is a field as it is.
    pub fn admit_plain(&mut self, plain: Plain) {
        if !self.plain.contains(&plain) {
            self.plain.push(plain);
            self.plain.sort_unstable();
        }
    }

    /// The names of the fields, angle by angle, then what is one as it is.
    pub fn fields(&self) -> Vec<String> {
        let pairs = self.angles.iter().flat_map(Pair::fields);
        pairs.chain(self.plain.iter().map(|plain| plain.field())).collect()
    }
}

impl Pair {
    /// The fields of those that are needed.
    pub fn fields(&self) -> impl Iterator<Item = String> {
        let each = [(self.sine, "s"), (self.cosine, "c")].into_iter();
        each.filter(|(needed, _)| *needed).map(|(_, letter)| format!("{letter}{}", self.suffix))
    }
}

/// An angle in terms of `q` and the constants.
fn sum(plan: &Plan, sum: Expr, style: &dyn Style) -> String {
    let g = &plan.program.graph;
    let named = |e: Expr| style.name(plan.name(e.node()).unwrap_or_default());
    let term = |e: Expr| match g.node(e) {
        Node::Number(n) => style.number(n),
        Node::Symbol(s) => match g.symbol_of(s) {
            Symbol::Joint(joint) => format!("q[{joint}]"),
            _ => named(e),
        },
        _ => named(e),
    };
    let mut text = String::new();
    for e in g.terms(sum) {
        text.push_str(match (text.is_empty(), e.is_negative()) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        });
        text.push_str(&term(e.abs()));
    }
    text
}
