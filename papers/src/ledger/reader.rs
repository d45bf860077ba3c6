//! Reads tokens and compares them with what they should be.

use std::collections::HashMap;

use crate::exact::evaluate::Arithmetic;
use crate::exact::field::Modular;
use crate::exact::rational::{Exact, Rational};
use crate::latex::lexer::Token;
use crate::latex::notation::Notation;
use crate::latex::parser::parse_tokens;
use crate::latex::tree::Tree;
use crate::verdict::Verdict;

/// Points that decide whether two formulas without roots are the same.
///
/// Their difference is a quotient of polynomials in the symbols and in t, where a sine is 2t/(1 + t²)
/// and a cosine (1 − t²)/(1 + t²). If its numerator, of degree d, is not zero, it vanishes at a random
/// point modulo p = 2⁶¹ − 1 with a probability of at most d/(p − 1000) (Schwartz and Zippel). No
/// formula of the papers comes near d = 10⁵, for which three points are wrong once in 10⁴⁰ times.
const POINTS: usize = 3;

/// Points for formulas with roots and without an exact form: half of all residues have no root, and
/// the sign of a root is a convention.
const POINTS_OF_ROOTS: usize = 24;

/// Reads tokens and compares them with what they should be.
pub struct Reader<'a> {
    /// The paper's notation.
    pub notation: &'a Notation,
    /// What names stand for.
    pub defined: &'a HashMap<String, Rational>,
}

impl Reader<'_> {
    /// Whether the tokens are a formula.
    pub fn reads(&self, tokens: &[Token]) -> bool {
        parse_tokens(tokens, self.notation, 0).is_ok()
    }

    /// Whether the formula equals the truth at one random point.
    pub fn seems(&self, tokens: &[Token], truth: &Rational) -> bool {
        let Ok(tree) = parse_tokens(tokens, self.notation, 0) else { return false };
        self.same(&tree, truth, 1) == Some(true)
    }

    /// Whether the formula is the truth.
    pub fn is(&self, tokens: &[Token], truth: &Rational) -> bool {
        self.seems(tokens, truth) && self.agrees(tokens, truth).is_some()
    }

    /// How the formula is known to be the truth, if it is.
    pub fn agrees(&self, tokens: &[Token], truth: &Rational) -> Option<Verdict> {
        let tree = parse_tokens(tokens, self.notation, 0).ok()?;
        if !tree.has_root()
            && let Some(same) = self.same(&tree, truth, POINTS)
        {
            return same.then_some(Verdict::Agrees);
        }
        match Exact(self.defined).tree(&tree).and_then(|e| e.equals(truth)) {
            Ok(same) => same.then_some(Verdict::Agrees),
            Err(_) => self.same(&tree, truth, POINTS_OF_ROOTS)?.then_some(Verdict::AgreesAtPoints),
        }
    }

    /// Whether the two have one value at so many points; none where they have no values.
    fn same(&self, tree: &Tree, truth: &Rational, count: usize) -> Option<bool> {
        let values = (1..=8 * count as u64).filter_map(|seed| {
            let point = self.point(seed)?;
            Some(point.tree(tree).ok()? == point.rational(truth).ok()?)
        });
        let (mut seen, mut same) = (0, true);
        for equal in values.take(count) {
            (seen, same) = (seen + 1, same && equal);
        }
        (seen == count || !same).then_some(same)
    }

    fn point(&self, seed: u64) -> Option<Modular> {
        let mut point = Modular::point(seed);
        for (name, value) in self.defined {
            let value = point.rational(value).ok()?;
            point.defined.insert(name.clone(), value);
        }
        Some(point)
    }
}
