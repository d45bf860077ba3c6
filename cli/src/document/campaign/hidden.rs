//! What this data could not have shown, an entry for each reason.

use super::Campaign;
use crate::document::words::{gathered, words};

impl Campaign<'_> {
    /// `joint compliance at joints 1, 6: no load of this data reaches the joint`; one entry for
    /// each reason. What was found in spite of it is left out.
    pub(super) fn hidden(&self) -> Vec<String> {
        let found = |effect: &str, place: &str| {
            self.found.findings.iter().any(|finding| finding.is(effect, place))
        };
        let all = self.found.cannot_see.iter().filter(|one| !found(&one.effect, &one.place));
        let text = |(because, all): (&str, Vec<(&str, &str)>)| {
            // Effects that are hidden at the same places are named together.
            let effects = gathered(all.into_iter()).into_iter();
            let groups = gathered(effects.map(|(effect, places)| (joined(&places), words(effect))));
            let each =
                groups.into_iter().map(|(at, names)| format!("{} at {at}", names.join(", ")));
            format!("{}: {because}", each.collect::<Vec<_>>().join("; "))
        };
        let reasons = gathered(all.map(|one| (one.because(), (&*one.effect, &*one.place))));
        reasons.into_iter().map(text).collect()
    }
}

/// `joints 1 to 4, 6`; places of one kind, in order.
fn joined(places: &[&str]) -> String {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_joined() {
        let joints = ["joint 1", "joint 10", "joint 2", "joint 3", "joint 5", "joint 6"];
        assert_eq!(joined(&joints), "joints 1 to 3, 5, 6, 10");
        assert_eq!(joined(&["link 2"]), "link 2");
        assert_eq!(joined(&["base", "tool"]), "base, tool");
    }
}
