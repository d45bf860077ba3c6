//! Single cells of the inline table as values with their places.

use proc_macro2::{Delimiter, TokenTree};
use syn::LitStr;

use super::spot::{Spot, flatten, is_sign, words};
use crate::robot::lexeme::{Lexeme, extent, show};
use crate::robot::problem::{Place, Problem};
use crate::schema::{Content, Node};

/// The tokens of a cell and their place; an empty cell has the place of its separator.
#[derive(Clone, Debug)]
pub(super) struct Raw {
    /// The tokens.
    pub tokens: Vec<TokenTree>,
    /// Their place.
    pub at: Spot,
}

impl Raw {
    /// The cell of these tokens; `empty` is its place if there are none.
    pub fn new(tokens: Vec<TokenTree>, empty: Spot) -> Self {
        let at = Spot::of(&tokens, empty);
        Raw { tokens, at }
    }

    /// Whether the cell says that it is absent.
    pub fn is_absent(&self) -> bool {
        matches!(self.tokens.as_slice(), [token] if is_sign(token, '-'))
    }
}

/// Splits tokens at a sign that stands between two cells; a last empty cell after a comma is none.
pub(super) fn split(tokens: &[TokenTree], sign: char, empty: Spot) -> Vec<Raw> {
    let mut cells = Vec::new();
    let mut place = empty;
    for part in tokens.split_inclusive(|token| is_sign(token, sign)) {
        let (cell, separator) = match part.split_last() {
            Some((last, cell)) if is_sign(last, sign) => (cell, Spot::new(last.span())),
            _ => (part, place),
        };
        place = separator;
        cells.push(Raw::new(cell.to_vec(), place));
    }
    if sign == '|' && tokens.last().is_some_and(|token| is_sign(token, sign)) {
        cells.push(Raw::new(Vec::new(), place));
    }
    cells
}

/// The content of a cell that is one group in these brackets.
pub(super) fn group(cell: &Raw, delimiter: Delimiter) -> Option<Vec<TokenTree>> {
    match cell.tokens.as_slice() {
        [TokenTree::Group(group)] if group.delimiter() == delimiter => {
            Some(flatten(group.stream()))
        }
        _ => None,
    }
}

/// The value that a cell holds: a list in brackets, a text in quotes, or words.
pub(super) fn node(cell: &Raw) -> Node<Spot> {
    let content = match (group(cell, Delimiter::Bracket), quoted(&cell.tokens)) {
        (Some(entries), _) => {
            Content::List(split(&entries, ',', cell.at).iter().map(node).collect())
        }
        (None, Some(text)) => Content::Text(text),
        (None, None) => Content::Cell,
    };
    Node { at: cell.at, kind: None, words: Some(words(&cell.tokens)), content }
}

/// The text of a string in quotes.
fn quoted(tokens: &[TokenTree]) -> Option<String> {
    let [TokenTree::Literal(literal)] = tokens else { return None };
    let tokens = TokenTree::from(literal.clone()).into();
    syn::parse2::<LitStr>(tokens).ok().map(|text| text.value())
}

/// A name, in quotes or without.
pub(super) fn name(cell: &Raw) -> Node<Spot> {
    match cell.tokens.as_slice() {
        [TokenTree::Ident(name)] => Node::text(&cell.at, name.to_string()),
        _ => node(cell),
    }
}

/// Where the joint variable stands in a cell, and what is added to it.
pub(super) struct Variable {
    /// The place of `q`, if it stands here.
    pub q: Option<Spot>,
    /// What is added to it, with its sign; empty for nothing. The whole cell if there is no `q`.
    pub offset: Vec<Lexeme<Spot>>,
}

/// Reads `q`, `q + offset`, `q - offset`, `offset + q`, or a cell without `q`.
pub(super) fn variable(words: Vec<Lexeme<Spot>>) -> Result<Variable, Problem<Spot>> {
    let places: Vec<usize> = (0..words.len()).filter(|i| words[*i].name() == Some("q")).collect();
    let (first, q) = match places.as_slice() {
        [] => return Ok(Variable { q: None, offset: words }),
        [first] => (*first, words[*first].at),
        [_, second, ..] => {
            return Err(Problem::new(words[*second].at, "`q` stands here for the second time"));
        }
    };
    let (before, after) = (&words[..first], &words[first + 1..]);
    let offset = match (before, after) {
        ([], []) => Vec::new(),
        ([], [sign, rest @ ..]) if sign.is('+') && !rest.is_empty() => rest.to_vec(),
        ([], [sign, rest @ ..]) if sign.is('-') && !rest.is_empty() => after.to_vec(),
        ([rest @ .., sign], []) if sign.is('+') && !rest.is_empty() => rest.to_vec(),
        _ => {
            let whole = extent(&words).map_or(q, |at| q.to(&at));
            let message = format!("`{}` is no offset of the joint variable", show(&words));
            let help = "`q` stands alone or with one offset: `q + pi/2`, `q - 0.3 m`; a joint that \
                        counts the other way has its axis turned over by alpha";
            let at = Spot { start: words[0].at.start, end: whole.end };
            return Err(Problem::new(at, message).help(help));
        }
    };
    Ok(Variable { q: Some(q), offset })
}
