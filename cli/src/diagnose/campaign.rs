//! A campaign that was diagnosed, and everything that is made of it.

use std::path::Path;

use serde::Serialize;
use sha2::{Digest, Sha256};
use stiffarm_codegen::robot::Robot;
use stiffarm_document::beside::{Accepted, Check, Compared, Hashes, Provenance};
use stiffarm_document::campaign::{Campaign as Reported, Fitted};
use stiffarm_document::{Document, Embedded};
use stiffarm_gap::diagnose::{BesideLog, Diagnosed, Explanation, Nuisance, Prediction, Trust};
use stiffarm_gap::effects::Catalogue;
use stiffarm_gap::gap::Statistics;
use stiffarm_gap::measurement::{Dimension, Layout};
use stiffarm_gap::spring::Spring;
use stiffarm_gap::{Diagnosis, Measurements, Options, diagnose_with};
use stiffarm_kernels::generic::Arm;

use super::corrected::{Corrections, commented, made_from};
use super::log::Part;
use super::{Found, Settings, accepted, compared as earlier, in_words, provenance};
use crate::host::Host;
use crate::input::source::Source;
use crate::input::{data, quantity};
use crate::terminal::failure::Failure;
use crate::terminal::json;
use crate::terminal::progress::Stages;

/// A campaign, diagnosed.
pub struct Campaign {
    source: Source,
    arm: Arm,
    options: Options,
    layout: Layout,
    data: Measurements,
    diagnosed: Diagnosed,
    doubts: Vec<String>,
    check: Option<Check>,
    accepted: Option<Accepted>,
    compared: Option<Compared>,
    made: Provenance,
}

/// The diagnosis as it is written.
#[derive(Serialize)]
pub(super) struct Told<'a> {
    #[serde(flatten)]
    diagnosis: &'a Diagnosis,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    doubts: &'a Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    check: Option<&'a Check>,
    #[serde(skip_serializing_if = "Option::is_none")]
    accept: Option<&'a Accepted>,
    #[serde(skip_serializing_if = "Option::is_none")]
    compared: Option<&'a Compared>,
    #[serde(flatten)]
    hashes: &'a Hashes,
    /// How well the numbers are known at other rows.
    trust: Trust,
    /// The robot file with what was found: the whole is a robot to every command.
    corrected: String,
}

impl Campaign {
    /// Reads and diagnoses the measurements in `files` as one campaign, with the effects of `catalogue` and the springs
    /// that a log tells.
    pub(super) fn new(
        settings: &Settings,
        source: Source,
        files: Vec<Part>,
        springs: &[Spring],
        catalogue: Catalogue,
        host: &Host,
    ) -> Result<Campaign, Failure> {
        let length = |text: &String| quantity::with_unit("--accept", text, Dimension::Length);
        let tolerance = settings.accept.as_ref().map(length).transpose()?;
        let arm = source.arm()?;
        let options = settings.options(&source, &arm, springs, catalogue, host)?;
        let layout = data::layout_beside(settings.bench.as_deref(), &source, host)?;
        let (mut data, mut hash) = (None::<Measurements>, Sha256::new());
        for file in &files {
            let next = file.measurements(&layout, &mut hash, host)?;
            data = Some(match data {
                Some(data) => data.and(next).map_err(|error| data::refusal(&[], &error))?,
                None => next,
            });
        }
        let read = data.zip(files.first());
        let (data, first) =
            read.ok_or_else(|| Failure::new("found no measurements, expected a file"))?;
        // Frames that are elsewhere are the diagnosis' to tell.
        let doubts = data::doubted(&arm, &data, &Nuisance::ALL, host);
        let other =
            settings.check.as_ref().map(|path| data::read(path, &layout, host)).transpose()?;
        if let Some(other) = &other {
            data::doubted(&arm, other, &Nuisance::ALL, host);
        }
        let stages = Stages::new(host);
        let mut diagnosed =
            diagnose_with(&arm, &data, &options, &|stage| stages.say(in_words(stage)))?;
        drop(stages);
        // All that follows is of the file without its mistakes.
        let (mut source, mut arm, mut data) = (source, arm, data);
        let mended = diagnosed.mended.take();
        let diagnosed_rows = mended.as_ref().map_or(&data, |mended| &mended.data);
        let check = |other| Check::of(&diagnosed, mended.as_ref(), diagnosed_rows, &other);
        let check = other.map(check).transpose()?;
        if let Some(mended) = mended {
            source.robot = mended.robot(&source.robot);
            (arm, data) = (mended.arm, mended.data);
        }
        let found = &diagnosed.diagnosis;
        let made = provenance::of(&first.path, hash, &source.text, host)?;
        let compared = settings.compare.as_ref();
        let compared = compared.map(|last| earlier::with(last, found, &made.hashes, host));
        let compared = compared.transpose()?;
        let has_positions = data.kind.components()[..3].contains(&true);
        let judge = |tolerance| accepted::judge(tolerance, found, check.as_ref(), has_positions);
        let accepted = tolerance.map(judge).transpose()?;
        Ok(Campaign {
            source,
            arm,
            options,
            layout,
            data,
            diagnosed,
            doubts,
            check,
            accepted,
            compared,
            made,
        })
    }

    /// Whether the corrected arm is within the tolerance that was asked for; none is always kept.
    pub fn is_accepted(&self) -> bool {
        self.accepted.as_ref().is_none_or(|accepted| accepted.accepted)
    }

    /// Whether what was measured is no arm's, and no mistake explains why.
    pub(super) fn is_unexplained(&self) -> bool {
        let mistaken = self.diagnosed.diagnosis.mistaken.as_ref();
        mistaken.is_some_and(|mistaken| mistaken.mistakes.is_empty())
    }

    pub(super) fn told(&self) -> Told<'_> {
        Told {
            diagnosis: &self.diagnosed.diagnosis,
            doubts: &self.doubts,
            check: self.check.as_ref(),
            accept: self.accepted.as_ref(),
            compared: self.compared.as_ref(),
            hashes: &self.made.hashes,
            trust: self.diagnosed.explanation.trust(),
            corrected: {
                let corrections = self.corrections();
                commented(corrections.head(), corrections.robot())
            },
        }
    }

    /// What is said together with a log.
    pub(super) fn beside_log(&self) -> Option<&BesideLog> {
        self.diagnosed.beside_log.as_ref()
    }

    /// Position error that two models leave, root mean squares, m (of the rotation, rad, where no
    /// position is measured): that of these rows alone, and that beside what a log tells.
    pub(super) fn left(&self) -> Result<(&'static str, [f64; 2]), Failure> {
        let alone = &self.diagnosed.explanation;
        let both = self.beside_log().map_or(alone, |both| &both.explanation);
        let positions = self.data.kind.components()[..3].contains(&true);
        let left = |model: &Explanation| {
            let gaps = model.predict(&self.data)?.after;
            let left = Statistics::of_rows(self.data.kind, self.data.rows.iter().zip(&gaps));
            let rms = if positions { left.position_rms } else { left.rotation_rms };
            Ok::<_, Failure>(rms)
        };
        Ok((if positions { "m" } else { "rad" }, [left(alone)?, left(both)?]))
    }

    /// The first line of a robot file that these rows and some files of logs have corrected.
    pub(super) fn made_with(&self, logs: &str) -> String {
        made_from(&self.source, &format!("{} and {logs}", self.data.file))
    }

    pub(super) fn corrections(&self) -> Corrections<'_> {
        Corrections::new(&self.source, &self.data, &self.diagnosed)
    }

    fn reported<'a>(&'a self, fitted: Option<Fitted<'a>>) -> Reported<'a> {
        Reported {
            found: &self.diagnosed.diagnosis,
            data: &self.data,
            arm: &self.arm,
            options: &self.options,
            check: self.check.as_ref(),
            accepted: self.accepted.as_ref(),
            compared: self.compared.as_ref(),
            made: &self.made,
            fitted,
        }
    }

    /// What a certificate says.
    pub(super) fn certified(&self) -> Result<Document, Failure> {
        let explanation = &self.diagnosed.explanation;
        let gaps = explanation.predict(&self.data)?;
        Ok(self.reported(None).certificate(&Fitted { explanation, gaps: &gaps }))
    }

    /// What the models before and after make of other measurements of the arm.
    ///
    /// # Errors
    /// [`Failure`]: the measurements' mistakes, or what was never fitted.
    pub fn predict(&self, path: &Path, host: &Host) -> Result<Prediction, Failure> {
        let data = data::read(path, &self.layout, host)?;
        Ok(self.diagnosed.explanation.predict(&data)?)
    }
}

impl Found for Campaign {
    fn campaign(&self) -> Option<&Campaign> {
        Some(self)
    }

    fn json(&self) -> Result<String, Failure> {
        json::text(&self.told())
    }

    fn document(&self, is_page: bool) -> Result<(Document, Embedded), Failure> {
        if !is_page {
            return Ok((self.reported(None).document(), Embedded::default()));
        }
        let explanation = &self.diagnosed.explanation;
        let gaps = explanation.predict(&self.data)?;
        let fitted = Fitted { explanation, gaps: &gaps };
        let reported = self.reported(Some(fitted));
        Ok((reported.document(), reported.embedded(&fitted, &self.diagnosed.diagnosis)?))
    }

    fn robot(&self) -> Result<(Vec<String>, Robot), Failure> {
        let corrections = self.corrections();
        Ok((corrections.head(), corrections.robot().clone()))
    }
}
