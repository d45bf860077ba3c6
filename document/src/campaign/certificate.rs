//! The certificate of a campaign: what the page says, as far as one sheet of paper has room.

use super::{Campaign, Fitted, method};
use crate::words::less;
use crate::{Block, Document};

/// What a certificate says of how it was made.
const FACTS: [&str; 9] = [
    "date",
    "measurements",
    "SHA-256 of the measurements",
    "SHA-256 of the robot file",
    "noise, rms",
    "folds",
    "co-estimated",
    "seed",
    "stiffarm",
];

impl Campaign<'_> {
    /// One sheet of paper: what the arm reaches, before and after.
    pub fn certificate(&self, fitted: &Fitted<'_>) -> Document {
        let error = self.errors();
        let mut facts = method::method(self).facts;
        facts.retain(|(name, _)| FACTS.contains(name));
        facts.sort_by_key(|(name, _)| FACTS.iter().position(|fact| fact == name));
        let first = std::iter::once(Block::Sentence(self.sentence()));
        let verdicts = self.mistakes().into_iter().chain(self.acceptance());
        let shrink = format!(
            "With the findings the held-out {} is {}; the interval of 95 % is by resampling poses.",
            self.error(),
            less(&self.found.gap.shrink)
        );
        let sizes = vec![Block::Table(error.table), Block::Paragraph(shrink)];
        let sizes = Block::section(error.heading, sizes);
        let rest = [
            Block::section("Pose accuracy and repeatability", self.performance(fitted)),
            Block::section("Made from", vec![Block::Facts(facts)]),
        ];
        let blocks = first.chain(verdicts).chain([sizes]).chain(self.findings()).chain(rest);
        Document {
            robot: self.found.robot.clone(),
            about: "certificate of a calibration",
            facts: self.facts(),
            blocks: blocks.collect(),
        }
    }
}
