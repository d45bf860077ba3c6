//! A printed equation of a data file.

use std::collections::HashMap;

use super::formulas::{definitions, exact, symbol, tree};
use super::section::{Notes, Section, string};
use super::{About, Equation};
use crate::exact::derived::Setting;
use crate::exact::rational::Rational;
use crate::latex::formula::{Piece, formula};
use crate::latex::lexer::lex;
use crate::latex::notation::Notation;
use crate::latex::parser::{collect, parse};
use crate::latex::tree::Angle;
use crate::matrix::{self, Relation};

/// The keys of an equation.
pub(super) const KEYS: &[&str] = &[
    "number",
    "latex",
    "of",
    "truth",
    "matrices",
    "definition",
    "robot",
    "joints",
    "wrench",
    "product",
    "let",
    "where",
    "infinite",
    "group",
    "note",
    "correct",
    "printed",
];

/// Reads an equation; one that is not `printed` has no LaTeX.
pub(super) fn read(
    section: &Section<'_, '_>,
    printed: bool,
    shared: &HashMap<String, Rational>,
    notation: &Notation,
    notes: &mut Notes<'_>,
) -> Option<Equation> {
    let number = section.required("number", notes)?.text;
    let latex = match printed {
        true => section.required("latex", notes)?,
        false => Piece::default(),
    };
    let defined = definitions(section, shared, notation, notes);
    let path = section.string("of", notes).map(About::Path);
    let mut matrices = Vec::new();
    if let Some(symbols) = section.section("matrices", &[], notes) {
        for (symbol, value) in symbols.entries() {
            if matrix::single(&symbol.text).is_none() {
                let message = format!("`{}` is no symbol of a matrix", symbol.text);
                notes.wrong(symbol.place(), message);
            }
            matrices.extend(string(value, notes).map(|source| (symbol.text, source)));
        }
    }
    let truth = section.string("truth", notes);
    let (truth, relation) = match matrices.is_empty() {
        true => (truth.map(About::Formula), None),
        false => (None, Some(About::Relation(Relation { matrices, truth }))),
    };
    let definition = section.string("definition", notes).map(|w| About::Definition(w.text));
    let mut given = [path, truth, relation, definition].into_iter().flatten();
    let about = given.next();
    if about.is_none() || given.next().is_some() {
        notes.wrong(
            section.at(),
            "an equation has one of `of`, `truth`, `matrices` and `definition`",
        );
    }
    check(&latex, about.as_ref(), notation, notes);
    let mut joints = None;
    if let Some(written) = section.strings("joints", notes) {
        joints = Some(written.iter().filter_map(|w| angle(w, notation, notes)).collect());
    }
    let wrench = section.strings("wrench", notes).unwrap_or_default();
    let wrench = wrench.iter().filter_map(|w| exact(w, notation, &defined, notes)).collect();
    let mut lets = Vec::new();
    if let Some(names) = section.section("let", &[], notes) {
        for (name, value) in names.entries() {
            let name = symbol(&name, notation, notes);
            if let (Some(name), Some(path)) = (name, string(value, notes)) {
                lets.push((name, path));
            }
        }
    }
    let infinite = section.strings("infinite", notes).unwrap_or_default();
    let infinite = infinite.iter().filter_map(|w| symbol(w, notation, notes)).collect();
    let product = section.strings("product", notes).unwrap_or_default();
    let setting = Setting {
        robot: section.string("robot", notes).map(|w| w.text),
        joints,
        wrench,
        product: product.into_iter().map(|w| w.text).collect(),
        defined,
        infinite,
    };
    Some(Equation {
        number,
        latex,
        about: about.unwrap_or_default(),
        setting,
        lets,
        group: section.string("group", notes).map(|w| w.text),
        note: section.string("note", notes).map(|w| w.text),
        printed: section.string("printed", notes).map(|w| w.text),
        correct: section.string("correct", notes),
    })
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
