//! Tokens into a tree.

mod calls;

use core::ops::Range;
use std::sync::Arc;

use num_rational::Ratio;

use super::lexer::{Bracket, Lexeme, Token, lex};
use super::mistake::Mistake;
use super::name::Name;
use super::notation::{Notation, Slash};
use super::tree::{Angle, Tree};

/// Brackets deeper than this are no formula.
const DEEPEST: usize = 100;

/// Reads a formula without an equals sign.
///
/// # Errors
/// The first place that cannot be read.
pub fn parse(text: &str, notation: &Notation) -> Result<Tree, Mistake> {
    parse_tokens(&lex(text, notation)?, notation, text.len())
}

/// Reads tokens; `end` is where their text ends, for mistakes there.
///
/// # Errors
/// The first place that cannot be read.
pub fn parse_tokens(tokens: &[Token], notation: &Notation, end: usize) -> Result<Tree, Mistake> {
    let mut parser = Parser { tokens, notation, next: 0, end, depth: 0, norm: false };
    let tree = parser.sum()?;
    match parser.peek() {
        None => Ok(tree),
        Some(token) => Err(parser.unexpected(token)),
    }
}

struct Parser<'t> {
    tokens: &'t [Token],
    notation: &'t Notation,
    next: usize,
    end: usize,
    depth: usize,
    /// Whether a norm is open, which the next bar closes.
    norm: bool,
}

impl<'t> Parser<'t> {
    fn peek(&self) -> Option<&'t Token> {
        self.tokens.get(self.next)
    }

    fn eat(&mut self, is: &Lexeme) -> bool {
        let found = self.peek().is_some_and(|t| t.is == *is);
        self.next += usize::from(found);
        found
    }

    fn here(&self) -> Range<usize> {
        self.peek().map_or(self.end..self.end, |t| t.at.clone())
    }

    fn unexpected(&self, token: &Token) -> Mistake {
        let at = token.at.clone();
        match token.is {
            Lexeme::Close(_) => Mistake::new(at, format!("`{}` closes no bracket", token.text)),
            _ => Mistake::new(at, format!("`{}` stands where a sum should go on", token.text)),
        }
    }

    fn deeper<T>(
        &mut self,
        read: impl FnOnce(&mut Self) -> Result<T, Mistake>,
    ) -> Result<T, Mistake> {
        if self.depth >= DEEPEST {
            return Err(Mistake::new(self.here(), "brackets are nested too deeply here"));
        }
        self.depth += 1;
        let result = read(self);
        self.depth -= 1;
        result
    }

    fn sum(&mut self) -> Result<Tree, Mistake> {
        let mut terms = Vec::new();
        loop {
            let mut negative = false;
            let mut signed = false;
            while let Some(Lexeme::Plus | Lexeme::Minus) = self.peek().map(|t| &t.is) {
                negative ^= self.tokens[self.next].is == Lexeme::Minus;
                signed = true;
                self.next += 1;
            }
            if !signed && !terms.is_empty() {
                break;
            }
            terms.push((negative, self.product()?));
        }
        match terms.as_mut_slice() {
            [(false, _)] => Ok(terms.remove(0).1),
            _ => Ok(Tree::Sum(terms)),
        }
    }

    fn product(&mut self) -> Result<Tree, Mistake> {
        let mut factors = vec![self.factor()?];
        let mut below: Vec<Tree> = Vec::new();
        loop {
            if self.eat(&Lexeme::Times) {
                factors.push(self.factor()?);
            } else if self.eat(&Lexeme::Slash) {
                below.push(self.factor()?);
                while self.notation.slash == Slash::Product && self.begins_factor() {
                    below.push(self.factor()?);
                }
            } else if self.begins_factor() {
                factors.push(self.factor()?);
            } else {
                break;
            }
        }
        let above = product_of(factors);
        if below.is_empty() {
            return Ok(above);
        }
        Ok(Tree::Quotient(Box::new(above), Box::new(product_of(below))))
    }

    fn begins_factor(&self) -> bool {
        match self.peek().map(|t| &t.is) {
            Some(Lexeme::Bar) => !self.norm,
            Some(
                Lexeme::Number(_)
                | Lexeme::Name(_)
                | Lexeme::Open(_)
                | Lexeme::Function(_)
                | Lexeme::Frac
                | Lexeme::Sqrt
                | Lexeme::Integral
                | Lexeme::Trace
                | Lexeme::Over(_),
            ) => true,
            _ => false,
        }
    }

    fn factor(&mut self) -> Result<Tree, Mistake> {
        let mut base = self.deeper(Self::primary)?;
        loop {
            base = match self.peek().map(|t| &t.is) {
                Some(Lexeme::Power(power)) => Tree::Power(Box::new(base), *power),
                Some(Lexeme::Transposed { inverse }) => {
                    let inner = if *inverse { Tree::Power(Box::new(base), -1) } else { base };
                    Tree::Transpose(Box::new(inner))
                }
                _ => return Ok(base),
            };
            self.next += 1;
        }
    }

    fn primary(&mut self) -> Result<Tree, Mistake> {
        let Some(token) = self.peek() else {
            return Err(Mistake::new(
                self.end..self.end,
                "the formula ends where a term is expected",
            ));
        };
        self.next += 1;
        match &token.is {
            Lexeme::Number(value) => Ok(Tree::Number(*value)),
            Lexeme::Name(name) => Ok(self.name(name)),
            Lexeme::Open(Bracket::Matrix) => self.blocks(token),
            Lexeme::Open(bracket) => {
                let outer = core::mem::take(&mut self.norm);
                let inner = self.sum()?;
                self.norm = outer;
                self.closed(token, &Lexeme::Close(*bracket))?;
                Ok(inner)
            }
            Lexeme::Bar => {
                self.norm = true;
                let inner = self.sum()?;
                self.norm = false;
                self.closed(token, &Lexeme::Bar)?;
                Ok(Tree::Norm(Box::new(inner)))
            }
            Lexeme::Trace => self.group().map(|inner| Tree::Trace(Box::new(inner))),
            Lexeme::Over(over) => Ok(Tree::Over(over.clone(), Box::new(self.product()?))),
            Lexeme::Function(function) => self.call(*function),
            Lexeme::Frac => self.fraction(),
            Lexeme::Sqrt => self.group().map(|inner| Tree::Sqrt(Box::new(inner))),
            Lexeme::Integral => self.integral(),
            _ => {
                let message = format!("`{}` stands where a term is expected", token.text);
                Err(Mistake::new(token.at.clone(), message))
            }
        }
    }

    fn name(&self, name: &Arc<Name>) -> Tree {
        match self.notation.function(&name.base, name.sub.as_deref()) {
            Some((function, angle)) => Tree::Trig(function, angle),
            None => Tree::Symbol(name.clone()),
        }
    }

    /// What closes a bracket.
    fn closed(&mut self, open: &Token, close: &Lexeme) -> Result<(), Mistake> {
        if self.eat(close) {
            return Ok(());
        }
        match self.peek() {
            Some(Token { is: Lexeme::Close(_), text, at }) => {
                let message = format!("`{text}` stands where `{}` should be closed", open.text);
                Err(Mistake::new(at.clone(), message))
            }
            Some(token) => Err(self.unexpected(token)),
            None => Err(Mistake::new(open.at.clone(), "this bracket is never closed")),
        }
    }

    /// Rows of cells.
    fn blocks(&mut self, open: &Token) -> Result<Tree, Mistake> {
        let outer = core::mem::take(&mut self.norm);
        let mut rows = vec![vec![self.sum()?]];
        loop {
            if self.eat(&Lexeme::Row) {
                rows.push(vec![self.sum()?]);
            } else if self.eat(&Lexeme::Cell) {
                let cell = self.sum()?;
                rows.last_mut().into_iter().for_each(|row| row.push(cell.clone()));
            } else {
                self.norm = outer;
                self.closed(open, &Lexeme::Close(Bracket::Matrix))?;
                return Ok(Tree::Blocks(rows));
            }
        }
    }

    /// A group in braces, or a single factor.
    fn group(&mut self) -> Result<Tree, Mistake> {
        self.deeper(Self::primary)
    }

    fn fraction(&mut self) -> Result<Tree, Mistake> {
        if let Some(tree) = self.partial()? {
            return Ok(tree);
        }
        let above = self.group()?;
        let below = self.group()?;
        Ok(Tree::Quotient(Box::new(above), Box::new(below)))
    }
}

fn product_of(mut factors: Vec<Tree>) -> Tree {
    if factors.len() == 1 { factors.remove(0) } else { Tree::Product(factors) }
}

/// Reads a tree as a whole-number combination of angles; whether it is one.
pub(crate) fn collect(tree: &Tree, times: Ratio<i128>, into: &mut Angle) -> bool {
    match tree {
        Tree::Number(n) => *n.numer() == 0,
        Tree::Symbol(name) => match i64::try_from(times.to_integer()) {
            Ok(whole) if times.is_integer() => {
                into.add(&name.key, whole);
                true
            }
            _ => false,
        },
        Tree::Sum(terms) => terms
            .iter()
            .all(|(negative, term)| collect(term, if *negative { -times } else { times }, into)),
        Tree::Product(factors) => match factors.as_slice() {
            [Tree::Number(n), rest] if n.numer().abs() < 1000 => collect(rest, times * n, into),
            _ => false,
        },
        _ => false,
    }
}

#[cfg(test)]
mod tests;
