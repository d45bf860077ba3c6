//! Reads tokens and compares them with what they should be.

use std::collections::HashMap;

use crate::exact::evaluate::Arithmetic;
use crate::exact::field::Modular;
use crate::exact::rational::{Exact, Rational};
use crate::latex::lexer::Token;
use crate::latex::notation::Notation;
use crate::latex::parser::parse_tokens;
use crate::verdict::Verdict;

/// Points at which formulas without an exact form are compared.
const POINTS: u64 = 24;

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
        (1..6).find_map(|seed| {
            let point = self.point(seed)?;
            Some(point.tree(&tree).ok()? == point.rational(truth).ok()?)
        }) == Some(true)
    }

    /// Whether the formula is the truth.
    pub fn is(&self, tokens: &[Token], truth: &Rational) -> bool {
        self.seems(tokens, truth) && self.agrees(tokens, truth).is_some()
    }

    /// How the formula is known to be the truth, if it is.
    pub fn agrees(&self, tokens: &[Token], truth: &Rational) -> Option<Verdict> {
        let tree = parse_tokens(tokens, self.notation, 0).ok()?;
        let exact = Exact(self.defined).tree(&tree).and_then(|e| e.equals(truth));
        match exact {
            Ok(true) => Some(Verdict::Agrees),
            Ok(false) => None,
            Err(_) => {
                let mut seen = 0;
                for seed in 1..POINTS * 8 {
                    let Some(point) = self.point(seed) else { continue };
                    let (Ok(a), Ok(b)) = (point.tree(&tree), point.rational(truth)) else {
                        continue;
                    };
                    if a != b {
                        return None;
                    }
                    seen += 1;
                    if seen == POINTS {
                        return Some(Verdict::AgreesAtPoints);
                    }
                }
                None
            }
        }
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
