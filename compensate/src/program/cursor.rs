//! A walk over tokens.

use std::ops::Range;

use super::edit::Cell;
use super::lexer::{Kind, Token};

/// A place among the tokens of a text.
#[derive(Clone)]
pub(super) struct Cursor<'t> {
    pub(super) text: &'t [u8],
    tokens: &'t [Token],
    at: usize,
}

impl<'t> Cursor<'t> {
    pub(super) fn new(text: &'t [u8], tokens: &'t [Token]) -> Cursor<'t> {
        Cursor { text, tokens, at: 0 }
    }

    pub(super) fn peek(&self) -> Option<&'t Token> {
        self.tokens.get(self.at)
    }

    pub(super) fn next(&mut self) -> Option<&'t Token> {
        let token = self.peek()?;
        self.at += 1;
        Some(token)
    }

    /// The bytes of the next token; those of the text's end behind the last.
    pub(super) fn span(&self) -> Range<usize> {
        let end = self.tokens.last().map_or(self.text.len(), |token| token.span.end);
        self.peek().map_or(end..end, |token| token.span.clone())
    }

    /// The text of a token.
    pub(super) fn shown(&self, span: Range<usize>) -> String {
        String::from_utf8_lossy(&self.text[span]).into_owned()
    }

    /// The next word, in small letters.
    pub(super) fn word(&mut self) -> Option<String> {
        let word = self.peek().filter(|token| token.kind == Kind::Word)?;
        self.at += 1;
        Some(self.shown(word.span.clone()).to_lowercase())
    }

    /// Whether the next token is that byte, which is passed then.
    pub(super) fn mark(&mut self, byte: u8) -> bool {
        let is = self.is_mark(byte);
        self.at += usize::from(is);
        is
    }

    pub(super) fn is_mark(&self, byte: u8) -> bool {
        self.peek().is_some_and(|token| token.kind == Kind::Mark(byte))
    }

    /// Whether a text begins here byte behind byte, which is passed then: `:=`.
    pub(super) fn marks(&mut self, bytes: &[u8]) -> bool {
        let before = self.at;
        let all = bytes.iter().all(|byte| self.mark(*byte));
        if !all {
            self.at = before;
        }
        all
    }

    /// The next number and its sign, in a unit.
    pub(super) fn number(&mut self, unit: f64) -> Option<Cell> {
        let before = self.at;
        let start = self.span().start;
        let negative = self.is_mark(b'-');
        if !self.mark(b'-') {
            self.mark(b'+');
        }
        match self.next().map(|token| (token.kind, token.span.end)) {
            Some((Kind::Number(value), end)) => {
                let value = if negative { -value } else { value };
                Some(Cell { value, unit, span: start..end })
            }
            _ => {
                self.at = before;
                None
            }
        }
    }

    /// Passes what stands in brackets of any kind, if the next token opens some.
    pub(super) fn brackets(&mut self) -> bool {
        let opens = |kind| matches!(kind, Kind::Mark(b'(' | b'[' | b'{'));
        let closes = |kind| matches!(kind, Kind::Mark(b')' | b']' | b'}'));
        if !self.peek().is_some_and(|token| opens(token.kind)) {
            return false;
        }
        let mut depth = 0_usize;
        while let Some(token) = self.next() {
            depth += usize::from(opens(token.kind));
            depth -= usize::from(closes(token.kind));
            if depth == 0 {
                break;
            }
        }
        true
    }

    /// What stands between here and the next of these bytes outside brackets, or the end; that byte is not passed.
    pub(super) fn until(&mut self, ends: &[u8]) -> Cursor<'t> {
        let from = self.at;
        while let Some(token) = self.peek() {
            if matches!(token.kind, Kind::Mark(byte) if ends.contains(&byte)) {
                break;
            }
            if !self.brackets() {
                self.at += 1;
            }
        }
        Cursor { text: self.text, tokens: &self.tokens[from..self.at], at: 0 }
    }

    /// What stands in `[…]`, or behind a `[` without an end, which is passed; `None` where none begins here.
    pub(super) fn index(&mut self) -> Option<Cursor<'t>> {
        let inside = self.mark(b'[').then(|| self.until(b"]"))?;
        self.mark(b']');
        Some(inside)
    }

    /// Everything from here to the end, as it stands in the text.
    pub(super) fn rest(&self) -> String {
        let end = self.tokens.last().map_or(self.text.len(), |token| token.span.end);
        self.shown(self.span().start..end.max(self.span().start))
    }

    pub(super) fn is_at_end(&self) -> bool {
        self.at >= self.tokens.len()
    }
}
