//! A change of printed tokens.

use core::ops::Range;

use crate::latex::lexer::{Lexeme, Token};

/// Kinds of slips, the likeliest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Slip {
    /// A plus for a minus.
    Sign,
    /// A sine for a cosine.
    Function,
    /// An index.
    Index,
    /// A power, or a transposition.
    Power,
    /// A bracket that is missing, too many or in the wrong place.
    Bracket,
    /// Another symbol.
    Symbol,
    /// Factors that change places.
    Order,
    /// A factor or term too many.
    Extra,
    /// A factor that is missing.
    Missing,
}

impl Slip {
    /// The kind in words.
    pub fn name(self) -> &'static str {
        match self {
            Slip::Sign => "sign",
            Slip::Function => "sine and cosine exchanged",
            Slip::Index => "index",
            Slip::Power => "power",
            Slip::Bracket => "bracket",
            Slip::Symbol => "symbol",
            Slip::Order => "order",
            Slip::Extra => "too much",
            Slip::Missing => "missing",
        }
    }
}

/// Replacements of ranges of tokens, and what they mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Edit {
    /// What kind of slip this mends.
    pub slip: Slip,
    /// What becomes of what, in words.
    pub what: String,
    /// Ranges in the printed tokens and what replaces them, in order, not overlapping.
    pub parts: Vec<(Range<usize>, Vec<Token>)>,
}

impl Edit {
    /// A single replacement.
    pub fn new(slip: Slip, at: Range<usize>, by: Vec<Token>, what: String) -> Self {
        Edit { slip, what, parts: vec![(at, by)] }
    }

    /// Whether two edits touch the same tokens.
    pub fn clashes(&self, other: &Edit) -> bool {
        let touch = |a: &Range<usize>, b: &Range<usize>| {
            a.start < b.end && b.start < a.end || a.start == b.start
        };
        self.parts.iter().any(|(a, _)| other.parts.iter().any(|(b, _)| touch(a, b)))
    }
}

/// A token that is not printed.
pub(super) fn token(is: Lexeme, text: &str) -> Token {
    Token { is, text: text.to_owned(), at: 0..0 }
}

/// The tokens with all edits made.
pub fn apply(tokens: &[Token], edits: &[&Edit]) -> Vec<Token> {
    let mut parts: Vec<&(Range<usize>, Vec<Token>)> =
        edits.iter().flat_map(|edit| &edit.parts).collect();
    parts.sort_by_key(|(at, _)| (at.start, at.end));
    let mut out = Vec::with_capacity(tokens.len() + 2);
    let mut next = 0;
    for (at, by) in parts {
        out.extend_from_slice(&tokens[next.min(at.start)..at.start]);
        out.extend(by.iter().cloned());
        next = next.max(at.end);
    }
    out.extend_from_slice(&tokens[next..]);
    out
}

/// Tokens written back as LaTeX.
pub fn written(tokens: &[Token]) -> String {
    use crate::latex::lexer::Bracket::Group;
    use crate::latex::lexer::Lexeme::{Close, Function, Minus, Open, Plus, Power};
    let mut text = String::new();
    for (i, token) in tokens.iter().enumerate() {
        let before = i.checked_sub(1).map(|k| &tokens[k].is);
        let unary = before.is_none_or(|t| matches!(t, Open(_)));
        let sum = matches!(token.is, Plus | Minus) && !unary;
        let after_sum =
            matches!(before, Some(Plus | Minus)) && i >= 2 && !matches!(tokens[i - 2].is, Open(_));
        let tight = i == 0
            || matches!(token.is, Power(_) | Close(_) | Open(Group))
            || matches!((before, &token.is), (Some(Function(_)), Open(_)))
            || matches!(before, Some(Open(_) | Power(_)))
            || !text.ends_with(|c: char| c.is_ascii_alphabetic());
        if i > 0 && (sum || after_sum || !tight) {
            text.push(' ');
        }
        text.push_str(&token.text);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latex::lexer::lex;
    use crate::latex::notation::Notation;

    #[test]
    fn edits_are_made_together_and_written_back() {
        let tokens = lex("-a \\sin b+c^2", &Notation::default()).unwrap();
        let minus = lex("-", &Notation::default()).unwrap();
        let sign = Edit::new(Slip::Sign, 4..5, minus, "sign".into());
        let drop = Edit::new(Slip::Extra, 6..7, Vec::new(), "power".into());
        assert!(!sign.clashes(&drop) && sign.clashes(&sign));
        assert_eq!(written(&apply(&tokens, &[&drop, &sign])), "-a \\sin b - c");
        assert_eq!(written(&tokens), "-a \\sin b + c^2");
    }
}
