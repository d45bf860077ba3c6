//! The report of a diagnosis: one self-contained page, which opens with what to do and shows
//! everything behind it.
//!
//! [`Report`] is what goes into it. The page is a template (`templates/report.html`) filled from
//! [`page`]; what is drawn by the page's own scripts (the arm, residuals, fitted shapes) is
//! embedded as JSON ([`embedded`]), and so are the tables that it offers as CSV ([`table`]). Nothing in the
//! page refers to anything outside of it.

pub mod both;
mod corrections;
mod curves;
mod embedded;
mod experiment;
mod forest;
pub mod identified;
mod known;
pub mod logged;
mod method;
mod page;
mod performance;
mod rows;
mod scene;
mod shape;
mod steps;
mod table;
#[cfg(test)]
mod tests;
mod waterfall;
pub mod withheld;
mod words;
mod worst;

use stiffarm_gap::diagnose::{Diagnosis, Prediction};
use stiffarm_gap::{Measurements, Options};
use stiffarm_kernels::generic::Arm;

use crate::diagnose::Provenance;
use experiment::{Experiment, Share};
pub use page::capital;
pub use words::{Told, Unit, Words};

/// What a report is made of.
pub struct Report<'a> {
    /// The diagnosis.
    pub found: &'a Diagnosis,
    /// What it was made of.
    pub data: &'a Measurements,
    /// The arm of the robot file.
    pub arm: &'a Arm,
    /// The same with its tool where the measured frame was fitted.
    pub placed: &'a Arm,
    /// The gap of every row before and after, with the models fitted to all of them.
    pub gaps: &'a Prediction,
    /// How it was asked for.
    pub options: &'a Options,
    /// The diagnosis as it is said.
    pub words: &'a Words,
    /// Of what and how it was made.
    pub made: &'a Provenance,
}

impl<'a> Report<'a> {
    /// The page.
    ///
    /// # Errors
    /// [`askama::Error`] if the template cannot be filled.
    pub fn html(&self) -> Result<String, askama::Error> {
        page::html(self)
    }

    /// Whether positions are measured; else rotations are what is judged.
    fn has_positions(&self) -> bool {
        self.data.kind.components()[..3].contains(&true)
    }

    fn experiment(&self) -> Experiment<'a> {
        let found = self.found;
        let share = |place: &str| Share {
            place: place.to_owned(),
            share: found.places.iter().find(|s| s.place == place).map(|s| s.share),
            found: found.findings.iter().any(|f| f.place == place),
        };
        let places = found.places.iter().map(|s| s.place.as_str());
        let findings = found.findings.iter().map(|f| f.place.as_str());
        Experiment {
            data: self.data,
            arm: self.arm,
            placed: self.placed,
            markers: found.nuisances.iter().map(|n| (n.name.as_str(), n.translation)).collect(),
            gaps: [&self.gaps.before, &self.gaps.after],
            shares: places.chain(findings).map(share).collect(),
            length: &self.words.length,
            angle: &self.words.angle,
        }
    }

    /// In what the part of the gap is shown that is judged and drawn.
    fn main_unit(&self) -> &Unit {
        if self.has_positions() { &self.words.length } else { &self.words.angle }
    }
}
