//! What a robot file says of the arm beyond its table: the `[[effect]]` tables as the catalogue
//! understands them.

use stiffarm_kernels::generic::Arm;
use stiffarm_table::robot::{self, Effect as Table, Entry, Quantity as Given};

use super::{AtRest, Catalogue, Depends, Forms, MOST_ORDERS, Parameter, Place, Quantity, Spot};
use crate::io::nearest;
use crate::measurement::{Measurements, Row};
use crate::simulate::{Actual, Moment};

/// The key that tells of which measurement file an effect is that belongs to one session.
const SESSION: &str = "session";

/// An effect that the robot file has.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// What reality does.
    pub effect: &'static dyn AtRest,
    /// Where, and in which form.
    pub spot: Spot,
    /// Values of its parameters there, SI.
    pub values: Vec<f64>,
    /// The one measurement file that it belongs to, of what happened at a time; `None` is every one.
    pub session: Option<String>,
    /// Where it stands in the robot file.
    pub at: robot::Spot,
}

/// An `[[effect]]` that says nothing.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {}: {message}", at.line)]
pub struct KnownError {
    /// What of it.
    pub at: robot::Spot,
    /// What was found, and what is expected there.
    pub message: String,
    /// How to mend it, where that is known.
    pub help: Option<String>,
}

impl KnownError {
    pub(crate) fn new(at: &robot::Spot, message: String, help: Option<String>) -> KnownError {
        KnownError { at: at.clone(), message, help }
    }

    /// With how to mend it.
    pub(crate) fn in_full(&self) -> String {
        let help = self.help.iter().map(|help| format!("; {help}"));
        format!("{self}{}", help.collect::<String>())
    }
}

/// The nearest of some words, else all of them.
pub(crate) fn advice<'n>(
    found: &str,
    known: impl Iterator<Item = &'n str> + Clone,
) -> Option<String> {
    let all = || format!("known here: {}", known.clone().collect::<Vec<_>>().join(", "));
    Some(nearest(found, known.clone()).map_or_else(all, |near| format!("did you mean `{near}`?")))
}

impl Known {
    /// The effects of a robot file whose table is `arm`.
    ///
    /// # Errors
    /// The first mistake of each table.
    pub fn all(
        file: &robot::Robot,
        arm: &Arm,
        catalogue: &Catalogue,
    ) -> Result<Vec<Known>, Vec<KnownError>> {
        let read = file.effects.iter().map(|table| Known::read(table, arm, catalogue));
        let (known, wrong): (Vec<_>, Vec<_>) = read.partition(Result::is_ok);
        match wrong.is_empty() {
            true => Ok(known.into_iter().flatten().collect()),
            false => Err(wrong.into_iter().filter_map(Result::err).collect()),
        }
    }

    fn read(table: &Table, arm: &Arm, catalogue: &Catalogue) -> Result<Known, KnownError> {
        let id = &table.id.value;
        let effect = catalogue.named(id).ok_or_else(|| {
            let help = advice(id, catalogue.identifiers().into_iter());
            KnownError::new(&table.id.at, format!("unknown effect `{id}`"), help)
        })?;
        if effect.is_tolerated() {
            let help = Some("change the numbers of its [[joint]] rows".to_owned());
            return Err(KnownError::new(&table.id.at, format!("`{id}` is the table itself"), help));
        }
        let place = place(effect, table, arm)?;
        let forms = effect.forms_are();
        let form = match forms.key() {
            Some(key) => form(effect, place, key, table, arm)?,
            None => 0,
        };
        let spot = Spot { place, form };
        let parameters = effect.parameters(arm, spot);
        let mut values = vec![0.0; parameters.len()];
        let mut session = None;
        for number in table.numbers.iter().filter(|number| forms.key() != Some(&number.key)) {
            let wrong = |message, help| Err(KnownError::new(&number.at, message, help));
            if number.key == SESSION && effect.depends() == Depends::Session {
                match &number.value {
                    Given::Text(file) => session = Some(file.clone()),
                    Given::Si(_) => {
                        let help = Some("write session = \"run1.csv\"".to_owned());
                        return wrong(
                            "a number stands where a file's name is expected".into(),
                            help,
                        );
                    }
                }
                continue;
            }
            let Some(index) = parameters.iter().position(|p| p.key == number.key) else {
                let help = advice(&number.key, parameters.iter().map(|p| p.key));
                return wrong(format!("unknown number `{}` of {id} at {place}", number.key), help);
            };
            values[index] = value(number, &parameters[index])?;
        }
        Ok(Known { effect, spot, values, session, at: table.at.clone() })
    }

    /// As a table of a robot file. Reading it gives the same effect.
    pub fn table(&self, arm: &Arm) -> Table {
        let forms = self.effect.forms_are();
        let form = forms.key().map(|key| (key, Given::Si(forms.number(self.spot.form))));
        let session = self.session.iter().map(|file| (SESSION, Given::Text(file.clone())));
        let parameters = self.effect.parameters(arm, self.spot);
        let each = parameters.iter().zip(&self.values).filter(|(_, value)| **value != 0.0);
        let numbers = each.map(|(parameter, value)| (parameter.key, Given::Si(*value)));
        let numbers = form.into_iter().chain(session).chain(numbers);
        table(self.effect.identifier(), &self.spot.place, numbers)
    }

    /// Its values by the names in which truths and findings tell them.
    pub fn named(&self, arm: &Arm) -> Vec<(String, f64)> {
        let number = self.effect.forms_are().number(self.spot.form);
        let form = self.effect.form_number().map(|p| (p.name.into_owned(), number));
        let parameters = self.effect.parameters(arm, self.spot);
        let each = parameters.into_iter().map(|p| p.name.into_owned()).zip(self.values.clone());
        form.into_iter().chain(each).collect()
    }

    /// Whether it is there when these measurements are made.
    pub fn is_there(&self, data: &Measurements) -> bool {
        self.session.as_deref().is_none_or(|session| session == file_name(&data.file))
    }

    /// Puts it into the arm of a row.
    pub fn alter(&self, actual: &mut Actual<'_>, row: &Row, when: &Moment) {
        self.effect.alter(actual, row, when, self.spot, &self.values);
    }
}

/// The last part of a path.
pub(crate) fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

fn place(effect: &dyn AtRest, table: &Table, arm: &Arm) -> Result<Place, KnownError> {
    let found = &table.place.value;
    let places = effect.places(arm);
    if let Some(place) = found.parse().ok().filter(|place| places.contains(place)) {
        return Ok(place);
    }
    let message = format!("`{found}` is no place of {}", effect.identifier());
    let names: Vec<String> = places.iter().map(Place::to_string).collect();
    Err(KnownError::new(&table.place.at, message, advice(found, names.iter().map(String::as_str))))
}

/// The form that stands beside the numbers, as [`Spot`] counts it.
fn form(
    effect: &dyn AtRest,
    place: Place,
    key: &str,
    table: &Table,
    arm: &Arm,
) -> Result<usize, KnownError> {
    let forms = effect.forms_are();
    let joint = |form: &usize| *form < arm.dof() && *form != place.row();
    let most = match forms {
        Forms::Joints => arm.dof(),
        Forms::Orders { .. } => MOST_ORDERS,
        _ => usize::MAX,
    };
    let entry = table.numbers.iter().find(|number| number.key == key);
    let given = entry.and_then(|entry| match (&entry.value, forms) {
        (Given::Si(x), _) => Some(*x),
        (Given::Text(text), Forms::Searched { quantity, .. }) => quantity.read(text),
        (Given::Text(text), _) => text.trim().parse().ok(),
    });
    let form = given.and_then(|number| forms.form(number)).filter(|form| *form <= most);
    form.filter(|form| forms != Forms::Joints || joint(form)).ok_or_else(|| {
        let at = entry.map_or(&table.at, |entry| &entry.at);
        let found = if entry.is_some() { "is not" } else { "is missing:" };
        let message = format!("`{key}` of {} {found} {}", effect.identifier(), forms.expected(arm));
        KnownError::new(at, message, Some(format!("write {key} = 1")))
    })
}

fn value(number: &Entry<Given>, parameter: &Parameter) -> Result<f64, KnownError> {
    let value = si(number, parameter.quantity)?;
    if value < parameter.least {
        let found = match &number.value {
            Given::Si(x) => x.to_string(),
            Given::Text(text) => text.clone(),
        };
        let message =
            format!("`{}` is {found}: below {:e} it is not physical", number.key, parameter.least);
        return Err(KnownError::new(&number.at, message, None));
    }
    Ok(value)
}

/// A number of some kind, in SI or with its unit.
pub(crate) fn si(number: &Entry<Given>, quantity: Quantity) -> Result<f64, KnownError> {
    match &number.value {
        Given::Si(x) => Ok(*x),
        Given::Text(text) => quantity.read(text).ok_or_else(|| {
            let message = format!("`{text}` is no number and its unit: {}", quantity.units());
            let help = format!("a number without a unit is in {}", quantity.unit());
            KnownError::new(&number.at, message, Some(help))
        }),
    }
}

/// An effect as a table of a robot file.
pub(crate) fn table<'n>(
    id: &str,
    place: &impl ToString,
    numbers: impl Iterator<Item = (&'n str, Given)>,
) -> Table {
    let text = |key: &str, value| Entry { key: key.to_owned(), value, at: robot::Spot::default() };
    let entry =
        |(key, value): (&str, Given)| Entry { key: key.to_owned(), value, at: Default::default() };
    Table {
        at: Default::default(),
        id: text("id", id.to_owned()),
        place: text("place", place.to_string()),
        numbers: numbers.map(entry).collect(),
    }
}

#[cfg(test)]
mod tests;
