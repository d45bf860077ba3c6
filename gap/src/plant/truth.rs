//! What is put into the plant, and the text in which it is said.
//!
//! ```text
//! truth  = effect [ "@" place ] ( "=" value | ":" name "=" value { "," name "=" value } )
//! place  = "base" | "joint" i | "link" i | "tool" | "arm" | "instrument"
//! value  = number [ unit ]
//! ```
//!
//! `backlash@joint 2=0.3 mrad` gives the first or only parameter its value,
//! `tool_frame@tool:x=1mm,rz=0.5mrad` those that are named; the rest are 0. The place may be left
//! out where there is only one. A number without a unit is in SI.

use core::fmt;

use stiffarm_kernels::generic::Arm;

use super::laws::effects;
use crate::effects::{Effect, Forms, Known, Parameter, Place, Spot};
use crate::measurement::nearest;

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

/// A truth that cannot be meant: what was found, what was expected.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("effect `{text}`: {fault}")]
pub struct TruthError {
    /// The whole text.
    pub text: String,
    /// What is wrong with it.
    pub fault: String,
}

impl fmt::Display for Truth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}@{}", self.effect.identifier(), self.place)?;
        for (k, (name, value)) in self.values.iter().enumerate() {
            write!(f, "{}{name}={value:e}", if k == 0 { ":" } else { "," })?;
        }
        Ok(())
    }
}

fn did_you_mean(near: Option<&str>) -> String {
    near.map_or_else(String::new, |n| format!("; did you mean `{n}`?"))
}

impl Truth {
    /// Reads a truth about this arm.
    ///
    /// # Errors
    /// [`TruthError`]: an unknown effect, a place where it cannot act, an unknown parameter, or a
    /// value that is no number of the right kind.
    pub fn parse(text: &str, arm: &Arm) -> Result<Truth, TruthError> {
        let wrong = |fault: String| TruthError { text: text.trim().to_owned(), fault };
        let end = text.find([':', '=']).ok_or_else(|| {
            wrong("found no `=`, expected a size: `backlash@joint 2=0.3 mrad`".to_owned())
        })?;
        let (head, size) = text.split_at(end);
        let (name, place) = match head.split_once('@') {
            Some((name, place)) => (name.trim(), Some(place.trim())),
            None => (head.trim(), None),
        };
        let known = effects().into_iter().find(|effect| effect.identifier() == name);
        let effect = known.ok_or_else(|| wrong(unknown_effect(name)))?;
        let place = read_place(effect, place, arm).map_err(wrong)?;
        let values = match size.strip_prefix(':') {
            Some(list) => named_values(effect, place, arm, list).map_err(wrong)?,
            None => {
                let value = size.trim_start_matches('=');
                vec![first_value(effect, place, arm, value).map_err(wrong)?]
            }
        };
        let truth = Truth { effect, place, values };
        truth.check(arm).map_err(wrong)?;
        Ok(truth)
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
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub(super) fn check(&self, arm: &Arm) -> Result<(), String> {
        let Truth { effect, place, values } = self;
        if !effect.places(arm).contains(place) {
            return Err(cannot_act(*effect, &place.to_string(), arm));
        }
        for (k, (name, value)) in values.iter().enumerate() {
            if effect.number(arm, *place, name).is_none() {
                return Err(unknown_parameter(*effect, *place, arm, name));
            }
            if !value.is_finite() {
                return Err(format!("`{name}`: found {value}, expected a finite number"));
            }
            if values[..k].iter().any(|(earlier, _)| earlier == name) {
                return Err(format!("found `{name}` twice, expected one value for it"));
            }
        }
        let form = effect.form_number().map(|number| number.name);
        let is_form = |name: &String| form.as_deref() == Some(name);
        if let Some(form) = form.as_deref().filter(|_| !values.iter().any(|(n, _)| is_form(n))) {
            let at = format!("{}@{place}", effect.identifier());
            let expected = format!("expected the row after which it happens: `{at}:{form}=40,…`");
            return Err(format!("found no `{form}`, {expected}"));
        }
        if values.iter().all(|(name, value)| is_form(name) || *value == 0.0) {
            let names = effect.names(arm, *place);
            return Err(format!("found nothing but zeros, expected a size for {names}"));
        }
        Ok(())
    }
}

fn unknown_effect(found: &str) -> String {
    let all: Vec<&str> = effects().into_iter().map(Effect::identifier).collect();
    let near = did_you_mean(nearest(found, all.iter().copied()));
    format!("found the unknown effect `{found}`{near}, expected one of {}", all.join(", "))
}

fn cannot_act(effect: &dyn Effect, found: &str, arm: &Arm) -> String {
    let places: Vec<String> = effect.places(arm).iter().map(Place::to_string).collect();
    let name = effect.identifier();
    if places.is_empty() {
        return format!("{} has no place for {name}", arm.name);
    }
    let near = did_you_mean(nearest(found, places.iter().map(String::as_str)));
    format!("found the place `{found}`, expected one of {} for {name}{near}", places.join(", "))
}

fn read_place(effect: &dyn Effect, found: Option<&str>, arm: &Arm) -> Result<Place, String> {
    let places = effect.places(arm);
    let Some(found) = found else {
        return match places.as_slice() {
            [only] => Ok(*only),
            _ => Err(cannot_act(effect, "", arm).replace("the place ``", "no place")),
        };
    };
    // `joint2` and `joint  2` are `joint 2`.
    let plain = |text: &str| text.split_whitespace().collect::<String>();
    let meant = places.into_iter().find(|p| plain(&p.to_string()) == plain(found));
    meant.ok_or_else(|| cannot_act(effect, found, arm))
}

fn unknown_parameter(effect: &dyn Effect, place: Place, arm: &Arm, found: &str) -> String {
    let known = effect.numbers(arm, place);
    let near = did_you_mean(nearest(found, known.iter().map(|p| p.name.as_ref())));
    let names = effect.names(arm, place);
    format!(
        "found the parameter `{found}`, expected {names} for {} at {place}{near}",
        effect.identifier()
    )
}

fn read_value(
    effect: &dyn Effect,
    place: Place,
    arm: &Arm,
    name: &str,
    text: &str,
) -> Result<(String, f64), String> {
    let (_, Parameter { quantity, .. }) = effect
        .number(arm, place, name)
        .ok_or_else(|| unknown_parameter(effect, place, arm, name))?;
    let value = quantity.read(text).ok_or_else(|| {
        let found = text.trim();
        format!("`{name}`: found `{found}`, expected a number and its unit: {}", quantity.units())
    })?;
    Ok((name.to_owned(), value))
}

fn first_value(
    effect: &dyn Effect,
    place: Place,
    arm: &Arm,
    text: &str,
) -> Result<(String, f64), String> {
    let natural = !matches!(effect.forms_are(), Forms::Joints | Forms::Rows);
    match effect.numbers(arm, place).first().filter(|_| natural) {
        Some(first) => read_value(effect, place, arm, &first.name, text),
        None => Err(format!(
            "found a size without a name, expected {} for {}: `{}@{place}:NAME=VALUE`",
            effect.names(arm, place),
            effect.identifier(),
            effect.identifier(),
        )),
    }
}

fn named_values(
    effect: &dyn Effect,
    place: Place,
    arm: &Arm,
    list: &str,
) -> Result<Vec<(String, f64)>, String> {
    let each = list.split(',').map(|part| {
        let (name, value) = part.split_once('=').ok_or_else(|| {
            let found = part.trim();
            format!("found `{found}`, expected name=value (numbers have a point, not a comma)")
        })?;
        // `joint2`, `cos  2`: one space stands between word and number.
        let name = name.split_whitespace().collect::<Vec<_>>().join(" ");
        read_value(effect, place, arm, &name, value)
    });
    each.collect()
}
