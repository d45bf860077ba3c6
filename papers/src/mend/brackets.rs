//! Slips of brackets.

use super::edit::{Edit, Slip, token};
use crate::latex::lexer::{Bracket, Lexeme, Token};

/// Whether it is a bracket that is printed as one.
fn visible(t: &Token) -> bool {
    match t.is {
        Lexeme::Open(b) | Lexeme::Close(b) => !matches!(b, Bracket::Group | Bracket::Matrix),
        _ => false,
    }
}

/// Slips of brackets: one too many, one too few, one elsewhere; a power that belongs to the next
/// one.
pub fn brackets(tokens: &[Token]) -> Vec<Edit> {
    let mut edits = Vec::new();
    for (i, t) in tokens.iter().enumerate() {
        if let Lexeme::Power(_) = t.is {
            let closes = (i + 1..tokens.len()).find(|k| matches!(tokens[*k].is, Lexeme::Close(_)));
            let mut next = closes;
            while let Some(k) = next.filter(|k| matches!(tokens[*k].is, Lexeme::Close(_))) {
                let what = format!("`{}` belongs behind the later `{}`", t.text, tokens[k].text);
                let parts = vec![(i..i + 1, Vec::new()), (k + 1..k + 1, vec![t.clone()])];
                edits.push(Edit { slip: Slip::Bracket, what, parts });
                next = Some(k + 1).filter(|k| *k < tokens.len());
            }
        }
        if visible(t) {
            let what = format!("`{}` {} is too many", t.text, beside(tokens, i));
            edits.push(Edit::new(Slip::Bracket, i..i + 1, Vec::new(), what));
        }
    }
    for i in 0..=tokens.len() {
        for bracket in [Bracket::Round, Bracket::Square] {
            let text = if bracket == Bracket::Round { ("(", ")") } else { ("[", "]") };
            let before = i.checked_sub(1).map(|k| &tokens[k]);
            let here = tokens.get(i);
            if let Some(next) = here.filter(|t| begins(&t.is)) {
                let what = format!("`{}` is missing before `{}`", text.0, next.text);
                let open = vec![token(Lexeme::Open(bracket), text.0)];
                edits.push(Edit::new(Slip::Bracket, i..i, open, what));
            }
            if let Some(last) = before.filter(|t| ends(&t.is)) {
                let what =
                    format!("`{}` is missing after `{}`", text.1, spelt(tokens, i - 1, last));
                let close = vec![token(Lexeme::Close(bracket), text.1)];
                edits.push(Edit::new(Slip::Bracket, i..i, close, what));
            }
        }
    }
    edits
}

/// Brackets that stand elsewhere.
pub fn moved_brackets(tokens: &[Token]) -> Vec<Edit> {
    let mut edits = Vec::new();
    for (i, t) in tokens.iter().enumerate() {
        if !visible(t) {
            continue;
        }
        let opens = matches!(t.is, Lexeme::Open(_));
        let fits = |k: usize| match k.checked_sub(1).filter(|_| !opens) {
            Some(before) => ends(&tokens[before].is),
            None => opens && begins(&tokens[k].is),
        };
        for k in (0..tokens.len()).filter(|&k| k != i && k != i + 1 && fits(k)) {
            let what = format!("`{}` belongs before `{}`", t.text, tokens[k].text);
            let mut parts = vec![(i..i + 1, Vec::new()), (k..k, vec![t.clone()])];
            parts.sort_by_key(|(at, _)| at.start);
            edits.push(Edit { slip: Slip::Bracket, what, parts });
        }
    }
    edits
}

pub(super) fn begins(is: &Lexeme) -> bool {
    matches!(
        is,
        Lexeme::Name(_)
            | Lexeme::Number(_)
            | Lexeme::Open(_)
            | Lexeme::Minus
            | Lexeme::Function(_)
            | Lexeme::Frac
            | Lexeme::Trace
            | Lexeme::Over(_)
    )
}

pub(super) fn ends(is: &Lexeme) -> bool {
    use Lexeme::{Close, Name, Number, Power, Transposed};
    matches!(is, Name(_) | Number(_) | Close(_) | Power(_) | Transposed { .. })
}

/// The token, with what a power is a power of.
pub(super) fn spelt(tokens: &[Token], i: usize, t: &Token) -> String {
    match (&t.is, i.checked_sub(1)) {
        (Lexeme::Power(_), Some(before)) => format!("{}{}", tokens[before].text, t.text),
        _ => t.text.clone(),
    }
}

pub(super) fn beside(tokens: &[Token], i: usize) -> String {
    match (i.checked_sub(1).map(|k| &tokens[k]), tokens.get(i + 1)) {
        (_, Some(next)) if begins(&next.is) => format!("before `{}`", next.text),
        (Some(last), _) => format!("after `{}`", spelt(tokens, i - 1, last)),
        (None, _) => String::new(),
    }
}
