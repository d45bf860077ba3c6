//! An effect at a place that a plan is to tell from another one.

use stiffarm_kernels::generic::Arm;

use crate::effects::{Catalogue, Effect, Parameter, Place, Spot, at_place};
use crate::measurement::Measurements;

/// An effect of the catalogue at a place of an arm.
#[derive(Clone)]
pub struct Suspect {
    pub(super) effect: &'static dyn Effect,
    place: Place,
    /// A parameter of the form that is meant; the first form if there is none.
    form: Option<String>,
}

/// A suspect that cannot be meant: what was found, what was expected.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("effect `{text}`: {fault}")]
pub struct SuspectError {
    /// The whole text.
    pub text: String,
    /// What is wrong with it.
    pub fault: String,
}

impl PartialEq for Suspect {
    fn eq(&self, other: &Self) -> bool {
        let name = |s: &Suspect| (s.effect.identifier(), s.place, s.form.clone());
        name(self) == name(other)
    }
}

impl core::fmt::Debug for Suspect {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{}@{}", self.effect.identifier(), self.place)
    }
}

impl core::fmt::Display for Suspect {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let name = self.effect.identifier().replace('_', " ");
        let form = self.form.as_ref().map_or_else(String::new, |form| format!(" ({form})"));
        write!(f, "{name}{form} at {}", self.place)
    }
}

impl Suspect {
    /// Reads `effect[@place][:parameter]`: the place may be left out where there is only one; a
    /// parameter says which form is meant (`transmission_error@joint 2:cos 20`).
    ///
    /// # Errors
    /// [`SuspectError`]: an unknown effect, or a place where it cannot act.
    pub fn parse(text: &str, arm: &Arm, catalogue: &Catalogue) -> Result<Suspect, SuspectError> {
        let wrong = |fault: String| SuspectError { text: text.trim().to_owned(), fault };
        let (head, form) = match text.split_once(':') {
            Some((head, form)) => (head, Some(words(form))),
            None => (text, None),
        };
        let (effect, place) = at_place(head, arm, catalogue.iter()).map_err(wrong)?;
        Ok(Suspect { effect, place, form })
    }

    /// Why tests may show nothing of it.
    pub(super) fn idle(&self) -> &'static str {
        self.effect.idle()
    }

    /// Its form, and the units of its numbers, with these postures.
    pub(super) fn spotted(&self, arm: &Arm, data: &Measurements) -> Option<(Spot, Vec<Number>)> {
        let forms = self.effect.forms(arm, self.place, data).into_iter();
        let mut spots = forms.map(|form| Spot { place: self.place, form }).map(|spot| {
            let numbers = self.effect.parameters(arm, spot).into_iter();
            let unit = |p: &Parameter| p.quantity.unit_by(data.is_timed());
            let named = |p: Parameter| Number { unit: unit(&p), name: p.name.into() };
            (spot, numbers.map(named).collect::<Vec<_>>())
        });
        match &self.form {
            None => spots.next(),
            Some(name) => spots.find(|(_, numbers)| numbers.iter().any(|n| n.name == *name)),
        }
    }
}

/// A number of an effect.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Number {
    /// What it is.
    pub name: String,
    /// In SI.
    pub unit: &'static str,
}

fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
