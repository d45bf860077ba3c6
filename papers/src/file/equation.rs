//! A printed equation of a data file.

use ::serde::Deserialize;

use super::formulas::{definitions, symbol, tree};
use super::notes::{Named, Notes, Text, plain};
use super::{About, Equation};
use crate::exact::derived::Setting;
use crate::latex::formula::{Piece, formula};
use crate::latex::lexer::lex;
use crate::latex::notation::Notation;
use crate::latex::parser::{collect, parse};
use crate::latex::tree::{Angle, Tree};
use crate::matrix::{self, Relation};

/// An equation as it is written in the file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Written {
    number: Text,
    latex: Option<Text>,
    of: Option<Text>,
    truth: Option<Text>,
    #[serde(default)]
    matrices: Named<Text>,
    definition: Option<Text>,
    robot: Option<Text>,
    joints: Option<Vec<Text>>,
    #[serde(default)]
    wrench: Vec<Text>,
    #[serde(default)]
    product: Vec<Text>,
    #[serde(default, rename = "let")]
    lets: Named<Text>,
    #[serde(default, rename = "where")]
    defined: Named<Text>,
    #[serde(default)]
    infinite: Vec<Text>,
    group: Option<Text>,
    note: Option<Text>,
    correct: Option<Text>,
    printed: Option<Text>,
}

/// Reads an equation; one that is not `printed` has no LaTeX.
pub(super) fn read(
    written: Written,
    printed: bool,
    shared: &[(String, Tree)],
    notation: &Notation,
    notes: &mut Notes<'_>,
) -> Equation {
    let number = notes.piece(&written.number);
    if printed && written.latex.is_none() {
        notes.wrong(number.place(), "`latex` is missing here");
    }
    let piece =
        |text: &Option<Text>, notes: &Notes<'_>| text.as_ref().map(|text| notes.piece(text));
    let latex = piece(&written.latex, notes).unwrap_or_default();
    let truth = piece(&written.truth, notes);
    let mut matrices = Vec::new();
    for (symbol, source) in &written.matrices {
        let symbol = notes.piece(symbol);
        if matrix::single(&symbol.text).is_none() {
            let message = format!("`{}` is no symbol of a matrix", symbol.text);
            notes.wrong(symbol.place(), message);
        }
        matrices.push((symbol.text, notes.piece(source)));
    }
    let (truth, relation) = match matrices.is_empty() {
        true => (truth.map(About::Formula), None),
        false => (None, Some(About::Relation(Relation { matrices, truth }))),
    };
    let path = piece(&written.of, notes).map(About::Path);
    let definition = plain(written.definition).map(About::Definition);
    let mut given = [path, truth, relation, definition].into_iter().flatten();
    let about = given.next();
    if about.is_none() || given.next().is_some() {
        let message = "an equation has one of `of`, `truth`, `matrices` and `definition`";
        notes.wrong(number.place(), message);
    }
    check(&latex, about.as_ref(), notation, notes);
    let pieces = |texts: &[Text], notes: &Notes<'_>| -> Vec<Piece> {
        texts.iter().map(|text| notes.piece(text)).collect()
    };
    let joints = written.joints.map(|joints| pieces(&joints, notes));
    let joints = joints
        .map(|joints| joints.iter().filter_map(|joint| angle(joint, notation, notes)).collect());
    let wrench = pieces(&written.wrench, notes);
    let wrench = wrench.iter().filter_map(|w| tree(w, notation, notes)).collect();
    let infinite = pieces(&written.infinite, notes);
    let infinite = infinite.iter().filter_map(|w| symbol(w, notation, notes)).collect();
    let mut lets = Vec::new();
    for (name, path) in &written.lets {
        let (name, path) = (notes.piece(name), notes.piece(path));
        lets.extend(symbol(&name, notation, notes).map(|name| (name, path)));
    }
    let setting = Setting {
        robot: plain(written.robot),
        joints,
        wrench,
        product: pieces(&written.product, notes).into_iter().map(|w| w.text).collect(),
        defined: definitions(&written.defined, shared, notation, notes),
        infinite,
    };
    Equation {
        number: number.text,
        latex,
        about: about.unwrap_or_default(),
        setting,
        lets,
        group: plain(written.group),
        note: plain(written.note),
        printed: plain(written.printed),
        correct: piece(&written.correct, notes),
    }
}

/// What is printed must be made of tokens (whether they make a formula is for the judgement: a
/// bracket may be missing on paper); a truth must be a formula.
fn check(latex: &Piece, about: Option<&About>, notation: &Notation, notes: &mut Notes<'_>) {
    let cells = |text: &str| {
        let sides = formula(text).sides.into_iter();
        sides.flat_map(|side| side.rows).flatten().collect::<Vec<Piece>>()
    };
    if matches!(about, Some(About::Path(_) | About::Formula(_))) {
        for cell in cells(&latex.text) {
            if let Err(mistake) = lex(&cell.text, notation) {
                notes.mistakes.push(mistake.moved(latex.at + cell.at));
            }
        }
    }
    if let Some(About::Relation(relation)) = about {
        let given = relation.matrices.iter().filter_map(|(_, source)| {
            let text = source.text.strip_prefix('=')?;
            Some(Piece { text: text.to_owned(), at: source.at + 1 })
        });
        let given: Vec<Piece> = given.collect();
        for written in core::iter::once(latex).chain(&relation.truth).chain(&given) {
            if let Err(mistake) = matrix::read(&written.text) {
                notes.mistakes.push(mistake.moved(written.at));
            }
        }
    }
    if let Some(About::Formula(truth)) = about {
        for cell in cells(&truth.text) {
            if let Err(mistake) = parse(&cell.text, notation) {
                notes.mistakes.push(mistake.moved(truth.at + cell.at));
            }
        }
    }
}

fn angle(w: &Piece, notation: &Notation, notes: &mut Notes<'_>) -> Option<Angle> {
    let tree = tree(w, notation, notes)?;
    let mut angle = Angle::default();
    if !collect(&tree, 1.into(), &mut angle) {
        notes.wrong(w.place(), "this is no sum of angles");
    }
    Some(angle)
}
