//! A formula as a tree, its symbols resolved by the notation.

use core::fmt;
use std::collections::BTreeMap;
use std::sync::Arc;

use num_rational::Ratio;

use super::name::Name;
use super::token::Count;

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

/// A formula, of numbers or of matrices.
#[derive(Clone, Debug, PartialEq)]
pub enum Tree {
    /// An exact number.
    Number(Ratio<i128>),
    /// A plain symbol.
    Symbol(Arc<Name>),
    /// A sine or cosine.
    Trig(Function, Angle),
    /// Terms, each with whether it is subtracted.
    Sum(Vec<(bool, Tree)>),
    /// Factors.
    Product(Vec<Tree>),
    /// Numerator and denominator.
    Quotient(Box<Tree>, Box<Tree>),
    /// A whole-number power; −1 is the inverse.
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
    /// `∂ body/∂ symbol`; of matrices by a joint, or column by column by all of them.
    Derivative(Box<Tree>, Arc<Name>),
    /// Rows for columns.
    Transpose(Box<Tree>),
    /// The sum of the diagonal.
    Trace(Box<Tree>),
    /// Frobenius' norm.
    Norm(Box<Tree>),
    /// Blocks, row by row.
    Blocks(Vec<Vec<Tree>>),
    /// A product over an index.
    Over(Count, Box<Tree>),
}

impl Tree {
    /// The formulas that it is made of.
    pub fn children(&self) -> Vec<&Tree> {
        match self {
            Tree::Number(_) | Tree::Symbol(_) | Tree::Trig(..) => Vec::new(),
            Tree::Sum(terms) => terms.iter().map(|(_, term)| term).collect(),
            Tree::Product(factors) => factors.iter().collect(),
            Tree::Quotient(a, b) => vec![a, b],
            Tree::Integral { body, ends, .. } => vec![body, &ends.0, &ends.1],
            Tree::Blocks(rows) => rows.iter().flatten().collect(),
            Tree::Power(a, _)
            | Tree::Sqrt(a)
            | Tree::Derivative(a, _)
            | Tree::Transpose(a)
            | Tree::Trace(a)
            | Tree::Norm(a)
            | Tree::Over(_, a) => vec![a],
        }
    }

    /// Whether a square root stands in it.
    pub fn has_root(&self) -> bool {
        matches!(self, Tree::Sqrt(_)) || self.children().into_iter().any(Tree::has_root)
    }

    /// Every plain symbol in the formula, and every angle, by a visitor that is told whether it is
    /// an angle.
    pub fn each_name(&self, visit: &mut dyn FnMut(&str, bool)) {
        match self {
            Tree::Symbol(name) => visit(&name.key, false),
            Tree::Trig(_, angle) => angle.terms().for_each(|(name, _)| visit(name, true)),
            _ => self.children().into_iter().for_each(|child| child.each_name(visit)),
        }
    }

    /// The smallest parts of two formulas outside of which they are the same.
    pub fn difference<'t>(&'t self, other: &'t Tree) -> (&'t Tree, &'t Tree) {
        let same = match (self, other) {
            (Tree::Sum(a), Tree::Sum(b)) => a.iter().map(|t| t.0).eq(b.iter().map(|t| t.0)),
            (Tree::Power(_, a), Tree::Power(_, b)) => a == b,
            (Tree::Derivative(_, a), Tree::Derivative(_, b)) => a == b,
            (Tree::Over(a, _), Tree::Over(b, _)) => a == b,
            (Tree::Blocks(a), Tree::Blocks(b)) => a.iter().map(Vec::len).eq(b.iter().map(Vec::len)),
            (a, b) => core::mem::discriminant(a) == core::mem::discriminant(b),
        };
        let (ours, theirs) = (self.children(), other.children());
        let mut apart = ours.iter().zip(&theirs).filter(|(a, b)| a != b);
        match (same && ours.len() == theirs.len(), apart.next(), apart.next()) {
            (true, Some((a, b)), None) => a.difference(b),
            _ => (self, other),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latex::notation::Notation;
    use crate::latex::parser::parse;

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
        let mut names = Vec::new();
        let tree = parse("a^2 - \\sqrt{b} \\cos\\theta_1", &Notation::default()).unwrap();
        tree.each_name(&mut |name, angle| names.push((name.to_owned(), angle)));
        assert_eq!(names, [("a".into(), false), ("b".into(), false), ("theta1".into(), true)]);
    }

    #[test]
    fn the_smallest_difference_is_found() {
        let read = |text: &str| parse(text, &Notation::MATRICES).unwrap();
        for (a, b, part, other) in [
            ("A (B^T C)^{-1} + D", "A (C B^T)^{-1} + D", "B^T C", "C B^T"),
            ("A (B + C)", "A (B - C)", "B + C", "B - C"),
            ("A B_i", "A B_j", "B_i", "B_j"),
            ("A + B C", "(A + B) C", "A + B C", "(A + B) C"),
        ] {
            let (a, b) = (read(a), read(b));
            let (a, b) = a.difference(&b);
            assert_eq!((a.latex(), b.latex()), (part.to_owned(), other.to_owned()));
        }
    }
}
