//! What stands before its argument: derivatives, integrals, sines and cosines.

use num_rational::Ratio;

use super::{Parser, collect};
use crate::latex::lexer::{Bracket, Lexeme, Token};
use crate::latex::mistake::Mistake;
use crate::latex::tree::{Angle, Function, Tree};

impl Parser<'_> {
    /// `\frac{\partial}{\partial P}(body)`, `\frac{\partial body}{\partial P}`.
    pub(super) fn partial(&mut self) -> Result<Option<Tree>, Mistake> {
        let (open, close) = (Lexeme::Open(Bracket::Group), Lexeme::Close(Bracket::Group));
        let ahead = self.tokens.get(self.next..self.next + 2);
        if !ahead.is_some_and(|two| two[0].is == open && two[1].is == Lexeme::Partial) {
            return Ok(None);
        }
        self.next += 2;
        let above = if self.eat(&close) { None } else { Some(self.product()?) };
        let divided = above.is_none() || self.eat(&close);
        if divided
            && self.eat(&open)
            && self.eat(&Lexeme::Partial)
            && let Some(Lexeme::Name(name)) = self.peek().map(|t| &t.is)
        {
            self.next += 1;
            if self.eat(&close) {
                let body = above.map_or_else(|| self.group(), Ok)?;
                return Ok(Some(Tree::Derivative(Box::new(body), name.clone())));
            }
        }
        let message = "a derivative is written \\frac{\\partial}{\\partial x}( … )";
        Err(Mistake::new(self.here(), message))
    }

    /// `\int_{a}^{b} body dx`.
    pub(super) fn integral(&mut self) -> Result<Tree, Mistake> {
        let from = self.group()?;
        let to = self.group()?;
        let body = self.group()?;
        let two = self.tokens.get(self.next..self.next + 2).unwrap_or_default();
        let over = match two {
            [Token { is: Lexeme::Name(d), .. }, Token { is: Lexeme::Name(over), .. }]
                if d.base == "d" && d.sub.is_none() =>
            {
                over.key.clone()
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
