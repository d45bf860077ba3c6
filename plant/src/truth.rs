//! What is put into the plant at rest.
//!
//! ```text
//! place  = "base" | "joint" i | "link" i | "tool" | "arm" | "instrument"
//! value  = number [ unit ]
//! ```
//!
//! A number without a unit is in SI; the rest is [`notation`](super::notation).

use core::fmt;

use stiffarm_kernels::generic::Arm;

use super::laws::effects;
use super::notation::{self, Size, TruthError, once};
use crate::effects::{Effect, Forms, Known, Parameter, Place, Spot, at_place, cannot_act};
use crate::io::{did_you_mean, nearest};

/// One effect at one place, with its size.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// What reality does.
    pub effect: &'static dyn Effect,
    /// Where.
    pub place: Place,
    /// Names and values of its parameters, SI; those not named are 0.
    pub values: Vec<(String, f64)>,
}

impl fmt::Display for Truth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let numbers = self.values.iter().map(|(name, value)| (name.as_str(), *value));
        notation::write(f, (self.effect.identifier(), &self.place), numbers)
    }
}

impl Truth {
    /// Reads a truth about this arm.
    ///
    /// # Errors
    /// [`TruthError`]: an unknown effect, a place where it cannot act, an unknown parameter, or a
    /// value that is no number of the right kind.
    pub fn parse(text: &str, arm: &Arm) -> Result<Truth, TruthError> {
        read(text, arm).map_err(TruthError::of(text))
    }

    /// What a robot file says.
    pub(super) fn known(known: &Known, arm: &Arm) -> Truth {
        Truth { effect: known.effect, place: known.spot.place, values: known.named(arm) }
    }

    /// The spots of the effect with the values of all parameters there.
    pub fn spots(&self, arm: &Arm) -> Vec<(Spot, Vec<f64>)> {
        self.effect.spots(arm, self.place, &self.values)
    }

    /// The value of a parameter; 0 if it is not named.
    pub fn value(&self, name: &str) -> f64 {
        self.values.iter().filter(|(n, _)| n == name).map(|(_, v)| *v).sum()
    }

    /// Whether this arm can have it.
    pub(super) fn check(&self, arm: &Arm) -> Result<(), String> {
        let Truth { effect, place, values } = self;
        if !effect.places(arm).contains(place) {
            return Err(cannot_act(*effect, &place.to_string(), arm));
        }
        for (k, (name, value)) in values.iter().enumerate() {
            if effect.number(arm, *place, name).is_none() {
                return Err(Numbers { effect: *effect, place: *place, arm }.unknown(name));
            }
            if !value.is_finite() {
                return Err(format!("`{name}`: found {value}, expected a finite number"));
            }
            once(values[..k].iter().map(|(earlier, _)| earlier.as_str()), name)?;
        }
        let form = effect.form_number().map(|number| number.name);
        let is_form = |name: &String| form.as_deref() == Some(name);
        if let Some(form) = form.as_deref().filter(|_| !values.iter().any(|(n, _)| is_form(n))) {
            let at = format!("{}@{place}", effect.identifier());
            return Err(format!(
                "found no `{form}`, expected it beside the size: `{at}:{form}=40,…`"
            ));
        }
        let forms = effect.forms_are();
        let wrong = values.iter().find(|(name, v)| is_form(name) && forms.form(*v).is_none());
        if let Some((name, value)) = wrong {
            return Err(format!("`{name}`: found {value}, expected {}", forms.expected(arm)));
        }
        if values.iter().all(|(name, value)| is_form(name) || *value == 0.0) {
            let names = effect.names(arm, *place);
            return Err(format!("found nothing but zeros, expected a size for {names}"));
        }
        Ok(())
    }
}

fn read(text: &str, arm: &Arm) -> Result<Truth, String> {
    let (head, size) = notation::split(text)?;
    let (effect, place) = at_place(head, arm, effects())?;
    let numbers = Numbers { effect, place, arm };
    let values = match size {
        Size::Missing => {
            let (names, name) = (effect.names(arm, place), effect.identifier());
            let numbers = format!("`{name}@{place}:NAME=VALUE,…`");
            return Err(format!("found no `=`, expected a size for {names}: {numbers}"));
        }
        Size::First(text) => vec![numbers.first(text)?],
        Size::Named(list) => {
            let value = |(name, text): &(String, &str)| numbers.value(name, text);
            list.iter().map(value).collect::<Result<_, _>>()?
        }
    };
    let truth = Truth { effect, place, values };
    truth.check(arm)?;
    Ok(truth)
}

/// An effect at a place of an arm, whose numbers are read.
struct Numbers<'a> {
    effect: &'a dyn Effect,
    place: Place,
    arm: &'a Arm,
}

impl Numbers<'_> {
    fn unknown(&self, found: &str) -> String {
        let Numbers { effect, place, arm } = self;
        let known = effect.numbers(arm, *place);
        let near = did_you_mean(nearest(found, known.iter().map(|p| p.name.as_ref())));
        let (names, name) = (effect.names(arm, *place), effect.identifier());
        format!("found the parameter `{found}`, expected {names} for {name} at {place}{near}")
    }

    fn value(&self, name: &str, text: &str) -> Result<(String, f64), String> {
        let number = self.effect.number(self.arm, self.place, name);
        let Parameter { quantity, .. } = number.ok_or_else(|| self.unknown(name))?.1;
        let value = quantity.read(text).ok_or_else(|| {
            let (found, units) = (text.trim(), quantity.units());
            format!("`{name}`: found `{found}`, expected a number and its unit: {units}")
        })?;
        Ok((name.to_owned(), value))
    }

    fn first(&self, text: &str) -> Result<(String, f64), String> {
        let Numbers { effect, place, arm } = self;
        let natural = !matches!(effect.forms_are(), Forms::Joints | Forms::Searched { .. });
        if let Some(first) = effect.numbers(arm, *place).first().filter(|_| natural) {
            return self.value(&first.name, text);
        }
        let (names, name) = (effect.names(arm, *place), effect.identifier());
        Err(format!(
            "found a size without a name, expected {names} for {name}: `{name}@{place}:NAME=VALUE`"
        ))
    }
}
