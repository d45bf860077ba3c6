//! A log that was diagnosed, and everything that is made of it.

use std::path::PathBuf;

use serde::Serialize;
use stiffarm_codegen::robot::Robot;
use stiffarm_document::beside::LogCheck;
use stiffarm_document::log::{Fitted, Log as Reported, left};
use stiffarm_document::text::counted;
use stiffarm_document::{Document, Embedded};
use stiffarm_gap::log::effects::Catalogue;
use stiffarm_gap::log::model::Springs;
use stiffarm_gap::log::{
    Domain, Log, LogDiagnosis, LogOptions, Model, Names, TorqueSide, diagnosed_with,
};
use stiffarm_gap::spring::Spring;
use stiffarm_kernels::generic::Arm;

use super::super::corrected::made_from;
use super::super::{Found, PredictedLog, Settings};
use super::files::{self, Part};
use super::written::Written;
use crate::host::Host;
use crate::input::data::layout;
use crate::input::source::Source;
use crate::terminal::failure::Failure;
use crate::terminal::json;
use crate::terminal::progress::Stages;

/// A log, diagnosed.
pub struct Motion {
    source: Source,
    arm: Arm,
    /// What the columns of a log are called, and whether a map says it.
    names: (Names, bool),
    log: Log,
    found: LogDiagnosis,
    model: Model,
    check: Option<LogCheck>,
}

/// The diagnosis as it is written.
#[derive(Serialize)]
pub struct Told<'a> {
    #[serde(flatten)]
    diagnosis: &'a LogDiagnosis,
    #[serde(skip_serializing_if = "Option::is_none")]
    check: Option<&'a LogCheck>,
    /// The robot file with what was found: the whole is a robot to every command. Of currents there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    corrected: Option<String>,
}

fn motions(arm: &Arm) -> Vec<stiffarm_kernels::Motion> {
    arm.joints.iter().map(|joint| joint.motion).collect()
}

impl Motion {
    /// Reads and diagnoses a log, with the effects of `catalogue`.
    pub(in super::super) fn new(
        settings: &Settings,
        source: Source,
        parts: Vec<Part>,
        catalogue: Catalogue,
        host: &Host,
    ) -> Result<Motion, Failure> {
        let arm = source.arm()?;
        let names = settings.names(&source, host)?;
        let read = |parts| files::read(parts, &motions(&arm), &names);
        let log = read(parts)?;
        let other = settings.check.as_ref();
        let other =
            other.map(|path| read(files::parts(std::slice::from_ref(path), host)?)).transpose()?;
        // What stands nearer to the torques comes first.
        let side = settings.torque_side.or(log.side);
        let options = LogOptions {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            side: side.or_else(|| TorqueSide::named(source.robot.torque_side?)),
            rows: settings.rows.map(Domain::from),
            band: settings.band,
            standstill: settings.standstill,
            catalogue,
            effects: settings.effects.clone(),
            known: source.motion.clone(),
            payloads: layout(&source)?.payloads.map_or_else(Vec::new, |known| known.bodies),
            known_links: settings.known_masses,
            nested: settings.nested,
            seed: settings.seed,
        };
        let stages = Stages::new(host);
        let each = |found| {
            stages
                .say(format!("looking for effects of motion, {} found", counted(found, "finding")));
        };
        let (found, model) = diagnosed_with(&arm, &log, &options, &each)?;
        drop(stages);
        found.remarks.iter().for_each(|remark| host.note(remark));
        let names = (names, settings.map.is_some());
        let found = Motion { check: None, source, arm, names, log, found, model };
        let check = other.map(|other| found.predicted(&other)).transpose()?;
        Ok(Motion { check: check.map(|predicted| predicted.check), ..found })
    }

    /// Another log of the arm, as what was found has it.
    ///
    /// # Errors
    /// [`Failure`]: it cannot be read, or has not the rows that were diagnosed.
    pub fn predict(&self, paths: &[PathBuf], host: &Host) -> Result<PredictedLog, Failure> {
        self.predicted(&files::read(
            files::parts(paths, host)?,
            &motions(&self.arm),
            &self.names.0,
        )?)
    }

    fn predicted(&self, other: &Log) -> Result<PredictedLog, Failure> {
        let explained = self.model.explain(&self.arm, other)?;
        let check = LogCheck::of(&self.found, &self.model, other, &explained);
        Ok(PredictedLog { explained, check })
    }

    /// Whether a map says what its columns are called.
    pub(in super::super) fn is_mapped(&self) -> bool {
        self.names.1
    }

    pub(in super::super) fn told(&self) -> Told<'_> {
        Told {
            diagnosis: &self.found,
            check: self.check.as_ref(),
            corrected: self.corrected().ok(),
        }
    }

    /// The files of the log.
    pub(in super::super) fn files(&self) -> String {
        self.found.files.join(", ")
    }

    fn reported<'a>(&'a self, fitted: Option<Fitted<'a>>) -> Reported<'a> {
        Reported { found: &self.found, check: self.check.as_ref(), fitted }
    }

    /// What has to be known of any file of the corrected arm, a sentence each.
    pub(in super::super) fn caveats(&self) -> Vec<String> {
        // Of currents there is no file.
        self.written().ok().and_then(|written| written.lost).into_iter().collect()
    }

    fn written(&self) -> Result<Written, Failure> {
        let mut robot = self.source.robot.clone();
        robot.effects.extend(self.source.in_motion_alone());
        self.put_into(&robot, &self.model)
    }

    /// What was found, put into a robot; `model` may be the log's own beside what else is known.
    pub(in super::super) fn put_into(
        &self,
        robot: &Robot,
        model: &Model,
    ) -> Result<Written, Failure> {
        Written::of(robot, &self.arm, &self.log, &self.found, model)
    }

    /// What the log tells of the joints' springs.
    pub(in super::super) fn springs(&self) -> &Springs {
        &self.model.springs
    }

    /// What was found with other springs, and what it leaves of the log's joints, each as a part of
    /// its size, mean.
    pub(in super::super) fn beside(&self, springs: &[Spring]) -> Result<(Model, f64), Failure> {
        let model = self.model.beside(springs);
        let explained = model.explain(&self.arm, &self.log)?;
        let [_, left] = left(&explained.gap(model.rows, &self.found.gap));
        Ok((model, left))
    }
}

impl Found for Motion {
    fn motion(&self) -> Option<&Motion> {
        Some(self)
    }

    fn json(&self) -> Result<String, Failure> {
        json::text(&self.told())
    }

    fn document(&self, is_page: bool) -> Result<(Document, Embedded), Failure> {
        if !is_page {
            return Ok((self.reported(None).document(), Embedded::default()));
        }
        let explained = self.model.explain(&self.arm, &self.log)?;
        let fitted = Fitted { explained: &explained, arm: &self.arm };
        let reported = self.reported(Some(fitted));
        Ok((reported.document(), reported.embedded(&fitted, &self.found)?))
    }

    fn robot(&self) -> Result<(Vec<String>, Robot), Failure> {
        let written = self.written()?;
        let head = vec![made_from(&self.source, &self.files()), String::new()];
        Ok(([head, written.lines].concat(), written.robot))
    }
}
