//! What a robot file says of the arm in motion beyond its table: `[[effect]]` tables of the effects of logs.
//!
//! A table is one of motion if its identifier is in the catalogue of logs, its place is one of theirs and its
//! keys are that effect's numbers: some effects (a coupling, backlash) have a twin at rest.

use stiffarm_codegen::robot::{Effect as Table, Entry, Quantity as Given};

use super::effects::{CATALOGUE, LogEffect, Spot};
use super::model::Acting;
use super::scene::Domain;

/// Whether a table is of motion. Arms have no more joints than places are compared with.
pub fn is_of_motion(table: &Table) -> bool {
    effect(table).is_some() && spot(table, MOST).is_some()
}

/// More joints no table has.
const MOST: usize = 64;

/// What the tables of an arm of so many joints say of these rows; others are left out.
///
/// # Errors
/// What is wrong with a table, and its line.
pub fn terms(tables: &[Table], joints: usize, rows: Domain) -> Result<Vec<Acting>, String> {
    let mut terms = Vec::new();
    for table in tables {
        let Some(effect) = effect(table) else { continue };
        if effect.domain() != rows {
            continue;
        }
        let wrong =
            |what: String| format!("line {}: [[effect]] {}: {what}", table.at.line, table.id.value);
        let spot = spot(table, joints).ok_or_else(|| {
            wrong(format!("found the place `{}`, expected one of the arm's", table.place.value))
        })?;
        let value = |(name, unit): &(&'static str, &'static str)| {
            let entry = table.numbers.iter().find(|entry| entry.key == *name);
            match entry.map(|entry| &entry.value) {
                Some(Given::Si(value)) if value.is_finite() => Ok(*value),
                Some(other) => {
                    Err(wrong(format!("found {name} = {other:?}, expected a number in {unit}")))
                }
                None => Ok(0.0),
            }
        };
        let values: Result<Vec<f64>, String> = effect.numbers().iter().map(value).collect();
        let values = values?;
        if !effect.may_be(&values) {
            return Err(wrong(format!(
                "found {values:?}, expected numbers that such a thing may have"
            )));
        }
        terms.push(Acting { effect, spot, values });
    }
    Ok(terms)
}

/// The table that says a term.
pub fn table(term: &Acting) -> Table {
    let entry = |key: &str, value| Entry { key: key.to_owned(), value, at: Default::default() };
    let text =
        |key: &str, value: String| Entry { key: key.to_owned(), value, at: Default::default() };
    let numbers = term.effect.numbers().iter().zip(&term.values);
    Table {
        at: Default::default(),
        id: text("id", term.effect.identifier().to_owned()),
        place: text("place", term.spot.to_string()),
        numbers: numbers.map(|((name, _), value)| entry(name, Given::Si(*value))).collect(),
    }
}

/// The effect of a table: that of its identifier which has all its keys.
fn effect(table: &Table) -> Option<&'static dyn LogEffect> {
    let has =
        |effect: &dyn LogEffect, key: &str| effect.numbers().iter().any(|(name, _)| *name == key);
    let is = |effect: &&&'static dyn LogEffect| {
        effect.identifier() == table.id.value
            && table.numbers.iter().all(|entry| has(**effect, &entry.key))
    };
    CATALOGUE.iter().find(is).copied()
}

/// The place that is printed so.
fn spot(table: &Table, joints: usize) -> Option<Spot> {
    Spot::all(joints).into_iter().find(|spot| spot.to_string() == table.place.value)
}
