//! What reality does, in half a sentence with its size.

use stiffarm_gap::effects::{Effect, Told};
use stiffarm_gap::report::Finding;

use super::Screen;

impl Screen<'_> {
    /// The effect of a finding.
    pub(super) fn effect(&self, finding: &Finding) -> Option<&'static dyn Effect> {
        self.catalogue.named(&finding.effect)
    }

    /// `joint 2 twists 0.150 µrad/(N·m) more than modelled`.
    pub(super) fn said(&self, finding: &Finding) -> String {
        let write =
            |unit: &str, most: f64, value: f64| self.unit(finding, unit, most).with_unit(value);
        let (place, numbers) = (finding.place.as_str(), &finding.parameters[..]);
        match self.effect(finding) {
            Some(effect) => effect.sentence(&Told { place, numbers, write: &write }),
            None => Self::named(&finding.effect, place),
        }
    }
}
