//! Words and numbers that every document uses.

use stiffarm_gap::shrink::Shrink;

pub use crate::text::words;
use crate::text::{decimals, fixed};

/// `joint compliance at joint 2`.
pub fn named(effect: &str, place: &str) -> String {
    format!("{} at {place}", words(effect))
}

/// With a capital letter at its beginning.
pub fn capital(text: &str) -> String {
    begun(text, |letter| letter.to_uppercase().to_string())
}

/// With a small letter at its beginning.
pub fn lower(text: &str) -> String {
    begun(text, |letter| letter.to_lowercase().to_string())
}

fn begun(text: &str, as_first: fn(char) -> String) -> String {
    let mut letters = text.chars();
    letters.next().map(as_first).unwrap_or_default() + letters.as_str()
}

/// `a, b and c`, with `and` as what stands before the last.
pub fn joined(entries: &[String], and: &str) -> String {
    match entries {
        [first @ .., last] if !first.is_empty() => format!("{}{and}{last}", first.join(", ")),
        _ => entries.concat(),
    }
}

/// Values under the key that they share, in the order in which the keys first appear.
pub fn gathered<K: PartialEq, V>(pairs: impl Iterator<Item = (K, V)>) -> Vec<(K, Vec<V>)> {
    let mut all: Vec<(K, Vec<V>)> = Vec::new();
    for (key, value) in pairs {
        match all.iter_mut().find(|(known, _)| *known == key) {
            Some((_, values)) => values.push(value),
            None => all.push((key, vec![value])),
        }
    }
    all
}

/// `joints 1 to 4, 6`: places, those of one kind together and in order.
pub fn at(places: &[&str]) -> String {
    let plain = places.iter().filter(|place| numbered(place).is_none());
    let kinds = gathered(places.iter().filter_map(|place| numbered(place)));
    let kinds = kinds.into_iter().map(|(kind, mut numbers)| {
        numbers.sort_unstable();
        numbers.dedup();
        let plural = if numbers.len() > 1 { "s" } else { "" };
        format!("{kind}{plural} {}", ranges(&numbers))
    });
    plain.map(|place| (*place).to_owned()).chain(kinds).collect::<Vec<_>>().join(", ")
}

/// The kind and the number of a place that has one.
fn numbered(place: &str) -> Option<(&str, usize)> {
    let (kind, number) = place.split_once(' ')?;
    Some((kind, number.parse().ok()?))
}

/// `1 to 4, 6`; from ascending numbers.
fn ranges(numbers: &[usize]) -> String {
    let mut runs: Vec<[usize; 2]> = Vec::new();
    for &n in numbers {
        match runs.last_mut() {
            Some(run) if run[1] + 1 == n => run[1] = n,
            _ => runs.push([n, n]),
        }
    }
    let text = |[from, to]: [usize; 2]| match to - from {
        0 => from.to_string(),
        1 => format!("{from}, {to}"),
        _ => format!("{from} to {to}"),
    };
    runs.into_iter().map(text).collect::<Vec<_>>().join(", ")
}

/// A part in per cent.
pub fn percent(part: f64) -> String {
    format!("{} %", fixed(100.0 * part, 0))
}

/// A share in per cent; one that is not nothing is not 0 %.
pub fn share(part: f64) -> String {
    if part > 0.0 && part < 0.005 { "less than 1 %".to_owned() } else { percent(part) }
}

/// How much less is left, with its 95 % interval.
pub fn less(shrink: &Shrink) -> String {
    let [low, high] = shrink.shrink_ci95.map(|x| fixed(100.0 * x, 0));
    format!("{} less [{low} to {high}]", percent(shrink.shrink))
}

/// A p value with two digits; one that is smaller than rounding is only bounded.
pub fn p_value(p: f64) -> String {
    match p {
        p if p < 1e-15 => "p < 1e-15".to_owned(),
        p if p < 1e-3 => format!("p = {p:.1e}"),
        p => format!("p = {p:.*}", decimals(p, 2)),
    }
}

/// Where a noise is known from.
pub fn noise_from(source: &str) -> &'static str {
    match source {
        "residual" => "estimated from the residuals",
        "repeats" => "from repeats",
        "columns" => "from the sigma columns",
        _ => "as given",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_joined() {
        let joints = ["joint 1", "joint 10", "joint 2", "joint 3", "joint 5", "joint 6"];
        assert_eq!(at(&joints), "joints 1 to 3, 5, 6, 10");
        assert_eq!(at(&["link 2"]), "link 2");
        assert_eq!(at(&["base", "tool"]), "base, tool");
    }
}
