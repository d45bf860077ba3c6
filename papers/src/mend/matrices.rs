//! Slips that only matrices know: the order of factors, what stands behind the last of them, and
//! the letter that an index counts by.

use super::brackets::ends;
use super::edit::{Edit, Slip, token};
use super::slips::Inventory;
use crate::latex::lexer::{Bracket, Count, Lexeme, Token};
use crate::latex::name::Name;

/// Letters that papers count by.
const LETTERS: [&str; 3] = ["i", "j", "k"];

/// A product over another index.
pub(super) fn other_counts(t: &Token, at: usize, over: &Count) -> impl Iterator<Item = Edit> {
    LETTERS.into_iter().filter(|letter| *letter != over.index).map(move |letter| {
        let other = Count { index: letter.into(), ..over.clone() };
        let text = format!("\\prod_{{{letter}={}}}^{{{}}}", over.from, over.to);
        let what = format!("`{}` → `{text}`", t.text);
        Edit::new(Slip::Index, at..at + 1, vec![token(Lexeme::Over(other), &text)], what)
    })
}

/// The same symbol counted by another letter.
pub(super) fn other_indices(name: &Name) -> impl Iterator<Item = Token> {
    let indices: Vec<&str> = name.indices().collect();
    let mut out = Vec::new();
    for (k, index) in indices.iter().enumerate() {
        let counts = |letter: &&str| {
            index
                .strip_prefix(letter)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with(['+', '-']))
        };
        let Some(letter) = LETTERS.into_iter().find(counts) else { continue };
        for other in LETTERS.into_iter().filter(|other| *other != letter) {
            let mut changed: Vec<String> = indices.iter().map(|i| (*i).to_owned()).collect();
            changed[k] = index.replacen(letter, other, 1);
            let name = name.under(changed.join(","));
            let text = name.latex();
            out.push(token(Lexeme::Name(name.into()), &text));
        }
    }
    out.into_iter()
}

/// A symbol that is missing behind a product.
pub(super) fn missing_behind(tokens: &[Token], own: &Inventory) -> Vec<Edit> {
    let mut edits = Vec::new();
    for (i, t) in tokens.iter().enumerate().filter(|(_, t)| ends(&t.is)) {
        if tokens.get(i + 1).is_none_or(|next| !ends(&next.is)) {
            for name in own.tokens() {
                let what = format!("the factor `{}` is missing after `{}`", name.text, t.text);
                edits.push(Edit::new(Slip::Missing, i + 1..i + 1, vec![name.clone()], what));
            }
        }
    }
    edits
}

/// Neighbouring factors that change places.
pub(super) fn exchanged(tokens: &[Token]) -> Vec<Edit> {
    let mut edits = Vec::new();
    for first in 0..tokens.len() {
        let Some(second) = factor(tokens, first) else { continue };
        let Some(end) = factor(tokens, second) else { continue };
        let by = [&tokens[second..end], &tokens[first..second]].concat();
        let what = format!("`{}` belongs before `{}`", tokens[second].text, tokens[first].text);
        edits.push(Edit::new(Slip::Order, first..end, by, what));
    }
    edits
}

/// Where the factor that begins at a token ends.
fn factor(tokens: &[Token], start: usize) -> Option<usize> {
    let mut end = match &tokens.get(start)?.is {
        Lexeme::Name(_) | Lexeme::Number(_) => start + 1,
        Lexeme::Open(bracket) => closed(tokens, start, *bracket)?,
        Lexeme::Frac => factor(tokens, factor(tokens, start + 1)?)?,
        Lexeme::Sqrt | Lexeme::Trace => factor(tokens, start + 1)?,
        _ => return None,
    };
    let powers = |t: &&Token| matches!(t.is, Lexeme::Power(_) | Lexeme::Transposed { .. });
    end += tokens[end..].iter().take_while(powers).count();
    Some(end)
}

/// Behind what closes a bracket.
fn closed(tokens: &[Token], open: usize, bracket: Bracket) -> Option<usize> {
    let mut depth = 0;
    for (k, t) in tokens.iter().enumerate().skip(open) {
        depth += i32::from(t.is == Lexeme::Open(bracket));
        depth -= i32::from(t.is == Lexeme::Close(bracket));
        if depth == 0 {
            return Some(k + 1);
        }
    }
    None
}
