//! An effect at a place, as people write it: `backlash@joint 2`.

use stiffarm_kernels::generic::Arm;

use super::{AtRest, Place};
use crate::io::{did_you_mean, nearest};

/// Reads `effect[@place]`; the place may be left out where there is only one.
///
/// # Errors
/// What is wrong with it, in words: an unknown effect, or a place where it cannot act.
pub fn at_place(
    text: &str,
    arm: &Arm,
    known: impl IntoIterator<Item = &'static dyn AtRest>,
) -> Result<(&'static dyn AtRest, Place), String> {
    let (name, place) = match text.split_once('@') {
        Some((name, place)) => (name.trim(), Some(place.trim())),
        None => (text.trim(), None),
    };
    let known: Vec<_> = known.into_iter().collect();
    let effect = known.iter().find(|effect| effect.identifier() == name);
    let effect = *effect.ok_or_else(|| unknown_effect(name, &known))?;
    Ok((effect, read_place(effect, place, arm)?))
}

fn unknown_effect(found: &str, known: &[&dyn AtRest]) -> String {
    let all: Vec<&str> = known.iter().map(|effect| effect.identifier()).collect();
    let near = did_you_mean(nearest(found, all.iter().copied()));
    format!("found the unknown effect `{found}`{near}, expected one of {}", all.join(", "))
}

/// Of an effect that cannot act at the place `found`: where it can act instead.
pub fn cannot_act(effect: &dyn AtRest, found: &str, arm: &Arm) -> String {
    let places: Vec<String> = effect.places(arm).iter().map(Place::to_string).collect();
    let name = effect.identifier();
    let which = match effect.acts_at() {
        "" => String::new(),
        which => format!(", which acts at {which}"),
    };
    if places.is_empty() {
        return format!("{} has no place for {name}{which}", arm.name);
    }
    let near = did_you_mean(nearest(found, places.iter().map(String::as_str)));
    let places = places.join(", ");
    format!("found the place `{found}`, expected one of {places} for {name}{which}{near}")
}

fn read_place(effect: &dyn AtRest, found: Option<&str>, arm: &Arm) -> Result<Place, String> {
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
