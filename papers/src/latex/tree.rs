//! A formula as a tree, its symbols resolved by the notation.

use core::fmt;
use std::collections::BTreeMap;

use num_rational::Ratio;

/// Sine or cosine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    /// Sine.
    Sin,
    /// Cosine.
    Cos,
}

impl Function {
    /// The other of the two.
    pub fn other(self) -> Self {
        match self {
            Function::Sin => Function::Cos,
            Function::Cos => Function::Sin,
        }
    }
}

/// A whole-number combination of angles.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Angle(BTreeMap<String, i64>);

impl Angle {
    /// A single angle.
    pub fn single(name: &str) -> Self {
        let mut angle = Angle::default();
        angle.add(name, 1);
        angle
    }

    /// Adds `times` an angle; what cancels disappears.
    pub fn add(&mut self, name: &str, times: i64) {
        let sum = self.0.get(name).copied().unwrap_or(0).saturating_add(times);
        match sum {
            0 => self.0.remove(name),
            sum => self.0.insert(name.to_owned(), sum),
        };
    }

    /// Whether the combination is zero.
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The angles with their factors.
    pub fn terms(&self) -> impl Iterator<Item = (&str, i64)> {
        self.0.iter().map(|(name, times)| (name.as_str(), *times))
    }
}

impl fmt::Display for Angle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, (name, times)) in self.terms().enumerate() {
            match times {
                1 if i == 0 => write!(f, "{name}")?,
                1 => write!(f, "+{name}")?,
                -1 => write!(f, "-{name}")?,
                times if i == 0 => write!(f, "{times}{name}")?,
                times => write!(f, "{times:+}{name}")?,
            }
        }
        Ok(())
    }
}

/// A formula.
#[derive(Clone, Debug, PartialEq)]
pub enum Tree {
    /// An exact number.
    Number(Ratio<i128>),
    /// A plain symbol by its name in the graph.
    Symbol(String),
    /// A sine or cosine.
    Trig(Function, Angle),
    /// Terms, each with whether it is subtracted.
    Sum(Vec<(bool, Tree)>),
    /// Factors.
    Product(Vec<Tree>),
    /// Numerator and denominator.
    Quotient(Box<Tree>, Box<Tree>),
    /// A whole-number power.
    Power(Box<Tree>, i32),
    /// A square root.
    Sqrt(Box<Tree>),
    /// `∫ from..to body d(over)` over a plain symbol.
    Integral {
        /// The integrand.
        body: Box<Tree>,
        /// The symbol of integration.
        over: String,
        /// Lower and upper end.
        ends: Box<(Tree, Tree)>,
    },
    /// `∂ body/∂ symbol` with respect to a plain symbol.
    Derivative(Box<Tree>, String),
}

impl Tree {
    /// Every plain symbol in the formula, and every angle, by a visitor.
    pub fn each_name(&self, visit: &mut dyn FnMut(&str)) {
        match self {
            Tree::Number(_) => {}
            Tree::Symbol(name) => visit(name),
            Tree::Trig(_, angle) => angle.terms().for_each(|(name, _)| visit(name)),
            Tree::Sum(terms) => terms.iter().for_each(|(_, term)| term.each_name(visit)),
            Tree::Product(factors) => factors.iter().for_each(|f| f.each_name(visit)),
            Tree::Quotient(a, b) => {
                a.each_name(visit);
                b.each_name(visit);
            }
            Tree::Power(base, _) => base.each_name(visit),
            Tree::Sqrt(inner) | Tree::Derivative(inner, _) => inner.each_name(visit),
            Tree::Integral { body, ends, .. } => {
                body.each_name(visit);
                ends.0.each_name(visit);
                ends.1.each_name(visit);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_cancel() {
        let mut angle = Angle::single("q1");
        angle.add("q2", -2);
        assert_eq!(angle.to_string(), "q1-2q2");
        angle.add("q1", -1);
        angle.add("q2", 2);
        assert!(angle.is_zero());
    }

    #[test]
    fn names_are_visited() {
        let tree = Tree::Power(Box::new(Tree::Symbol("a".into())), 2);
        let sum =
            Tree::Sum(vec![(false, tree), (true, Tree::Sqrt(Box::new(Tree::Symbol("b".into()))))]);
        let mut names = Vec::new();
        sum.each_name(&mut |name| names.push(name.to_owned()));
        assert_eq!(names, ["a", "b"]);
    }
}
