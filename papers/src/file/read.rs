//! Reads a paper's data file.

use std::collections::HashMap;

use ::toml::de::DeTable;

use super::formulas::{definitions, symbol};
use super::section::{Notes, Section, number, string};
use super::{Paper, equation, table};
use crate::latex::mistake::{Mistake, file_error};
use crate::latex::notation::{Notation, Slash, squeezed};
use crate::latex::tree::Function;
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
        for (name, value) in values.entries() {
            let name = symbol(&name, &out.notation, notes);
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
        for (letter, value) in letters.entries() {
            if let Some(angle) = string(value, notes) {
                functions.push((squeezed(&letter.text), function, squeezed(&angle.text)));
            }
        }
    }
    let names = section.strings("names", notes).unwrap_or_default();
    let slash = match section.string("slash", notes) {
        Some(w) if w.text == "product" => Slash::Product,
        Some(w) if w.text != "factor" => {
            notes.wrong(w.place(), "`slash` is \"product\" or \"factor\"");
            Slash::Factor
        }
        _ => Slash::Factor,
    };
    let names = names.into_iter().map(|w| w.text).collect();
    Notation { functions, names, slash, matrices: false }
}

#[cfg(test)]
mod tests;
