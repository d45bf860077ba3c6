//! The diagnosis as it is said, for others to show.

use super::Screen;
use super::unit::Shown;
use crate::report::{Told, Unit, Words};

impl Screen<'_> {
    /// The sentence, the findings and what is hidden, in the screen's words and units.
    pub fn words(&self) -> Words {
        let gap = &self.found.gap;
        let told = |finding: &_| Told { said: self.said(finding), numbers: self.numbers(finding) };
        let length = self
            .length(gap.before.position_rms.min(gap.after.position_rms), gap.before.position_rms);
        let angle = self
            .angle(gap.before.rotation_rms.min(gap.after.rotation_rms), gap.before.rotation_rms);
        Words {
            sentence: self.sentence(),
            findings: self.found.findings.iter().map(told).collect(),
            hidden: self.hidden(),
            acceptance: self.acceptance(),
            changes: self.changes(),
            since: self.compared.map_or_else(String::new, |compared| compared.file.clone()),
            length: unit(length),
            angle: unit(angle),
        }
    }
}

fn unit(shown: Shown) -> Unit {
    Unit { name: shown.name, si: shown.size, decimals: shown.decimals }
}
