//! A beam's cell: `{ youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section: tube(0.2, 0.18) }`.

use proc_macro2::{Delimiter, TokenTree};

use super::super::dimension::Dimension;
use super::super::draft::{Cell, DraftBeam, broken};
use super::super::model::{Section, Value};
use super::super::problem::{Problem, Report};
use super::super::suggest::{advice, closest};
use super::cells::{Raw, group, length, list, split, value};
use super::spot::{Spot, flatten, is_sign, is_word};
use crate::number::Number;

/// What a beam says.
pub(super) const KEYS: [&str; 5] =
    ["youngs_modulus", "shear_modulus", "section", "density", "shear_coefficient"];
/// What a section says that is neither a tube nor a box.
pub(super) const CONSTANTS: [&str; 4] = ["area", "iy", "iz", "j"];
const SECTION: &str = "`tube(outer, inner)`, `box([b, h], [b, h])` or \
                       `{ area: …, iy: …, iz: …, j: … }` is expected here";

/// Reads a beam; `None` (and an error) if the cell is no braces group.
pub(super) fn read(cell: &Raw, report: &mut Report<Spot>) -> Option<DraftBeam<Spot>> {
    let Some(tokens) = group(cell, Delimiter::Brace) else {
        let problem = Problem::new(cell.at, "a beam in braces is expected here");
        let help = "for example { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, \
                    section: tube(0.2, 0.18) }";
        report.error(problem.help(help));
        return None;
    };
    let fields = Fields::read(&tokens, cell.at, &KEYS, report);
    let mut modulus = |key| match fields.required(key, report) {
        Some(cell) => value(cell, Dimension::Pressure, report),
        None => Cell::broken(fields.at),
    };
    Some(DraftBeam {
        youngs_modulus: modulus("youngs_modulus"),
        shear_modulus: modulus("shear_modulus"),
        section: match fields.required("section", report) {
            Some(cell) => section(cell, report),
            None => broken(&fields.at),
        },
        density: fields.get("density").map(|c| value(c, Dimension::Density, report)),
        shear_coefficient: fields
            .get("shear_coefficient")
            .map(|c| value(c, Dimension::Ratio, report)),
        at: fields.at,
    })
}

/// `key: value, …`, with unknown keys already reported.
struct Fields {
    fields: Vec<(&'static str, Raw)>,
    meant: Vec<&'static str>,
    at: Spot,
}

impl Fields {
    fn read(
        tokens: &[TokenTree],
        at: Spot,
        keys: &[&'static str],
        report: &mut Report<Spot>,
    ) -> Self {
        let mut found = Fields { fields: Vec::new(), meant: Vec::new(), at };
        for field in split(tokens, ',', at) {
            let [key @ TokenTree::Ident(word), colon, rest @ ..] = field.tokens.as_slice() else {
                report.error(Problem::new(field.at, "`key: value` is expected here"));
                continue;
            };
            let (word, at) = (word.to_string(), Spot::new(key.span()));
            let known = keys.iter().copied().find(|known| *known == word);
            if !is_sign(colon, ':') {
                found.meant.extend(known);
                report.error(Problem::new(field.at, "`key: value` is expected here"));
                continue;
            }
            match known {
                None => {
                    found.meant.extend(closest(&word, keys.iter().copied()));
                    let problem = Problem::new(at, format!("unknown key `{word}`"));
                    report.error(problem.help(advice(&word, keys)));
                }
                Some(known) if found.get(known).is_some() => {
                    let message = format!("`{known}` stands here for the second time");
                    report.error(Problem::new(at, message));
                }
                Some(known) => found.fields.push((known, Raw::new(rest.to_vec(), at))),
            }
        }
        found
    }

    fn get(&self, key: &str) -> Option<&Raw> {
        self.fields.iter().find(|(known, _)| *known == key).map(|(_, cell)| cell)
    }

    fn required(&self, key: &str, report: &mut Report<Spot>) -> Option<&Raw> {
        let found = self.get(key);
        if found.is_none() && !self.meant.contains(&key) {
            report.error(Problem::new(self.at, format!("`{key}` is missing here")));
        }
        found
    }
}

fn section(cell: &Raw, report: &mut Report<Spot>) -> [Cell<Value, Spot>; 4] {
    if let Some(tokens) = group(cell, Delimiter::Brace) {
        let fields = Fields::read(&tokens, cell.at, &CONSTANTS, report);
        return CONSTANTS.map(|key| {
            let dimension = if key == "area" { Dimension::Area } else { Dimension::SecondMoment };
            match fields.required(key, report) {
                Some(cell) => value(cell, dimension, report),
                None => Cell::broken(fields.at),
            }
        });
    }
    match shape(cell, report) {
        Some(Section { area, iy, iz, j }) => {
            [area, iy, iz, j].map(|constant| Cell::new(constant, cell.at))
        }
        None => broken(&cell.at),
    }
}

/// `tube(…)` or `box(…)`; reported if `None`.
fn shape(cell: &Raw, report: &mut Report<Spot>) -> Option<Section> {
    let (word, arguments) = match cell.tokens.as_slice() {
        [word @ TokenTree::Ident(_), TokenTree::Group(arguments)]
            if arguments.delimiter() == Delimiter::Parenthesis =>
        {
            (word, arguments)
        }
        _ => {
            report.error(Problem::new(cell.at, SECTION));
            return None;
        }
    };
    let at = Spot::new(arguments.span());
    let arguments = split(&flatten(arguments.stream()), ',', at);
    let lists = arguments.iter().all(|side| group(side, Delimiter::Bracket).is_some());
    if is_word(word, "box") && !lists {
        let message = "the sides of a box are [b, h], along the beam's y and along its z";
        let help = "write `box([120 mm, 80 mm])`, with a second pair if it is hollow";
        report.error(Problem::new(at, message).help(help));
        return None;
    }
    let section = match arguments.as_slice() {
        [outer] if is_word(word, "tube") => Section::tube(size(outer, report)?, Number::ZERO),
        [outer, inner] if is_word(word, "tube") => {
            let (outer, inner) = (size(outer, report), size(inner, report));
            Section::tube(outer?, inner?)
        }
        [outer] if is_word(word, "box") => Section::rectangle(sides(outer, report)?, None),
        [outer, inner] if is_word(word, "box") => {
            let (outer, inner) = (sides(outer, report), sides(inner, report));
            let inner = inner?;
            let hollow = !inner.iter().all(|side| side.is_zero());
            Section::rectangle(outer?, hollow.then_some(inner))
        }
        _ => {
            let problem = Problem::new(cell.at, SECTION);
            report.error(match closest(&word.to_string(), ["tube", "box"]) {
                Some(near) if !is_word(word, near) => {
                    problem.help(format!("did you mean `{near}`?"))
                }
                _ => problem,
            });
            return None;
        }
    };
    if section.is_none() {
        let message = "the outer sizes must be above zero, and each inner size below its outer one";
        report.error(Problem::new(cell.at, message));
    }
    section
}

fn size(cell: &Raw, report: &mut Report<Spot>) -> Option<Number> {
    let reason = "to keep a section symbolic give its area, iy, iz and j";
    length(cell, reason, report).value?.number()
}

fn sides(cell: &Raw, report: &mut Report<Spot>) -> Option<[Number; 2]> {
    let [b, h] = list::<2>(cell, "[b, h] (along the beam's y, along its z)", report)?;
    let (b, h) = (size(&b, report), size(&h, report));
    Some([b?, h?])
}
