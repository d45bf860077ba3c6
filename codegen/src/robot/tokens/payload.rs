//! A load and its name: `payload: gripper mass 1.2 kg, com [0, 0, 60 mm];`.

use proc_macro2::TokenTree;

use super::super::dimension::Dimension;
use super::super::draft::{Cell, DraftPayload};
use super::super::problem::{Problem, Report};
use super::cells::{Raw, inertia, known, known_lengths, split, value};
use super::header::string;
use super::spot::{Spot, is_word};

const EXPECTED: &str = "`name mass 1.2 kg, com [x, y, z], inertia [xx, xy, xz, yy, yz, zz]` is expected here, the last two if wanted";

const REASON: &str = "a payload is weighed, not chosen: write numbers";

/// A name in quotes or without.
pub(super) fn name(cell: &Raw, report: &mut Report<Spot>) -> Cell<String, Spot> {
    match cell.tokens.as_slice() {
        [TokenTree::Ident(name)] => Cell::new(name.to_string(), cell.at),
        _ => string(cell, report),
    }
}

/// Its name, its mass and, in either order, its centre and its moments of inertia.
pub(super) fn read(cell: &Raw, report: &mut Report<Spot>) -> Option<DraftPayload<Spot>> {
    let Some((word, rest)) = cell.tokens.split_first().filter(|(_, rest)| !rest.is_empty()) else {
        report.error(Problem::new(cell.at, EXPECTED));
        return None;
    };
    let name = name(&Raw::new(vec![word.clone()], cell.at), report);
    let mut found = DraftPayload { name, mass: Cell::broken(cell.at), com: None, inertia: None };
    let mut weighed = false;
    for part in split(rest, ',', cell.at) {
        let (word, after) = match part.tokens.split_first() {
            Some((word, after)) => (word, Raw::new(after.to_vec(), part.at)),
            None => {
                report.error(Problem::new(part.at, EXPECTED));
                return None;
            }
        };
        if is_word(word, "mass") && !weighed {
            weighed = true;
            found.mass = known(value(&after, Dimension::Mass, report), REASON, report);
        } else if is_word(word, "com") && found.com.is_none() {
            found.com = Some(known_lengths(&after, REASON, report));
        } else if is_word(word, "inertia") && found.inertia.is_none() {
            let entries = inertia(&after, report).map(|entry| known(entry, REASON, report));
            found.inertia = Some((after.at, entries));
        } else {
            report.error(Problem::new(Spot::new(word.span()), EXPECTED));
            return None;
        }
    }
    if !weighed {
        report.error(Problem::new(cell.at, "a payload without a mass").help(EXPECTED));
        return None;
    }
    Some(found)
}
