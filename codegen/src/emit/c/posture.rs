//! The posture: sines and cosines of all angles that any function needs, and the displacements of
//! prismatic joints. One struct for all functions, so that a control loop makes it once.

use super::super::angles::angle_terms;
use super::super::expression::Style as _;
use super::super::plan::Plan;
use super::style::C;
use crate::emit::lines::Lines;
use crate::expr::{Expr, Node, Symbol};

/// The fields of the posture.
#[derive(Default)]
pub(super) struct Posture {
    angles: Vec<Field>,
    prismatic: Vec<usize>,
}

/// The pair of fields of one angle.
struct Field {
    /// The angle in terms of `q`.
    sum: String,
    /// What stands behind `s` and `c`.
    suffix: String,
}

/// What one function reads.
pub(super) struct Use {
    /// Its local name and the field.
    pub reads: Vec<(String, String)>,
    /// The statement that makes the field of joint values.
    pub made: String,
}

impl Posture {
    /// Takes in what a function needs and tells what it reads.
    pub fn admit(&mut self, plan: &Plan, language: &C) -> Vec<Use> {
        let mut uses = Vec::new();
        for angle in &plan.angles {
            let sum = sum(plan, angle.sum, language);
            let suffix = self.suffix_of(&sum, &angle.suffix);
            let used = [(angle.sine, "s"), (angle.cosine, "c")].into_iter().filter(|(u, _)| *u);
            let pair =
                |(_, l): (bool, &str)| (format!("{l}{}", angle.suffix), format!("{l}{suffix}"));
            uses.push(Use { reads: used.map(pair).collect(), made: of_angle(&sum, &suffix) });
        }
        for &joint in &plan.prismatic {
            if !self.prismatic.contains(&joint) {
                self.prismatic.push(joint);
                self.prismatic.sort_unstable();
            }
            let name = format!("q{}", joint + 1);
            uses.push(Use { reads: vec![(name.clone(), name)], made: of_prismatic(joint) });
        }
        uses
    }

    fn suffix_of(&mut self, sum: &str, wanted: &str) -> String {
        if let Some(known) = self.angles.iter().find(|a| a.sum == sum) {
            return known.suffix.clone();
        }
        let mut suffix = wanted.to_string();
        while self.angles.iter().any(|a| a.suffix == suffix) {
            suffix.push('o');
        }
        self.angles.push(Field { sum: sum.to_string(), suffix: suffix.clone() });
        suffix
    }

    /// The struct.
    pub fn declaration(&self, out: &mut Lines, name: &str, real: &str) {
        out.comment(&[
            "The joint values as the kernels need them: sines, cosines, displacements.".to_string()
        ]);
        out.code("typedef struct");
        out.code("{");
        out.indent();
        for Field { sum, suffix } in &self.angles {
            out.code(&format!("{real} s{suffix}; /* sine of {sum} */"));
            out.code(&format!("{real} c{suffix}; /* cosine of {sum} */"));
        }
        for joint in &self.prismatic {
            out.code(&format!("{real} q{}; /* q[{joint}], m */", joint + 1));
        }
        out.dedent();
        out.code(&format!("}} {name}_posture_t;"));
    }

    /// Statements that make every field.
    pub fn statements(&self) -> Vec<String> {
        let angles = self.angles.iter().map(|a| of_angle(&a.sum, &a.suffix));
        angles.chain(self.prismatic.iter().map(|joint| of_prismatic(*joint))).collect()
    }
}

fn of_angle(sum: &str, suffix: &str) -> String {
    format!("sin_cos({sum}, &posture->s{suffix}, &posture->c{suffix});")
}

fn of_prismatic(joint: usize) -> String {
    format!("posture->q{} = q[{joint}];", joint + 1)
}

/// An angle in terms of `q`.
fn sum(plan: &Plan, sum: Expr, language: &C) -> String {
    let g = &plan.program.graph;
    let term = |e: Expr| match g.node(e) {
        Node::Number(n) => language.number(n),
        Node::Symbol(s) => match g.symbol_of(s) {
            Symbol::Joint(joint) => format!("q[{joint}]"),
            _ => String::new(),
        },
        _ => String::new(),
    };
    let mut text = String::new();
    for e in angle_terms(g, sum) {
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
