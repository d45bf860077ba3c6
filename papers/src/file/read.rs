//! Reads a paper's data file.

use std::collections::HashMap;

use ::toml::de::DeTable;

use super::section::{Notes, Section, Written, number, string};
use super::{Paper, equation, table};
use crate::exact::rational::Rational;
use crate::latex::lexer::{Lexeme, lex};
use crate::latex::mistake::{Mistake, file_error};
use crate::latex::notation::{Notation, Slash, key, squeezed};
use crate::latex::parser::parse;
use crate::latex::tree::{Function, Tree};
use stiffarm_codegen::robot::{FileError, Robot};

const PAPER: &[&str] =
    &["paper", "title", "notation", "robot", "where", "values", "equation", "quantity", "table"];
const NOTATION: &[&str] = &["sine", "cosine", "names", "slash"];

/// Reads a data file. `path` is only used in messages.
///
/// # Errors
/// Every mistake in the file, each at its character.
pub fn read(text: &str, path: &str) -> Result<Paper, FileError> {
    let (root, errors) = DeTable::parse_recoverable(text);
    let mut notes = Notes { text, mistakes: Vec::new() };
    for error in errors {
        let at = error.span().unwrap_or(0..0);
        notes.wrong(at, format!("this is no TOML: {}", error.message()));
    }
    if notes.mistakes.is_empty() {
        let section = Section::open(root.get_ref(), root.span(), PAPER, &mut notes);
        let paper = paper(&section, path, &mut notes);
        if notes.mistakes.is_empty() {
            return Ok(paper);
        }
    }
    Err(file_error(path, text, notes.mistakes))
}

fn paper(root: &Section<'_, '_>, path: &str, notes: &mut Notes<'_>) -> Paper {
    let notation = root.section("notation", NOTATION, notes);
    let notation = notation.map(|s| self::notation(&s, notes)).unwrap_or_default();
    let mut out = Paper {
        path: path.to_owned(),
        text: notes.text.to_owned(),
        id: root.required("paper", notes).unwrap_or_default().text,
        title: root.string("title", notes).unwrap_or_default().text,
        notation,
        ..Paper::default()
    };
    for robot in root.sections("robot", &["name", "table"], notes) {
        let name = robot.required("name", notes);
        let (Some(name), Some(table)) = (name, robot.required("table", notes)) else { continue };
        match Robot::from_toml(&table.text, &name.text) {
            Ok((robot, _)) => {
                out.robots.insert(name.text, robot);
            }
            Err(error) => notes.mistakes.extend(error.errors.into_iter().map(|e| Mistake {
                at: e.span.start + table.at..e.span.end + table.at,
                message: e.message,
                help: e.help,
            })),
        }
    }
    if let Some(values) = root.section("values", &[], notes) {
        for (name, at, value) in values.entries() {
            let name = symbol(&Written { text: name, at: at.start + 1 }, &out.notation, notes);
            if let (Some(name), Some(value)) = (name, number(value, notes)) {
                out.values.insert(name, value);
            }
        }
    }
    let shared = definitions(root, &HashMap::new(), &out.notation, notes);
    for section in root.sections("equation", equation::KEYS, notes) {
        let found = equation::read(&section, true, &shared, &out.notation, notes);
        out.equations.extend(found);
    }
    for section in root.sections("quantity", equation::KEYS, notes) {
        let quantity = equation::read(&section, false, &shared, &out.notation, notes);
        out.quantities.extend(quantity);
    }
    for section in root.sections("table", table::KEYS, notes) {
        out.tables.extend(table::read(&section, &out.notation, notes));
    }
    out
}

fn notation(section: &Section<'_, '_>, notes: &mut Notes<'_>) -> Notation {
    let mut functions = Vec::new();
    for (key, function) in [("sine", Function::Sin), ("cosine", Function::Cos)] {
        let Some(letters) = section.section(key, &[], notes) else { continue };
        for (letter, _, value) in letters.entries() {
            if let Some(angle) = string(value, notes) {
                functions.push((squeezed(&letter), function, squeezed(&angle.text)));
            }
        }
    }
    let names = section.strings("names", notes).unwrap_or_default();
    let slash = match section.string("slash", notes) {
        Some(w) if w.text == "product" => Slash::Product,
        Some(w) if w.text != "factor" => {
            notes.wrong(w.at..w.at + w.text.len(), "`slash` is \"product\" or \"factor\"");
            Slash::Factor
        }
        _ => Slash::Factor,
    };
    Notation { functions, names: names.into_iter().map(|w| w.text).collect(), slash }
}

/// The name of a single printed symbol.
pub(super) fn symbol(w: &Written, notation: &Notation, notes: &mut Notes<'_>) -> Option<String> {
    let at = w.at..w.at + w.text.len();
    match lex(&w.text, notation).as_deref() {
        Ok([token]) => {
            if let Lexeme::Name { base, sub } = &token.is {
                return Some(key(base, sub.as_deref()));
            }
            notes.wrong(at, format!("`{}` is no symbol", w.text));
        }
        Ok(_) => notes.wrong(at, format!("`{}` is not one symbol", w.text)),
        Err(mistake) => notes.mistakes.push(mistake.clone().moved(w.at)),
    }
    None
}

/// A formula of the file.
pub(super) fn tree(w: &Written, notation: &Notation, notes: &mut Notes<'_>) -> Option<Tree> {
    parse(&w.text, notation).map_err(|mistake| notes.mistakes.push(mistake.moved(w.at))).ok()
}

pub(super) fn exact(
    w: &Written,
    notation: &Notation,
    defined: &HashMap<String, Rational>,
    notes: &mut Notes<'_>,
) -> Option<Rational> {
    let tree = tree(w, notation, notes)?;
    let exact = Rational::of_tree(&tree, defined);
    let at = w.at..w.at + w.text.len();
    exact.map_err(|why| notes.wrong(at, format!("this has no exact form: {why:?}"))).ok()
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
    for (name, at, value) in section.entries() {
        let name = symbol(&Written { text: name, at: at.start + 1 }, notation, notes);
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
            tree.each_name(&mut |used| waits |= names.iter().any(|n| n == used));
            if waits {
                waiting.push((name, value, tree));
            } else if let Some(exact) = exact(&value, notation, &defined, notes) {
                defined.insert(name, exact);
            }
        }
        if waiting.len() == before {
            for (_, value, _) in &waiting {
                let at = value.at..value.at + value.text.len();
                notes.wrong(at, "this definition goes round in a circle");
            }
            break;
        }
        open = waiting;
    }
    defined
}

#[cfg(test)]
mod tests;
