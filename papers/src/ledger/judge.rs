//! Judges the printed equations of a paper.

use super::labels::{Member, shifted};
use super::witness::witness;
use crate::exact::arithmetic::Arithmetic;
use crate::exact::derived::derived;
use crate::exact::forms::Forms;
use crate::exact::print::expanded;
use crate::exact::reader::Reader;
use crate::exact::truth::{Form, Truth};
use crate::file::{About, Equation, Paper};
use crate::latex::formula::{Formula, Piece, formula};
use crate::latex::lexer::{Token, lex};
use crate::latex::parser::{parse, parse_tokens};
use crate::mend::{Inventory, Search, mend, written};
use crate::verdict::{Entry, Kind, Verdict};

/// What an equation should be: a matrix of formulas.
///
/// # Errors
/// Why that cannot be derived.
pub fn truth(paper: &Paper, equation: &Equation) -> Result<Truth, String> {
    let setting = &equation.setting;
    let mut forms = Forms::new(&setting.defined, &setting.infinite)?;
    for (name, path) in &equation.lets {
        let value = derived(&path.text, setting, paper.shared(), &forms)?;
        forms.names.insert(name.clone(), *value.get(0).ok_or("an empty matrix")?);
    }
    let written = match &equation.about {
        About::Path(path) => {
            let derived = derived(&path.text, setting, paper.shared(), &forms)?;
            return forms.truth_of(&derived);
        }
        About::Formula(written) => written,
        About::Definition(_) | About::Relation(_) | About::Nothing => {
            return Err("there is nothing to derive".into());
        }
    };
    let side = formula(&written.text).sides.into_iter().next().ok_or("the truth is empty")?;
    let entry = |cell: &Piece| {
        let tree = parse(&cell.text, &paper.notation).map_err(|m| m.message)?;
        Ok::<_, String>(forms.tree(&tree)?)
    };
    let entries = side.rows.iter().flatten().map(entry).collect::<Result<_, _>>()?;
    forms.truth(side.rows.first().map_or(0, Vec::len), entries)
}

/// An equation made ready: its tokens, cell by cell, and what they should be.
struct Ready<'p> {
    equation: &'p Equation,
    printed: Formula,
    /// Per side, per cell.
    tokens: Vec<Vec<Vec<Token>>>,
    truth: Result<Truth, String>,
}

/// Judges every equation of a paper, in order.
pub fn equations(paper: &Paper) -> Vec<Entry> {
    let mut inventory = Inventory::default();
    let ready: Vec<Ready<'_>> = paper
        .equations
        .iter()
        .map(|equation| {
            let nothing = !matches!(equation.about, About::Path(_) | About::Formula(_));
            let printed = formula(&equation.latex.text);
            let cells = |side: &crate::latex::formula::Side| {
                let cells = side.rows.iter().flatten();
                cells.map(|c| lex(&c.text, &paper.notation).unwrap_or_default()).collect()
            };
            let tokens: Vec<Vec<Vec<Token>>> =
                if nothing { Vec::new() } else { printed.sides.iter().map(cells).collect() };
            tokens.iter().flatten().for_each(|cell| inventory.add(cell));
            let truth = if nothing { Err(String::new()) } else { truth(paper, equation) };
            Ready { equation, printed, tokens, truth }
        })
        .collect();
    stiffarm_infer::parallel::map(ready.len(), &|at| entry(paper, &ready, at, &inventory))
}

fn entry(paper: &Paper, ready: &[Ready<'_>], at: usize, inventory: &Inventory) -> Entry {
    let this = &ready[at];
    let equation = this.equation;
    let printed = equation.printed.as_ref().unwrap_or(&equation.latex.text);
    let printed = printed.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut entry = Entry::new(&paper.id, &equation.number, Kind::Equation, &printed);
    entry.note = equation.note.clone();
    entry.source = match &equation.about {
        About::Nothing => String::new(),
        About::Relation(relation) => relation.words(),
        About::Definition(why) => why.clone(),
        About::Path(path) => match (&equation.setting.robot, equation.setting.product.is_empty()) {
            (_, false) => format!("{} of {}", path.text, equation.setting.product.join(" ")),
            (Some(robot), _) => format!("{} of {robot}", path.text),
            (None, _) => path.text.clone(),
        },
        About::Formula(written) => {
            let lets = equation.lets.iter().map(|(name, path)| format!("{name} = {}", path.text));
            let mut parts = vec![written.text.split_whitespace().collect::<Vec<_>>().join(" ")];
            parts.extend(lets);
            parts.join(", ")
        }
    };
    let truth = match (&equation.about, &this.truth) {
        (About::Definition(_) | About::Nothing, _) => return entry,
        (About::Relation(relation), _) => {
            let (setting, shared) = (&equation.setting, paper.shared());
            let latex = &equation.latex.text;
            crate::matrix::judge(&mut entry, latex, relation, setting, shared, &paper.values);
            return entry;
        }
        (_, Err(why)) => {
            entry.not_judged(why.clone());
            return entry;
        }
        (_, Ok(truth)) => truth,
    };
    let read = Reader::new(&paper.notation, truth);
    let mut corrections = Vec::new();
    let mut changes = Vec::new();
    entry.verdict = Verdict::Agrees;
    for (side, cells) in this.printed.sides.iter().zip(&this.tokens) {
        let columns = side.rows.first().map_or(0, Vec::len);
        if cells.len() != truth.entries.len() || columns != truth.columns {
            entry.not_judged(format!(
                "printed are {} entries in {columns} columns, derived {} in {}",
                cells.len(),
                truth.entries.len(),
                truth.columns
            ));
            return entry;
        }
        let pieces = side.rows.iter().flatten();
        let each = cells.iter().zip(&truth.entries).zip(pieces).enumerate();
        for (k, ((tokens, wanted), piece)) in each {
            let wanted = truth.form(*wanted);
            match read.agrees(tokens, wanted) {
                Some(Verdict::AgreesAtPoints) if entry.verdict == Verdict::Agrees => {
                    entry.verdict = Verdict::AgreesAtPoints;
                }
                Some(_) => {}
                None => {
                    let place = match side.matrix {
                        true => format!("entry {},{}: ", k / columns + 1, k % columns + 1),
                        false => String::new(),
                    };
                    let end = piece.text.len();
                    let tree = parse_tokens(tokens, &paper.notation, end);
                    if entry.witness.is_none() {
                        entry.witness = tree
                            .as_ref()
                            .ok()
                            .and_then(|tree| witness(tree, wanted, truth, &paper.values));
                    }
                    let stated =
                        equation.correct.as_ref().map(|w| w.text.as_str()).filter(|text| {
                            lex(text, &paper.notation).is_ok_and(|t| read.is(&t, wanted))
                        });
                    // What the data file states is better than a patchwork of slips.
                    let single =
                        |(.., slips): &(String, String, usize)| *slips == 1 || stated.is_none();
                    let found = label(ready, at, &read).or_else(|| {
                        let small = small(tokens, wanted, &read, inventory).filter(single);
                        small.map(|(mended, change, _)| (mended, change))
                    });
                    if entry.verdict != Verdict::Unreadable {
                        entry.verdict = Verdict::Misprint;
                    }
                    match found {
                        Some((correction, change)) => {
                            corrections.push(format!("{place}{correction}"));
                            changes.push(format!("{place}{change}"));
                        }
                        None => {
                            let derived = || {
                                let text = expanded(wanted, &paper.notation, inventory);
                                text.unwrap_or_else(|why| format!("what is derived: {why}"))
                            };
                            let whole = stated.map_or_else(derived, str::to_owned);
                            corrections.push(format!("{place}{whole}"));
                            if let Err(mistake) = &tree {
                                entry.verdict = Verdict::Unreadable;
                                let at = mistake.clone().moved(piece.at);
                                let at = at.located(&equation.number, &equation.latex.text);
                                changes.push(format!("{place}{at}"));
                            }
                        }
                    }
                }
            }
        }
    }
    let left = match this.printed.left.as_str() {
        "" => String::new(),
        left => format!("{left} = "),
    };
    if matches!(entry.verdict, Verdict::Misprint | Verdict::Unreadable) {
        entry.correction = Some(format!("{left}{}", corrections.join("; ")));
        entry.change = (!changes.is_empty()).then(|| changes.join("; "));
    }
    entry
}

/// A slipped label among the equations of the same group.
fn label(ready: &[Ready<'_>], at: usize, read: &Reader<'_>) -> Option<(String, String)> {
    let group = ready[at].equation.group.as_ref()?;
    let mut own = None;
    let mut members = Vec::new();
    for (k, other) in ready.iter().enumerate() {
        let (Ok(truth), [cells]) = (&other.truth, other.tokens.as_slice()) else { continue };
        let ([tokens], [entry]) = (cells.as_slice(), truth.entries.as_slice()) else { continue };
        if other.equation.group.as_ref() == Some(group) {
            if k == at {
                own = Some(members.len());
            }
            let (number, truth) = (&other.equation.number, truth.form(*entry));
            members.push(Member { number, tokens, truth });
        }
    }
    shifted(&members, own?, read)
}

/// The smallest change of the tokens: what they then are, what was changed, how many slips that is.
fn small(
    tokens: &[Token],
    truth: Form<'_>,
    read: &Reader<'_>,
    inventory: &Inventory,
) -> Option<(String, String, usize)> {
    let search = Search { tokens, inventory, read, truth };
    let edits = mend(&search, |tokens| read.is(tokens, truth))?;
    let all: Vec<_> = edits.iter().collect();
    let mended = written(&crate::mend::apply(tokens, &all));
    let change: Vec<String> =
        edits.iter().map(|e| format!("{}: {}", e.slip.name(), e.what)).collect();
    Some((mended, change.join(", "), edits.len()))
}
