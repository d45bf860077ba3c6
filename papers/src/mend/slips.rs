//! Every single slip that could have led to what is printed.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use num_rational::Ratio;

use super::brackets::{begins, beside};
use super::edit::{Edit, Slip, token};
use super::matrices;
use crate::latex::lexer::{Bracket, Lexeme, Token};
use crate::latex::name::Name;
use crate::latex::notation::Notation;
use crate::latex::tree::Function;

/// The names that a paper uses, as tokens, by their spelling without spaces.
#[derive(Clone, Debug, Default)]
pub struct Inventory(BTreeMap<String, Token>);

impl Inventory {
    /// Adds the names of a formula.
    pub fn add(&mut self, tokens: &[Token]) {
        for token in tokens {
            if let Lexeme::Name(name) = &token.is {
                let spelt = format!("{}_{}", name.base, name.sub.as_deref().unwrap_or_default());
                self.0.entry(spelt).or_insert_with(|| token.clone());
            }
        }
    }

    /// The names, in the order of their spelling.
    pub fn tokens(&self) -> impl Iterator<Item = &Token> {
        self.0.values()
    }
}

/// All slips of names, signs, powers and numbers; brackets apart. `inventory` are the paper's
/// names, `own` those of the formula and of what it should be.
pub fn slips(
    tokens: &[Token],
    notation: &Notation,
    inventory: &Inventory,
    own: &Inventory,
) -> Vec<Edit> {
    let mut edits = Vec::new();
    for (i, t) in tokens.iter().enumerate() {
        match &t.is {
            Lexeme::Plus => edits.push(sign(tokens, i, token(Lexeme::Minus, "-"))),
            Lexeme::Minus => edits.push(sign(tokens, i, token(Lexeme::Plus, "+"))),
            Lexeme::Function(f) => {
                let other = f.other();
                let text = if other == Function::Sin { "\\sin" } else { "\\cos" };
                let by = token(Lexeme::Function(other), text);
                edits.push(swap(Slip::Function, tokens, i, by));
            }
            Lexeme::Power(p) => powers(tokens, i, *p, &mut edits),
            Lexeme::Number(n) => numbers(tokens, i, *n, own, &mut edits),
            Lexeme::Name(name) => names(tokens, i, name, notation, inventory, own, &mut edits),
            Lexeme::Over(over) => edits.extend(matrices::other_counts(t, i, over)),
            Lexeme::Transposed { .. } => {
                let what = format!("`{}` is too many", t.text);
                edits.push(Edit::new(Slip::Power, i..i + 1, Vec::new(), what));
            }
            _ => {}
        }
        if let (Lexeme::Name(name), Some(next)) = (&t.is, tokens.get(i + 1))
            && let (None, Lexeme::Name(indexed)) = (&name.sub, &next.is)
            && let Some(sub) = &indexed.sub
        {
            // A stray letter between a letter and its index.
            let index = &next.text[next.text.find('_').unwrap_or(0)..];
            let text = format!("{}{index}", t.text);
            let by = token(Lexeme::Name(name.under(sub.clone()).into()), &text);
            let what = format!("`{} {}` → `{}`", t.text, next.text, by.text);
            edits.push(Edit::new(Slip::Symbol, i..i + 2, vec![by], what));
        }
        let starts =
            i == 0 || tokens[i - 1].is.opens() && tokens[i - 1].is != Lexeme::Open(Bracket::Group);
        if starts && !matches!(t.is, Lexeme::Plus | Lexeme::Minus) && !t.is.closes() {
            let what = format!("a minus before `{}`", t.text);
            let minus = vec![token(Lexeme::Minus, "-")];
            edits.push(Edit::new(Slip::Sign, i..i, minus, what));
        }
    }
    terms(tokens, &mut edits);
    missing(tokens, own, &mut edits);
    if notation.matrices {
        edits.extend(matrices::missing_behind(tokens, own));
        // A number in front of a product stays in front: what is missing is tried from the right.
        edits.sort_by_key(|e| (e.slip == Slip::Missing).then(|| Reverse(e.parts[0].0.start)));
        edits.extend(matrices::exchanged(tokens));
    }
    edits.sort_by_key(|e| e.slip);
    edits
}

fn sign(tokens: &[Token], i: usize, by: Token) -> Edit {
    let next: String =
        tokens[i + 1..].iter().take(3).map(|t| t.text.as_str()).collect::<Vec<_>>().join(" ");
    let what = format!("`{}` → `{}` before `{next}`", tokens[i].text, by.text);
    Edit::new(Slip::Sign, i..i + 1, vec![by], what)
}

fn swap(slip: Slip, tokens: &[Token], i: usize, by: Token) -> Edit {
    let context = match tokens.get(i + 1).map(|t| &t.is) {
        Some(Lexeme::Power(_)) => tokens[i + 1].text.as_str(),
        _ => "",
    };
    let beside = match i.checked_sub(1).map(|k| &tokens[k]) {
        Some(t) if matches!(t.is, Lexeme::Name(_)) => format!(" after `{}`", t.text),
        _ => String::new(),
    };
    let what = format!("`{}{context}` → `{}{context}`{beside}", tokens[i].text, by.text);
    Edit::new(slip, i..i + 1, vec![by], what)
}

fn powers(tokens: &[Token], i: usize, p: i32, edits: &mut Vec<Edit>) {
    let base = i.checked_sub(1).map_or("", |k| tokens[k].text.as_str());
    for q in [p - 1, p + 1, p - 2, p + 2] {
        if q == 0 {
            continue;
        }
        let by = if q == 1 {
            Vec::new()
        } else {
            let text = if (0..10).contains(&q) { format!("^{q}") } else { format!("^{{{q}}}") };
            vec![token(Lexeme::Power(q), &text)]
        };
        let shown = by.first().map_or("", |t| t.text.as_str());
        let what = format!("`{base}{}` → `{base}{shown}`", tokens[i].text);
        edits.push(Edit::new(Slip::Power, i..i + 1, by, what));
    }
}

fn numbers(tokens: &[Token], i: usize, n: Ratio<i128>, own: &Inventory, edits: &mut Vec<Edit>) {
    let one = Ratio::from(1);
    if n.numer().abs() < 1_000_000 && *n.denom() < 1_000_000 {
        for m in [n + one, n - one, n * 2, n / 2].into_iter().filter(|m| *m.numer() > 0) {
            let text = if m.is_integer() {
                m.to_string()
            } else {
                format!("\\frac{{{}}}{{{}}}", m.numer(), m.denom())
            };
            edits.push(swap(Slip::Symbol, tokens, i, token(Lexeme::Number(m), &text)));
        }
    }
    for name in own.0.values() {
        edits.push(swap(Slip::Symbol, tokens, i, name.clone()));
    }
}

fn names(
    tokens: &[Token],
    i: usize,
    name: &Name,
    notation: &Notation,
    inventory: &Inventory,
    own: &Inventory,
    edits: &mut Vec<Edit>,
) {
    let function = |t: &Token| match &t.is {
        Lexeme::Name(name) => notation.function(&name.base, name.sub.as_deref()),
        _ => None,
    };
    let here = function(&tokens[i]);
    if let Some((f, _)) = &here {
        let family = notation.functions.iter().find(|f| f.0 == name.base).map(|f| &f.2);
        let partner = notation
            .functions
            .iter()
            .find(|(_, g, angle)| *g == f.other() && Some(angle) == family);
        if let Some((letter, ..)) = partner {
            let rest = &tokens[i].text[tokens[i].text.find('_').unwrap_or(0)..];
            let text = format!("{letter}{rest}");
            let is = Name::new(letter.clone(), name.sub.clone(), &text);
            let by = token(Lexeme::Name(is.into()), &text);
            edits.push(swap(Slip::Function, tokens, i, by));
        }
    }
    for (spelling, other) in &inventory.0 {
        let Lexeme::Name(letter) = &other.is else { continue };
        let kindred = letter.base == name.base;
        if other.is == tokens[i].is {
            continue;
        }
        let kin = match (&here, function(other)) {
            (Some(_), Some(_)) => true,
            (None, None) => kindred || own.0.contains_key(spelling),
            _ => own.0.contains_key(spelling),
        };
        if kin {
            let slip = if kindred { Slip::Index } else { Slip::Symbol };
            edits.push(swap(slip, tokens, i, other.clone()));
        }
    }
    edits.extend(matrices::other_indices(name).map(|by| swap(Slip::Index, tokens, i, by)));
    let power = matches!(tokens.get(i + 1).map(|t| &t.is), Some(Lexeme::Power(_)));
    let end = i + 1 + usize::from(power);
    let dropped: String = tokens[i..end].iter().map(|t| t.text.as_str()).collect();
    if !whole_term(tokens, i, end) {
        let what = format!("the factor `{dropped}` {} is too many", beside(tokens, i));
        edits.push(Edit::new(Slip::Extra, i..end, Vec::new(), what));
    }
    if !power {
        let (two, three) = ((Lexeme::Power(2), "^2"), (Lexeme::Power(3), "^3"));
        let inverse = (Lexeme::Power(-1), "^{-1}");
        let transposed = (Lexeme::Transposed { inverse: false }, "^T");
        for (is, text) in if notation.matrices { [transposed, inverse] } else { [two, three] } {
            let what = format!("`{0}` → `{0}{text}`", tokens[i].text);
            let by = vec![token(is, text)];
            edits.push(Edit::new(Slip::Power, i + 1..i + 1, by, what));
        }
    }
}

/// Whether the tokens make up a term by themselves.
fn whole_term(tokens: &[Token], start: usize, end: usize) -> bool {
    let sign = |t: &Lexeme| matches!(t, Lexeme::Plus | Lexeme::Minus);
    let before = start.checked_sub(1).map(|k| &tokens[k].is);
    let begins = before.is_none_or(|t| sign(t) || t.opens());
    begins && tokens.get(end).is_none_or(|t| sign(&t.is) || t.is.closes())
}

/// Whole terms that are too many.
fn terms(tokens: &[Token], edits: &mut Vec<Edit>) {
    for start in 0..tokens.len() {
        let first = start == 0 || tokens[start - 1].is.opens();
        let signed = matches!(tokens[start].is, Lexeme::Plus | Lexeme::Minus);
        if !first && !signed {
            continue;
        }
        let mut depth = 0i32;
        let mut end = start + usize::from(signed);
        while let Some(t) = tokens.get(end) {
            match t.is {
                Lexeme::Open(_) => depth += 1,
                _ if depth == 0 && t.is.closes() => break,
                Lexeme::Close(_) => depth -= 1,
                Lexeme::Plus | Lexeme::Minus if depth == 0 => break,
                _ => {}
            }
            end += 1;
        }
        // The sign of a first term that goes stays with the next: `a + b` becomes `b`.
        let end = match tokens.get(end).map(|t| &t.is) {
            Some(Lexeme::Plus) if first && !signed => end + 1,
            _ => end,
        };
        let dropped = super::edit::written(&tokens[start..end]);
        let what = format!("the term `{dropped}` is too many");
        edits.push(Edit::new(Slip::Extra, start..end, Vec::new(), what));
    }
}

/// Factors that are missing.
fn missing(tokens: &[Token], own: &Inventory, edits: &mut Vec<Edit>) {
    for (i, t) in tokens.iter().enumerate() {
        let before = i.checked_sub(1).map(|k| &tokens[k].is);
        if !begins(&t.is) || t.is == Lexeme::Minus || matches!(before, Some(Lexeme::Function(_))) {
            continue;
        }
        for name in own.0.values() {
            let what = format!("the factor `{}` is missing before `{}`", name.text, t.text);
            edits.push(Edit::new(Slip::Missing, i..i, vec![name.clone()], what));
        }
    }
}

#[cfg(test)]
mod tests;
