//! The document of a campaign at rest.

mod certificate;
mod changes;
mod details;
mod errors;
mod findings;
mod hidden;
mod known;
mod method;
mod mistakes;
mod notes;
mod performance;
mod sentence;
#[cfg(test)]
mod tests;
mod worst;

use serde::Serialize;
use stiffarm_gap::diagnose::{Diagnosis, Explanation, Nuisance, NuisanceReport, Prediction};
use stiffarm_gap::{Measurements, Options};
use stiffarm_kernels::generic::Arm;

use super::figure::{Drawing, EXPERIMENT, Experiment, Share, curves};
use super::report::Report;
use super::{Document, Embedded, Unit, Units};
use crate::PageError;
use crate::beside::{Accepted, Check, Compared, Provenance};
use crate::text::counted;

/// What the document of a campaign is made of.
pub struct Campaign<'a> {
    /// What was found.
    pub found: &'a Diagnosis,
    /// In which rows.
    pub data: &'a Measurements,
    /// The arm of the robot file.
    pub arm: &'a Arm,
    /// How it was asked for.
    pub options: &'a Options,
    /// The prediction of another file.
    pub check: Option<&'a Check>,
    /// Against a tolerance.
    pub accepted: Option<&'a Accepted>,
    /// Against an earlier diagnosis.
    pub compared: Option<&'a Compared>,
    /// From what and how it was made.
    pub made: &'a Provenance,
    /// What only a page shows.
    pub fitted: Option<Fitted<'a>>,
}

/// The models before and after, fitted to all rows.
#[derive(Clone, Copy)]
pub struct Fitted<'a> {
    /// Where base, tool, and what is mounted on it were fitted.
    pub explanation: &'a Explanation,
    /// The residual of every row before and after.
    pub gaps: &'a Prediction,
}

impl Campaign<'_> {
    /// What a terminal and a page have.
    pub fn document(&self) -> Document {
        let behind = [self.findings(), self.rivals(), self.changes()];
        let report = Report {
            robot: self.found.robot.clone(),
            about: "where its error comes from",
            facts: self.facts(),
            sentence: self.sentence(),
            first: self.mistakes().into_iter().chain(self.acceptance()).collect(),
            error: self.errors(),
            rest: behind.into_iter().flatten().chain(self.notes()).collect(),
            page: self.fitted.map(|fitted| (self.details(&fitted), method::method(self))),
        };
        report.document()
    }

    /// What its page embeds; `whole` is the diagnosis as it is written.
    pub fn embedded(
        &self,
        fitted: &Fitted<'_>,
        whole: &impl Serialize,
    ) -> Result<Embedded, PageError> {
        let curves = curves(self.found, self.data, &self.options.catalogue);
        Embedded::new(Drawing::of(self.experiment(fitted), &curves), whole, EXPERIMENT)
    }

    fn experiment<'b>(&'b self, fitted: &Fitted<'b>) -> Experiment<'b> {
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
            placed: fitted.explanation.arm(),
            mounts: fitted.explanation.mounts().collect(),
            markers: found.nuisances.iter().map(|n| (n.name.as_str(), n.translation)).collect(),
            gaps: [&fitted.gaps.before, &fitted.gaps.after],
            shares: places.chain(findings).map(share).collect(),
            length: self.length(),
            angle: self.angle(),
        }
    }

    fn facts(&self) -> String {
        let (found, data) = (self.found, self.data);
        let held_out = match found.held_out.folds == data.poses {
            true => "each pose held out in turn".to_owned(),
            false => format!("held out in {} folds of poses", found.held_out.folds),
        };
        let rows = counted(found.measurements, "measurement");
        let (measured, poses) = (data.subject(), counted(data.poses, "pose"));
        let own = |frame: &NuisanceReport| Nuisance::BaseFrame.identifier() == frame.name;
        let each = match found.nuisances.iter().any(|f| own(f) && f.session.is_some()) {
            true => ", each with its own frame",
            false => "",
        };
        let sessions = match data.sessions().count() {
            0 | 1 => String::new(),
            n => format!(", in {n} sessions{each}"),
        };
        let own = match data.sim_given.contains(&true) {
            true => ", against the simulator of its sim_ columns",
            false => "",
        };
        format!("{}: {rows} of {measured} at {poses}, {held_out}{sessions}{own}", data.file)
    }

    fn units(&self) -> Units {
        Units::of(self.data)
    }

    fn length(&self) -> Unit<'static> {
        let gap = &self.found.gap;
        self.units().length([gap.before.position_rms, gap.after.position_rms])
    }

    fn angle(&self) -> Unit<'static> {
        let gap = &self.found.gap;
        self.units().angle([gap.before.rotation_rms, gap.after.rotation_rms])
    }

    /// The unit of what is judged: positions, or rotations where no position is measured.
    fn main(&self) -> Unit<'static> {
        self.units().main(self.rms())
    }

    /// What is judged.
    fn error(&self) -> &'static str {
        self.units().error()
    }

    /// The error before and after, rms, m (rad without positions).
    fn rms(&self) -> [f64; 2] {
        [&self.found.gap.before, &self.found.gap.after].map(|sizes| self.units().judged(sizes))
    }

    fn noise(&self) -> f64 {
        let noise = &self.found.gap.noise;
        if self.units().positions { noise.position_rms } else { noise.rotation_rms }
    }
}
