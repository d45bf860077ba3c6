//! What this data could not have shown, an entry for each reason.

use super::Campaign;
use crate::document::words::words;

/// An effect and the places where it is hidden.
type Hidden<'a> = (&'a str, Vec<&'a str>);

impl Campaign<'_> {
    /// `joint compliance at joints 1, 6: no load of this data reaches the joint`; one entry for
    /// each reason. What was found in spite of it is left out.
    pub(super) fn hidden(&self) -> Vec<String> {
        let mut reasons: Vec<(&str, Vec<Hidden<'_>>)> = Vec::new();
        for one in &self.found.cannot_see {
            if self.found.findings.iter().any(|f| f.is(&one.effect, &one.place)) {
                continue;
            }
            let known = reasons.iter().position(|(because, _)| *because == one.because());
            let at = known.unwrap_or_else(|| {
                reasons.push((one.because(), Vec::new()));
                reasons.len() - 1
            });
            let effects = &mut reasons[at].1;
            match effects.iter_mut().find(|(effect, _)| *effect == one.effect) {
                Some((_, places)) => places.push(&one.place),
                None => effects.push((&one.effect, vec![&one.place])),
            }
        }
        let text = |(because, effects): (&str, Vec<Hidden<'_>>)| {
            // Effects that are hidden at the same places are named together.
            let mut groups: Vec<(String, Vec<String>)> = Vec::new();
            for (effect, places) in effects {
                let places = joined(&places);
                match groups.iter_mut().find(|(there, _)| *there == places) {
                    Some((_, names)) => names.push(words(effect)),
                    None => groups.push((places, vec![words(effect)])),
                }
            }
            let each =
                groups.into_iter().map(|(at, names)| format!("{} at {at}", names.join(", ")));
            format!("{}: {because}", each.collect::<Vec<_>>().join("; "))
        };
        reasons.into_iter().map(text).collect()
    }
}

/// `joints 1 to 4, 6`; places of one kind, in order.
fn joined(places: &[&str]) -> String {
    let mut kinds: Vec<(&str, Vec<usize>)> = Vec::new();
    let mut plain: Vec<String> = Vec::new();
    for place in places {
        let numbered = place.split_once(' ').and_then(|(kind, n)| Some((kind, n.parse().ok()?)));
        match numbered {
            Some((kind, n)) => match kinds.iter_mut().find(|(k, _)| *k == kind) {
                Some((_, numbers)) => numbers.push(n),
                None => kinds.push((kind, vec![n])),
            },
            None => plain.push((*place).to_owned()),
        }
    }
    for (kind, mut numbers) in kinds {
        numbers.sort_unstable();
        numbers.dedup();
        let plural = if numbers.len() > 1 { "s" } else { "" };
        plain.push(format!("{kind}{plural} {}", ranges(&numbers)));
    }
    plain.join(", ")
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
