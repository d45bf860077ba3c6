//! What stands before its argument: derivatives, integrals, sines and cosines.

use num_rational::Ratio;

use super::{Parser, collect};
use crate::latex::lexer::{Bracket, Lexeme, Token};
use crate::latex::mistake::Mistake;
use crate::latex::notation::key;
use crate::latex::tree::{Angle, Function, Tree};

impl Parser<'_> {
    /// `\frac{\partial}{\partial P}(body)`.
    pub(super) fn partial(&mut self) -> Result<Option<Tree>, Mistake> {
        let is = |k: usize| self.tokens.get(self.next + k).map(|t| &t.is);
        let open = Lexeme::Open(Bracket::Group);
        if is(0) != Some(&open) || is(1) != Some(&Lexeme::Partial) {
            return Ok(None);
        }
        let close = Some(&Lexeme::Close(Bracket::Group));
        let shape = is(2) == close
            && is(3) == Some(&open)
            && is(4) == Some(&Lexeme::Partial)
            && is(6) == close;
        let name = match is(5) {
            Some(Lexeme::Name { base, sub }) if shape => key(base, sub.as_deref()),
            _ => {
                return Err(Mistake::new(
                    self.here(),
                    "a derivative is written \\frac{\\partial}{\\partial x}( … )",
                ));
            }
        };
        self.next += 7;
        let body = self.group()?;
        Ok(Some(Tree::Derivative(Box::new(body), name)))
    }

    /// `\int_{a}^{b} body dx`.
    pub(super) fn integral(&mut self) -> Result<Tree, Mistake> {
        let from = self.group()?;
        let to = self.group()?;
        let body = self.group()?;
        let d =
            |token: &Token| matches!(&token.is, Lexeme::Name { base, sub: None } if base == "d");
        let over = match (self.peek(), self.tokens.get(self.next + 1).map(|t| &t.is)) {
            (Some(token), Some(Lexeme::Name { base, sub })) if d(token) => {
                key(base, sub.as_deref())
            }
            _ => return Err(Mistake::new(self.here(), "an integral ends with d and its variable")),
        };
        self.next += 2;
        Ok(Tree::Integral { body: Box::new(body), over, ends: Box::new((from, to)) })
    }

    /// What a sine or cosine is taken of; `\sin^2\theta` is the square of the sine.
    pub(super) fn call(&mut self, function: Function) -> Result<Tree, Mistake> {
        let mut power = None;
        if let Some(Lexeme::Power(p)) = self.peek().map(|t| &t.is) {
            power = Some(*p);
            self.next += 1;
        }
        let start = self.here();
        let mut angle = Angle::default();
        let tree = match self.peek().map(|t| &t.is) {
            Some(Lexeme::Number(n)) => {
                self.next += 1;
                Tree::Product(vec![Tree::Number(*n), self.group()?])
            }
            _ => self.group()?,
        };
        if !collect(&tree, Ratio::from(1), &mut angle) {
            let message = "this is no sum of angles, of which a sine or cosine could be taken";
            return Err(Mistake::new(start, message));
        }
        let call = Tree::Trig(function, angle);
        Ok(match power {
            Some(power) => Tree::Power(Box::new(call), power),
            None => call,
        })
    }
}
