//! Reads tokens and compares them with what they should be.

use super::arithmetic::{Arithmetic, Real};
use super::field::Modular;
use super::truth::{Form, Truth};
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

/// Points for formulas with roots, in doubles: a root is the positive one, which a residue has not.
const POINTS_OF_ROOTS: usize = 24;

/// Two formulas with roots are the same where they differ by no more than this part of the larger: a
/// formula of a thousand terms, each rounded to 1e-16, errs by 1e-13, and cancellation costs some digits.
const TOLERANCE: f64 = 1e-9;

/// Reads tokens and compares them with what they should be.
pub struct Reader<'a> {
    /// The paper's notation.
    pub notation: &'a Notation,
    truth: &'a Truth,
    /// Where most formulas already differ.
    first: Option<Modular>,
}

impl<'a> Reader<'a> {
    /// For the names of an equation.
    pub fn new(notation: &'a Notation, truth: &'a Truth) -> Self {
        let mut reader = Reader { notation, truth, first: None };
        reader.first = reader.point(1);
        reader
    }

    /// A formula, if the tokens are one.
    pub fn tree(&self, tokens: &[Token]) -> Option<Tree> {
        parse_tokens(tokens, self.notation, 0).ok()
    }

    /// Whether the formula equals the truth at one random point.
    pub fn seems(&self, tokens: &[Token], truth: Form<'_>) -> bool {
        let Some(tree) = self.tree(tokens) else { return false };
        let plain = !tree.has_root() && !truth.has_root();
        let quick = self
            .first
            .as_ref()
            .filter(|_| plain)
            .and_then(|point| Some(point.tree(&tree).ok()? == truth.value(point).ok()?));
        quick.unwrap_or_else(|| self.same(&tree, truth, 1))
    }

    /// Whether the formula is the truth.
    pub fn is(&self, tokens: &[Token], truth: Form<'_>) -> bool {
        self.seems(tokens, truth) && self.agrees(tokens, truth).is_some()
    }

    /// How the formula is known to be the truth, if it is.
    pub fn agrees(&self, tokens: &[Token], truth: Form<'_>) -> Option<Verdict> {
        let tree = self.tree(tokens)?;
        let (points, verdict) = match tree.has_root() || truth.has_root() {
            true => (POINTS_OF_ROOTS, Verdict::AgreesAtPoints),
            false => (POINTS, Verdict::Agrees),
        };
        self.same(&tree, truth, points).then_some(verdict)
    }

    /// Whether the two have one value at so many points.
    fn same(&self, tree: &Tree, truth: Form<'_>, count: usize) -> bool {
        let Some(printed) = self.truth.read(tree) else { return false };
        let printed = printed.form(printed.entries[0]);
        let roots = printed.has_root() || truth.has_root();
        let equal = |seed| match roots {
            true => {
                let real = Real(|name: &str| Some(0.3 + 2.0 * Modular::point(seed).part(name)));
                let (a, b) = (printed.value(&real).ok()?, truth.value(&real).ok()?);
                Some((a - b).abs() <= TOLERANCE * a.abs().max(b.abs()))
            }
            false => {
                let point = Modular::point(seed);
                Some(printed.value(&point).ok()? == truth.value(&point).ok()?)
            }
        };
        let known = (1..=8 * count as u64).filter_map(equal).take(count);
        known.take_while(|equal| *equal).count() == count
    }

    /// A point at which names of the equation have the value of what they stand for.
    pub fn point(&self, seed: u64) -> Option<Modular> {
        let mut point = Modular::point(seed);
        for (name, value) in &self.truth.names {
            let value = self.truth.form(*value).value(&point).ok()?;
            point.defined.insert(name.clone(), value);
        }
        Some(point)
    }
}
