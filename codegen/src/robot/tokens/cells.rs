//! Single cells of the inline table; what does not fit is reported and leaves a broken cell.

use proc_macro2::{Delimiter, TokenTree};

use super::super::dimension::Dimension;
use super::super::draft::{Cell, INERTIA, Vector, broken};
use super::super::lexeme::{Lexeme, extent, show};
use super::super::model::{Angle, Motion, Value};
use super::super::problem::{Place, Problem, Report};
use super::super::symbols::Symbolic;
use super::super::{angle, quantity};
use super::spot::{Spot, flatten, is_sign, words};

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

/// The entries of a bracketed list of exactly `N`.
pub(super) fn list<const N: usize>(
    cell: &Raw,
    expected: &str,
    report: &mut Report<Spot>,
) -> Option<[Raw; N]> {
    let Some(tokens) = group(cell, Delimiter::Bracket) else {
        report.error(Problem::new(cell.at, format!("{expected} is expected here")));
        return None;
    };
    let entries = split(&tokens, ',', cell.at);
    let found = entries.len();
    entries.try_into().ok().or_else(|| {
        let message = format!("a list of {found} where {expected} is expected");
        report.error(Problem::new(cell.at, message));
        None
    })
}

/// A quantity or a parameter.
pub(super) fn value(
    cell: &Raw,
    expected: Dimension,
    report: &mut Report<Spot>,
) -> Cell<Value, Spot> {
    value_of(&words(&cell.tokens), cell.at, expected, report)
}

/// A quantity or a parameter, from its words.
pub(super) fn value_of(
    words: &[Lexeme<Spot>],
    at: Spot,
    expected: Dimension,
    report: &mut Report<Spot>,
) -> Cell<Value, Spot> {
    Cell { value: report.keep(quantity::read(words, expected, &at)), at }
}

/// An angle or a parameter.
pub(super) fn angle(cell: &Raw, report: &mut Report<Spot>) -> Cell<Angle, Spot> {
    angle_of(&words(&cell.tokens), cell.at, report)
}

/// An angle or a parameter, from its words.
pub(super) fn angle_of(
    words: &[Lexeme<Spot>],
    at: Spot,
    report: &mut Report<Spot>,
) -> Cell<Angle, Spot> {
    let read = report.keep(angle::read(words, &at));
    Cell { value: read.map(|read| undoubted(read, report)), at }
}

/// The angle; a doubt about it goes into the report.
fn undoubted((angle, doubt): angle::Doubted<Spot>, report: &mut Report<Spot>) -> Angle {
    doubt.into_iter().for_each(|d| report.warn(d));
    angle
}

/// A joint limit that is an angle.
fn limit(cell: &Raw, report: &mut Report<Spot>) -> Cell<Angle, Spot> {
    let read = report.keep(angle::read(&words(&cell.tokens), &cell.at));
    let value = read.map(|read| undoubted(angle::limit_doubt(read), report));
    Cell { value, at: cell.at }
}

/// The cell, unless it is a parameter where only a number will do.
pub(super) fn known<T: Symbolic>(
    cell: Cell<T, Spot>,
    reason: &str,
    report: &mut Report<Spot>,
) -> Cell<T, Spot> {
    let Some(name) = cell.value.as_ref().and_then(Symbolic::symbol) else { return cell };
    let message = format!("`{name}` stands where a number is expected");
    report.error(Problem::new(cell.at, message).help(reason));
    Cell::broken(cell.at)
}

/// A length that must be a number.
pub(super) fn length(cell: &Raw, reason: &str, report: &mut Report<Spot>) -> Cell<Value, Spot> {
    known(value(cell, Dimension::Length, report), reason, report)
}

/// Three quantities of one dimension.
pub(super) fn values(
    cell: &Raw,
    dimension: Dimension,
    report: &mut Report<Spot>,
) -> Vector<Value, Spot> {
    match list::<3>(cell, "[x, y, z]", report) {
        Some(entries) => entries.each_ref().map(|entry| value(entry, dimension, report)),
        None => broken(&cell.at),
    }
}

/// The six entries of a tensor of inertia.
pub(super) fn inertia(cell: &Raw, report: &mut Report<Spot>) -> [Cell<Value, Spot>; 6] {
    match list::<6>(cell, INERTIA, report) {
        Some(entries) => entries.each_ref().map(|entry| value(entry, Dimension::Inertia, report)),
        None => broken(&cell.at),
    }
}

/// Lengths that must be numbers, and why.
pub(super) fn known_lengths(
    cell: &Raw,
    reason: &str,
    report: &mut Report<Spot>,
) -> Vector<Value, Spot> {
    values(cell, Dimension::Length, report).map(|cell| known(cell, reason, report))
}

/// A frame's rotation vector, which must be numbers.
pub(super) fn rotation(cell: &Raw, report: &mut Report<Spot>) -> Vector<Angle, Spot> {
    let reason = "a frame's rotation cannot stay symbolic";
    match list::<3>(cell, "a rotation vector [rx, ry, rz]", report) {
        Some(entries) => entries.each_ref().map(|e| known(angle(e, report), reason, report)),
        None => broken(&cell.at),
    }
}

/// Joint limits, in radians or metres.
pub(super) fn limits(
    cell: &Raw,
    motion: Motion,
    report: &mut Report<Spot>,
) -> Cell<[f64; 2], Spot> {
    let reason = "joint limits are numbers";
    let Some(entries) = list::<2>(cell, "[lower, upper]", report) else {
        return Cell::broken(cell.at);
    };
    let bounds = entries.each_ref().map(|entry| match motion {
        Motion::Revolute => known(limit(entry, report), reason, report).value?.radians(),
        Motion::Prismatic => Some(length(entry, reason, report).value?.number()?.to_f64()),
    });
    match bounds {
        [Some(lower), Some(upper)] => Cell::new([lower, upper], cell.at),
        _ => Cell::broken(cell.at),
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
