//! Labels that have slipped: the right formula stands in the same group, under another label, run
//! together with its neighbour, or in two halves.

use crate::exact::reader::Reader;
use crate::exact::truth::Form;
use crate::latex::lexer::Token;
use crate::mend::written;

/// An equation of a group.
pub struct Member<'a> {
    /// Its number.
    pub number: &'a str,
    /// As printed.
    pub tokens: &'a [Token],
    /// What it should be.
    pub truth: Form<'a>,
}

/// What should stand at member `at`, found elsewhere in the group, and where.
pub fn shifted(members: &[Member<'_>], at: usize, read: &Reader<'_>) -> Option<(String, String)> {
    let truth = members[at].truth;
    if truth.is_zero() {
        return None;
    }
    let own = |k: usize| if k == at { "its own label" } else { members[k].number };
    for (k, member) in members.iter().enumerate() {
        let (text, place) = if k != at && read.is(member.tokens, truth) {
            (written(member.tokens), format!("stands under {}", member.number))
        } else if let Some((piece, which)) = part(member.tokens, truth, read) {
            (written(piece), format!("is the {which} part of what stands under {}", own(k)))
        } else {
            continue;
        };
        return Some((text, format!("label shifted: the right formula {place}")));
    }
    for pair in members.windows(2) {
        let mut both = pair[0].tokens.to_vec();
        if !matches!(
            pair[1].tokens.first().map(|t| &t.is),
            Some(crate::latex::lexer::Lexeme::Minus)
        ) {
            continue;
        }
        both.extend_from_slice(pair[1].tokens);
        if read.is(&both, truth) {
            let (first, second) = (pair[0].number, pair[1].number);
            let change = format!(
                "label shifted: the right formula is cut in two, under {first} and {second}"
            );
            return Some((written(&both), change));
        }
    }
    None
}

/// A head or a tail that is the right formula, where two have run together.
fn part<'t>(
    tokens: &'t [Token],
    truth: Form<'_>,
    read: &Reader<'_>,
) -> Option<(&'t [Token], &'static str)> {
    for cut in 1..tokens.len() {
        let (head, tail) = tokens.split_at(cut);
        if read.seems(head, truth) && read.seems(tail, truth) {
            continue;
        }
        if read.is(head, truth) && read.tree(tail).is_some() && !starts_sum(tail) {
            return Some((head, "first"));
        }
        if read.is(tail, truth) && read.tree(head).is_some() && !starts_sum(tail) {
            return Some((tail, "second"));
        }
    }
    None
}

/// Where a sign joins the two parts they are one sum, not two formulas.
fn starts_sum(tokens: &[Token]) -> bool {
    use crate::latex::lexer::Lexeme::{Minus, Plus};
    matches!(tokens.first().map(|t| &t.is), Some(Plus | Minus))
}
