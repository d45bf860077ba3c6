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
    pub prismatic: Vec<usize>,
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
        for &joint in &plan.prismatic {
            self.admit_displacement(joint);
            needs.posture.prismatic.push(joint);
            needs.reads.push((displacement(joint), displacement(joint)));
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

    /// Takes in the displacement of a joint, or the value of one that no angle needs.
    pub fn admit_displacement(&mut self, joint: usize) {
        if !self.prismatic.contains(&joint) {
            self.prismatic.push(joint);
            self.prismatic.sort_unstable();
        }
    }

    /// The names of the fields, angle by angle, then displacements.
    pub fn fields(&self) -> Vec<String> {
        let pairs = self.angles.iter().flat_map(Pair::fields);
        pairs.chain(self.prismatic.iter().map(|joint| displacement(*joint))).collect()
    }
}

impl Pair {
    /// The fields of those that are needed.
    pub fn fields(&self) -> impl Iterator<Item = String> {
        let each = [(self.sine, "s"), (self.cosine, "c")].into_iter();
        each.filter(|(needed, _)| *needed).map(|(_, letter)| format!("{letter}{}", self.suffix))
    }
}

/// The field of a joint's displacement.
pub(super) fn displacement(joint: usize) -> String {
    format!("q{}", joint + 1)
}

/// The unit of a joint's value.
pub(super) fn unit(robot: &Robot, joint: usize) -> &'static str {
    match robot.joints[joint].motion {
        Motion::Revolute => "rad",
        Motion::Prismatic => "m",
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
