//! How an effect that is put into a plant is written.
//!
//! ```text
//! truth = effect [ "@" place ] ( "=" value | ":" name "=" value { "," name "=" value } )
//! ```
//!
//! `backlash@joint 2=0.3 mrad` gives the first or only parameter its value,
//! `tool_frame@tool:x=1mm,rz=0.5mrad` those that are named; the rest are 0. The place may be left
//! out where there is only one.

use core::fmt;

/// A truth that cannot be meant: what was found, what was expected.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("effect `{text}`: {fault}")]
pub struct TruthError {
    /// The whole text.
    pub text: String,
    /// What is wrong with it.
    pub fault: String,
}

impl TruthError {
    /// Of the text that is read.
    pub(super) fn of(text: &str) -> impl Fn(String) -> TruthError {
        move |fault| TruthError { text: text.trim().to_owned(), fault }
    }
}

/// What stands behind an effect and its place.
#[derive(Debug, PartialEq)]
pub(super) enum Size<'t> {
    /// Nothing.
    Missing,
    /// The value of the first or only parameter.
    First(&'t str),
    /// Names and values, each name once.
    Named(Vec<(String, &'t str)>),
}

/// An effect with its place, and its size.
pub(super) fn split(text: &str) -> Result<(&str, Size<'_>), String> {
    let Some(end) = text.find([':', '=']) else { return Ok((text, Size::Missing)) };
    let (head, size) = text.split_at(end);
    let Some(list) = size.strip_prefix(':') else { return Ok((head, Size::First(&size[1..]))) };
    let mut named: Vec<(String, &str)> = Vec::new();
    for part in list.split(',') {
        let (name, value) = part.split_once('=').ok_or_else(|| {
            let found = part.trim();
            format!("found `{found}`, expected name=value (numbers have a point, not a comma)")
        })?;
        // `joint2`, `cos  2`: one space stands between word and number.
        let name = name.split_whitespace().collect::<Vec<_>>().join(" ");
        once(named.iter().map(|(earlier, _)| earlier.as_str()), &name)?;
        named.push((name, value));
    }
    Ok((head, Size::Named(named)))
}

pub(super) fn once<'n>(
    mut earlier: impl Iterator<Item = &'n str>,
    name: &str,
) -> Result<(), String> {
    match earlier.any(|earlier| earlier == name) {
        true => Err(format!("found `{name}` twice, expected one value for it")),
        false => Ok(()),
    }
}

/// Writes an effect at a place with its numbers, so that it is read again.
pub(super) fn write<'n>(
    f: &mut fmt::Formatter<'_>,
    (effect, place): (&str, &dyn fmt::Display),
    numbers: impl Iterator<Item = (&'n str, f64)>,
) -> fmt::Result {
    write!(f, "{effect}@{place}")?;
    for (k, (name, value)) in numbers.enumerate() {
        write!(f, "{}{name}={value:e}", if k == 0 { ":" } else { "," })?;
    }
    Ok(())
}
