//! Reads a paper's data file.

use ::serde::Deserialize;

use super::formulas::{definitions, values};
use super::notes::{Named, Notes, Text, plain};
use super::{Paper, equation, table};
use crate::latex::mistake::{Mistake, file_error};
use crate::latex::notation::{Notation, Slash, squeezed};
use crate::latex::tree::Function;
use stiffarm_codegen::robot::{FileError, Robot};

/// A file as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    paper: Text,
    title: Option<Text>,
    #[serde(default)]
    notation: WrittenNotation,
    #[serde(default)]
    robot: Vec<WrittenRobot>,
    #[serde(default, rename = "where")]
    defined: Named<Text>,
    #[serde(default)]
    values: Named<f64>,
    #[serde(default)]
    equation: Vec<equation::Written>,
    #[serde(default)]
    quantity: Vec<equation::Written>,
    #[serde(default)]
    table: Vec<table::Written>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct WrittenNotation {
    sine: Named<Text>,
    cosine: Named<Text>,
    names: Vec<Text>,
    slash: Option<Text>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenRobot {
    name: Text,
    table: Text,
}

/// Reads a data file. `path` is only used in messages.
///
/// # Errors
/// Every mistake in the file's formulas, each at its character; the first one in its TOML.
pub fn read(text: &str, path: &str) -> Result<Paper, FileError> {
    let mut notes = Notes { text, mistakes: Vec::new() };
    match ::toml::from_str(text) {
        Err(error) => notes.wrong(error.span().unwrap_or(0..0), error.message()),
        Ok(written) => {
            let paper = paper(written, &mut notes);
            if notes.mistakes.is_empty() {
                return Ok(paper);
            }
        }
    }
    Err(file_error(path, text, notes.mistakes))
}

fn paper(written: Written, notes: &mut Notes<'_>) -> Paper {
    let notation = notation(written.notation, notes);
    let shared = definitions(&written.defined, &[], &notation, notes);
    let mut read = |equations: Vec<equation::Written>, printed| {
        let each = equations.into_iter();
        each.map(|equation| equation::read(equation, printed, &shared, &notation, notes)).collect()
    };
    let (equations, quantities) = (read(written.equation, true), read(written.quantity, false));
    let tables = written.table.into_iter().map(|table| table::read(table, &notation, notes));
    let mut out = Paper {
        id: written.paper.into_inner(),
        title: plain(written.title).unwrap_or_default(),
        equations,
        quantities,
        tables: tables.collect(),
        ..Paper::default()
    };
    for WrittenRobot { name, table } in &written.robot {
        let table = notes.piece(table);
        match Robot::from_toml(&table.text, name.get_ref()) {
            Ok((robot, _)) => {
                out.robots.insert(name.get_ref().clone(), robot);
            }
            Err(error) => notes.mistakes.extend(error.errors.into_iter().map(|e| Mistake {
                at: e.span.start + table.at..e.span.end + table.at,
                message: e.message,
                help: e.help,
            })),
        }
    }
    out.values = values(&written.values, &notation, notes);
    Paper { notation, ..out }
}

fn notation(written: WrittenNotation, notes: &mut Notes<'_>) -> Notation {
    let letters = |letters: Named<Text>, function| {
        letters.into_iter().map(move |(letter, angle)| {
            (squeezed(letter.get_ref()), function, squeezed(angle.get_ref()))
        })
    };
    let sines = letters(written.sine, Function::Sin);
    let functions = sines.chain(letters(written.cosine, Function::Cos)).collect();
    let slash = match &written.slash {
        Some(slash) if slash.get_ref() == "product" => Slash::Product,
        Some(slash) if slash.get_ref() != "factor" => {
            notes.wrong(slash.span(), "`slash` is \"product\" or \"factor\"");
            Slash::Factor
        }
        _ => Slash::Factor,
    };
    let names = written.names.into_iter().map(::toml::Spanned::into_inner).collect();
    Notation { functions, names, slash, matrices: false }
}

#[cfg(test)]
mod tests;
