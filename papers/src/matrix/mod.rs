//! Relations between matrices: there is no exact form to compare, so both sides are evaluated at
//! random points, with derived quantities of a robot among their symbols.

mod dense;
mod evaluate;
mod source;
mod transform;

use std::collections::HashMap;

use dense::{Dense, sum};
use evaluate::Point;
use source::{At, Sources};

pub use source::single;

use crate::exact::derived::{Setting, Shared};
use crate::latex::formula::{Piece, sides};
use crate::latex::lexer::{Lexeme, Token, lex};
use crate::latex::mistake::Mistake;
use crate::latex::notation::Notation;
use crate::latex::parser::parse_tokens;
use crate::latex::tree::Tree;
use crate::mend::{Edit, Inventory, Slip, apply, brackets, every_pair, moved_brackets, slips};
use crate::verdict::{Entry, Verdict};

/// Points at which a relation is evaluated.
const POINTS: u64 = 4;

/// Sides differ by no more than this part of the larger: derivatives err by 1e-12 (see `evaluate`),
/// inverses of random matrices lose up to four digits.
const TOLERANCE: f64 = 1e-8;

/// At most so many slips of an index are tried in pairs.
const PAIRED: usize = 300;

/// A printed relation between matrices, as its data file gives it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Relation {
    /// Symbols as printed, and what they stand for.
    pub matrices: Vec<(String, Piece)>,
    /// The value of the left side, or a condition on it; without one the printed left side itself.
    pub truth: Option<Piece>,
}

impl Relation {
    /// What it is compared with, in words.
    pub fn words(&self) -> String {
        let truth = self.truth.iter().map(|truth| truth.text.clone());
        let each =
            self.matrices.iter().map(|(symbol, source)| match source.text.strip_prefix('=') {
                Some(formula) => format!("{symbol} = {}", formula.trim()),
                None => format!("{symbol} is {}", source.text),
            });
        truth.chain(each).collect::<Vec<_>>().join(", ")
    }
}

/// The sides of a relation: their tokens and their trees.
///
/// # Errors
/// The first place that cannot be read.
pub fn read(latex: &str) -> Result<Vec<(Vec<Token>, Tree)>, Mistake> {
    let read = |side: &Piece| {
        let tokens = lex(&side.text, &Notation::MATRICES)?;
        let tree = parse_tokens(&tokens, &Notation::MATRICES, side.text.len())?;
        Ok((tokens, tree))
    };
    let moved = |side: Piece| read(&side).map_err(|mistake: Mistake| mistake.moved(side.at));
    sides(latex).into_iter().map(moved).collect()
}

/// What a relation must fulfil, and the symbols in it.
struct Question<'r> {
    relation: &'r Relation,
    sources: Sources,
    truth: Vec<Tree>,
    /// The printed left side, if it is a symbol that the truth may use.
    left: Option<String>,
}

/// Judges a printed relation; `given` are values of the data file.
pub(super) fn judge(
    entry: &mut Entry,
    latex: &str,
    relation: &Relation,
    setting: &Setting,
    shared: Shared<'_>,
    given: &HashMap<String, f64>,
) {
    entry.source = relation.words();
    let sources = Sources::read(&relation.matrices, setting, shared, given);
    if let Err(why) = sources.and_then(|sources| verdict(entry, latex, relation, sources)) {
        entry.not_judged(why);
    }
}

fn verdict(
    entry: &mut Entry,
    latex: &str,
    relation: &Relation,
    sources: Sources,
) -> Result<(), String> {
    let words = |mistake: Mistake| mistake.message;
    let mut printed = read(latex).map_err(words)?;
    let left = match &printed[..] {
        [(_, Tree::Symbol(name)), _, ..] => Some(name.counted(&HashMap::new())),
        _ => None,
    };
    let truth = match &relation.truth {
        Some(truth) => read(&truth.text).map_err(words)?.into_iter().map(|side| side.1).collect(),
        None => vec![printed[0].1.clone()],
    };
    let head = match printed.len() {
        1 => String::new(),
        _ => {
            printed.remove(0);
            let head = latex.split_once('=').map_or(latex, |(head, _)| head);
            format!("{} = ", head.trim())
        }
    };
    let question = Question { relation, sources, truth, left };
    entry.verdict = Verdict::AgreesAtPoints;
    let mut sides = Vec::new();
    let mut changes = Vec::new();
    for (tokens, tree) in printed {
        if question.holds(&tree)? {
            sides.push(tree.latex());
            continue;
        }
        entry.verdict = Verdict::Misprint;
        let trees = question.mend(&tokens, &tree);
        let trees = trees.ok_or("it does not hold, and no small change of it does")?;
        let change = |pair: &[Tree]| {
            let (from, to) = pair[0].difference(&pair[1]);
            format!("`{}` → `{}`", from.latex().trim(), to.latex().trim())
        };
        sides.extend(trees.last().map(Tree::latex));
        changes.push(trees.windows(2).map(change).collect::<Vec<_>>().join(", "));
    }
    if entry.verdict == Verdict::Misprint {
        entry.correction = Some(format!("{head}{}", sides.join(" = ")));
        entry.change = Some(changes.join("; "));
    }
    Ok(())
}

impl Question<'_> {
    /// Whether the relation holds with `side` on its right.
    fn holds(&self, side: &Tree) -> Result<bool, String> {
        for at in 1..=POINTS {
            let at = At(&self.sources, at);
            let mut formulas = self.sources.formulas.clone();
            if let (Some(left), true) = (&self.left, self.relation.truth.is_some()) {
                formulas.insert(left.clone(), side.clone());
            }
            let counted = self.sources.counted.clone();
            let point = Point { symbols: &at, q: at.posture(), counted, formulas };
            // What is printed may not even fit together; the truth must.
            let Ok(printed) = point.matrix(side) else { return Ok(false) };
            let wanted: Vec<Dense> = match self.truth.as_slice() {
                // A condition on the printed left side rather than a value of it.
                [one, rest @ ..] if !rest.is_empty() => match point.matrix(one) {
                    Ok(one) => {
                        let rest = rest.iter().map(|side| point.matrix(side));
                        core::iter::once(Ok(one)).chain(rest).collect::<Result<_, _>>()?
                    }
                    Err(_) => return Ok(false),
                },
                sides => {
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

    /// The smallest change, one slip or two of an index: what is printed, with the first slip
    /// mended, with both.
    fn mend(&self, tokens: &[Token], printed: &Tree) -> Option<Vec<Tree>> {
        let mut known = Inventory::default();
        for token in &self.sources.printed {
            let Lexeme::Name(name) = &token.is else { continue };
            // The truth itself, where it is a symbol, is no answer.
            let answer = self.truth == [Tree::Symbol(name.clone())];
            if !answer && !name.is_family() {
                known.add(core::slice::from_ref(token));
            }
        }
        let mended = |edits: &[&Edit]| {
            let tokens = apply(tokens, edits);
            parse_tokens(&tokens, &Notation::MATRICES, 0).ok()
        };
        let holds = |edits: &[&Edit]| mended(edits).is_some_and(|t| self.holds(&t) == Ok(true));
        let single = slips(tokens, &Notation::MATRICES, &known, &known);
        let (bracket, moved) = (brackets(tokens), moved_brackets(tokens));
        let one = single.iter().chain(&bracket).chain(&moved).find(|edit| holds(&[edit]));
        let found = one.map(|edit| vec![edit]).or_else(|| {
            let index = single.iter().filter(|edit| edit.slip == Slip::Index).take(PAIRED);
            every_pair(index, &holds)
        })?;
        let steps = (1..=found.len()).map(|count| mended(&found[..count]));
        core::iter::once(Some(printed.clone())).chain(steps).collect()
    }
}

fn same(a: &Dense, b: &Dense) -> bool {
    let size = a.amax().max(b.amax()).max(1.0);
    // Either may be a lone zero, which stands for zeros of any shape.
    let difference = sum(a, b, -1.0).or_else(|_| sum(b, a, -1.0));
    difference.is_ok_and(|difference| difference.amax() <= TOLERANCE * size)
}

#[cfg(test)]
mod tests;
