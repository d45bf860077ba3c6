//! Symbols and formulas of a data file.

use std::collections::HashMap;

use super::notes::{Named, Notes, Text};
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

/// Values of symbols.
pub(super) fn values(
    written: &Named<f64>,
    notation: &Notation,
    notes: &mut Notes<'_>,
) -> HashMap<String, f64> {
    let mut named = |name| symbol(&notes.piece(name), notation, notes);
    written.iter().filter_map(|(name, value)| Some((named(name)?, *value))).collect()
}

/// A formula of the file.
pub(super) fn tree(w: &Piece, notation: &Notation, notes: &mut Notes<'_>) -> Option<Tree> {
    parse(&w.text, notation).map_err(|mistake| notes.mistakes.push(mistake.moved(w.at))).ok()
}

/// The `where` of a table on top of what is defined already: a definition may use another, and stands
/// behind those that it uses.
pub(super) fn definitions(
    written: &Named<Text>,
    outer: &[(String, Tree)],
    notation: &Notation,
    notes: &mut Notes<'_>,
) -> Vec<(String, Tree)> {
    let mut defined = outer.to_vec();
    let mut open = Vec::new();
    for (name, value) in written {
        let (name, value) = (notes.piece(name), notes.piece(value));
        let (name, tree) = (symbol(&name, notation, notes), tree(&value, notation, notes));
        open.extend(name.zip(tree).map(|(name, tree)| (name, value, tree)));
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
            } else {
                defined.push((name, tree));
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
