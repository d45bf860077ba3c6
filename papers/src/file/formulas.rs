//! Symbols and formulas of a data file.

use std::collections::HashMap;

use super::section::{Notes, Section, string};
use crate::exact::evaluate::Arithmetic;
use crate::exact::rational::{Exact, Rational};
use crate::latex::formula::Piece;
use crate::latex::lexer::{Lexeme, lex};
use crate::latex::notation::Notation;
use crate::latex::parser::parse;
use crate::latex::tree::Tree;

/// The name of a single printed symbol.
pub(super) fn symbol(w: &Piece, notation: &Notation, notes: &mut Notes<'_>) -> Option<String> {
    let at = w.place();
    match lex(&w.text, notation).as_deref() {
        Ok([token]) => {
            if let Lexeme::Name(name) = &token.is {
                return Some(name.key.clone());
            }
            notes.wrong(at, format!("`{}` is no symbol", w.text));
        }
        Ok(_) => notes.wrong(at, format!("`{}` is not one symbol", w.text)),
        Err(mistake) => notes.mistakes.push(mistake.clone().moved(w.at)),
    }
    None
}

/// A formula of the file.
pub(super) fn tree(w: &Piece, notation: &Notation, notes: &mut Notes<'_>) -> Option<Tree> {
    parse(&w.text, notation).map_err(|mistake| notes.mistakes.push(mistake.moved(w.at))).ok()
}

pub(super) fn exact(
    w: &Piece,
    notation: &Notation,
    defined: &HashMap<String, Rational>,
    notes: &mut Notes<'_>,
) -> Option<Rational> {
    let tree = tree(w, notation, notes)?;
    let exact = Exact(defined).tree(&tree);
    exact.map_err(|why| notes.wrong(w.place(), format!("this has no exact form: {why:?}"))).ok()
}

/// The `where` of a table on top of what is defined already; a definition may use another.
pub(super) fn definitions(
    section: &Section<'_, '_>,
    outer: &HashMap<String, Rational>,
    notation: &Notation,
    notes: &mut Notes<'_>,
) -> HashMap<String, Rational> {
    let mut defined = outer.clone();
    let Some(section) = section.section("where", &[], notes) else { return defined };
    let mut open = Vec::new();
    for (name, value) in section.entries() {
        let name = symbol(&name, notation, notes);
        let (Some(name), Some(value)) = (name, string(value, notes)) else { continue };
        let Some(tree) = tree(&value, notation, notes) else { continue };
        open.push((name, value, tree));
    }
    while !open.is_empty() {
        let names: Vec<String> = open.iter().map(|(name, ..)| name.clone()).collect();
        let before = open.len();
        let mut waiting = Vec::new();
        for (name, value, tree) in open {
            let mut waits = false;
            tree.each_name(&mut |used, _| waits |= names.iter().any(|n| n == used));
            if waits {
                waiting.push((name, value, tree));
            } else if let Some(exact) = exact(&value, notation, &defined, notes) {
                defined.insert(name, exact);
            }
        }
        if waiting.len() == before {
            for (_, value, _) in &waiting {
                notes.wrong(value.place(), "this definition goes round in a circle");
            }
            break;
        }
        open = waiting;
    }
    defined
}
