//! What this data could not have shown, an entry for each reason.

use super::Campaign;
use crate::words::{at, gathered, words};

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
            let groups = gathered(effects.map(|(effect, places)| (at(&places), words(effect))));
            let each =
                groups.into_iter().map(|(at, names)| format!("{} at {at}", names.join(", ")));
            format!("{}: {because}", each.collect::<Vec<_>>().join("; "))
        };
        let reasons = gathered(all.map(|one| (one.because(), (&*one.effect, &*one.place))));
        reasons.into_iter().map(text).collect()
    }
}
