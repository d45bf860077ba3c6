//! Relations between matrices: there is no exact form to compare, so both sides are evaluated at
//! random points, with derived quantities of a robot among their symbols.

mod dense;
mod evaluate;
mod mend;
mod parse;
mod relation;
mod source;
mod transform;
mod tree;

use std::collections::HashMap;

use dense::{Dense, is_scalar, plus};
use evaluate::Point;
use source::Sources;
use tree::Tree;

pub(super) use parse::{is_symbol, sides};
pub use relation::Relation;

use crate::exact::derived::Setting;
use crate::verdict::{Entry, Verdict};

/// Points at which a relation is evaluated.
const POINTS: u64 = 4;

/// Sides differ by no more than this part of the larger: derivatives err by 1e-12 (see `evaluate`),
/// inverses of random matrices lose up to four digits.
const TOLERANCE: f64 = 1e-8;

/// At most so many pairs of slips are tried.
const PAIRS: usize = 60_000;

/// What a relation must fulfil, and the symbols in it.
struct Question<'r> {
    relation: &'r Relation,
    sources: Sources,
    truth: Vec<Tree>,
    /// The printed left side, if it is a symbol that the truth may use.
    left: Option<String>,
}

/// Judges a printed relation.
pub(super) fn judge(
    entry: &mut Entry,
    latex: &str,
    relation: &Relation,
    setting: &Setting,
    given: &HashMap<String, f64>,
) {
    entry.source = relation.words();
    match verdict(entry, latex, relation, setting, given) {
        Ok(()) => {}
        Err(why) => {
            entry.verdict = Verdict::NotJudged;
            entry.note = Some(why);
        }
    }
}

fn verdict(
    entry: &mut Entry,
    latex: &str,
    relation: &Relation,
    setting: &Setting,
    given: &HashMap<String, f64>,
) -> Result<(), String> {
    let read = |latex: &str| {
        parse::sides(latex).map_err(|(at, why)| format!("in `{latex}` at character {at}: {why}"))
    };
    let symbols: Vec<(String, String)> = relation
        .matrices
        .iter()
        .map(|(symbol, source)| (symbol.clone(), source.text.clone()))
        .collect();
    let sources = Sources::read(&symbols, setting, given)?;
    let mut printed = read(latex)?;
    let left = match printed.first() {
        Some(Tree::Name(name)) if printed.len() > 1 => Some(name.key(&HashMap::new())),
        _ => None,
    };
    let truth = match &relation.truth {
        Some(truth) => read(&truth.text)?,
        None => vec![printed[0].clone()],
    };
    let head = match printed.len() {
        1 => String::new(),
        _ => {
            printed.remove(0);
            let head = latex.split_once('=').map_or(latex, |(head, _)| head);
            format!("{} = ", head.trim())
        }
    };
    let mut question = Question { relation, sources, truth, left };
    entry.verdict = Verdict::AgreesAtPoints;
    let mut sides = Vec::new();
    let mut changes = Vec::new();
    for side in printed {
        if question.holds(&side)? {
            sides.push(side.latex());
            continue;
        }
        entry.verdict = Verdict::Misprint;
        match question.mend(&side)? {
            Some((mended, what)) => {
                sides.push(mended.latex());
                changes.push(what);
            }
            None => return Err("it does not hold, and no small change of it does".into()),
        }
    }
    if entry.verdict == Verdict::Misprint {
        entry.correction = Some(format!("{head}{}", sides.join(" = ")));
        entry.change = Some(changes.join("; "));
    }
    Ok(())
}

impl Question<'_> {
    /// Whether the relation holds with `side` on its right.
    fn holds(&mut self, side: &Tree) -> Result<bool, String> {
        for at in 1..=POINTS {
            let q = self.sources.go_to(at);
            let mut formulas = self.sources.formulas.clone();
            if let (Some(left), true) = (&self.left, self.relation.truth.is_some()) {
                formulas.insert(left.clone(), side.clone());
            }
            let counted = self.sources.counted.clone();
            let point = Point { symbols: &self.sources, q, counted, formulas };
            // What is printed may not even fit together; the truth must.
            let Ok(printed) = point.matrix(side) else { return Ok(false) };
            let wanted: Vec<Dense> = match (self.truth.as_slice(), self.uses_left()) {
                ([one, rest @ ..], true) => match point.matrix(one) {
                    Ok(one) => {
                        let rest = rest.iter().map(|side| point.matrix(side));
                        core::iter::once(Ok(one)).chain(rest).collect::<Result<_, _>>()?
                    }
                    Err(_) => return Ok(false),
                },
                (sides, _) => {
                    let each = sides.iter().map(|side| point.matrix(side));
                    each.chain([Ok(printed)]).collect::<Result<_, _>>()?
                }
            };
            if !wanted.windows(2).all(|pair| same(&pair[0], &pair[1])) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether the truth is a condition on the printed left side rather than a value of it.
    fn uses_left(&self) -> bool {
        self.truth.len() > 1
    }

    /// The smallest change: one slip, or two.
    fn mend(&mut self, side: &Tree) -> Result<Option<mend::Edit>, String> {
        // The truth itself, where it is a symbol, is no answer.
        let answer = |name: &tree::Name| self.truth == [Tree::Name(name.clone())];
        let known: Vec<tree::Name> =
            self.sources.printed.iter().filter(|name| !answer(name)).cloned().collect();
        let once = mend::edits(side, &known);
        for edit in &once {
            if self.holds(&edit.0)? {
                return Ok(Some(edit.clone()));
            }
        }
        let mut left = PAIRS;
        for (first, what) in once.iter().filter(|(_, what)| of_an_index(what)) {
            for (second, more) in mend::edits(first, &known) {
                left = left.saturating_sub(1);
                if left == 0 {
                    return Ok(None);
                }
                if of_an_index(&more) && self.holds(&second)? {
                    return Ok(Some((second, format!("{what}, {more}"))));
                }
            }
        }
        Ok(None)
    }
}

/// Whether a slip is one of an index: only such are tried in pairs.
fn of_an_index(what: &str) -> bool {
    what.contains(",") || what.contains("\\prod")
}

fn same(a: &Dense, b: &Dense) -> bool {
    // A lone zero stands for zeros of any shape.
    let zero = |m: &Dense| is_scalar(m) && m[(0, 0)] == 0.0;
    let size = a.amax().max(b.amax()).max(1.0);
    if zero(a) || zero(b) {
        return a.amax().max(b.amax()) <= TOLERANCE * size;
    }
    plus(a, b, -1.0).is_some_and(|difference| difference.amax() <= TOLERANCE * size)
}

#[cfg(test)]
mod tests;
