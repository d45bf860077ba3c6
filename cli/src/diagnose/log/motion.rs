//! A log that was diagnosed, and everything that is made of it.

use serde::Serialize;
use stiffarm_codegen::robot::Robot;
use stiffarm_gap::log::model::Springs;
use stiffarm_gap::log::{
    Domain, Log, LogDiagnosis, LogOptions, Model, Refused, TorqueSide, diagnosed,
};
use stiffarm_gap::spring::Spring;
use stiffarm_kernels::generic::Arm;

use super::super::corrected::{exported, file, made_from};
use super::super::{Args, Format};
use super::files::{self, Part};
use super::written::Written;
use super::{Check, Rows};
use crate::input::data::layout;
use crate::input::source::Source;
use crate::report::logged::Logged;
use crate::screen::log as screen;
use crate::terminal::failure::Failure;
use crate::terminal::json;
use crate::terminal::note::note;

/// A log, diagnosed.
pub struct Motion {
    source: Source,
    arm: Arm,
    log: Log,
    found: LogDiagnosis,
    model: Model,
    check: Option<Check>,
}

/// The diagnosis as it is written.
#[derive(Serialize)]
pub struct Told<'a> {
    #[serde(flatten)]
    diagnosis: &'a LogDiagnosis,
    #[serde(skip_serializing_if = "Option::is_none")]
    check: Option<&'a Check>,
    /// The robot file with what was found: the whole is a robot to every command. Of currents there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    corrected: Option<String>,
}

fn plain(error: Refused) -> Failure {
    Failure::new(error.to_string())
}

impl Motion {
    /// Reads and diagnoses a log.
    ///
    /// # Errors
    /// [`Failure`]: the log or the options.
    pub(in super::super) fn new(
        args: &Args,
        source: Source,
        parts: Vec<Part>,
        quiet: bool,
    ) -> Result<Motion, Failure> {
        if let Some(option) = args.of_measurements() {
            return Err(Failure::new(format!(
                "{option} is for measurement files, and {} is a joint log",
                args.data[0].display()
            )));
        }
        let arm = source.arm()?;
        let names = args.log.names(&source)?;
        let motions: Vec<_> = arm.joints.iter().map(|joint| joint.motion).collect();
        let log = files::read(parts, &motions, &names)?;
        let other = args.check.as_ref();
        let other = other.map(|path| files::other(path, &motions, &names)).transpose()?;
        // What stands nearer to the torques comes first.
        let side = args.log.torque_side.or(log.side);
        let options = LogOptions {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            side: side.or_else(|| TorqueSide::named(source.robot.torque_side?)),
            rows: args.log.rows.map(|rows| match rows {
                Rows::Torque => Domain::Torque,
                Rows::Position => Domain::Position,
            }),
            band: args.log.band,
            standstill: args.log.standstill,
            effects: args.effects.clone(),
            known: source.motion.clone(),
            payloads: layout(&source)?.payloads.map_or_else(Vec::new, |known| known.bodies),
            known_links: args.log.known_masses,
            nested: args.nested,
            seed: args.seed,
        };
        let (found, model) = diagnosed(&arm, &log, &options).map_err(plain)?;
        found.remarks.iter().for_each(|remark| note(remark, quiet));
        let check = other.map(|other| Check::of(&arm, &found, &model, &other)).transpose();
        Ok(Motion { check: check.map_err(plain)?, source, arm, log, found, model })
    }

    /// The diagnosis in JSON.
    ///
    /// # Errors
    /// [`Failure`] if it cannot be written so.
    pub fn json(&self) -> Result<String, Failure> {
        json::text(&self.told())
    }

    pub(in super::super) fn told(&self) -> Told<'_> {
        Told {
            diagnosis: &self.found,
            check: self.check.as_ref(),
            corrected: self.corrected().ok(),
        }
    }

    /// The name of the robot.
    pub(in super::super) fn robot(&self) -> &str {
        &self.found.robot
    }

    /// The files of the log.
    pub(in super::super) fn files(&self) -> String {
        self.found.files.join(", ")
    }

    /// The diagnosis as it stands on a screen.
    pub fn text(&self) -> String {
        screen::text(&self.found, self.check.as_ref())
    }

    /// The page in HTML.
    ///
    /// # Errors
    /// [`Failure`] if it cannot be made.
    pub fn page(&self) -> Result<String, Failure> {
        let page = Logged {
            found: &self.found,
            explained: &self.model.explain(&self.arm, &self.log).map_err(plain)?,
            arm: &self.arm,
            check: self.check.as_ref().map(|check| screen::checked(&self.found, check)),
        };
        page.html().map_err(|e| Failure::new(format!("cannot make the report: {e}")))
    }

    /// The robot file with all that was found.
    ///
    /// # Errors
    /// [`Failure`]: a log of currents, which tell no newton-metres.
    pub fn corrected(&self) -> Result<String, Failure> {
        let written = self.written()?;
        let head = vec![made_from(&self.source, &self.found.files.join(", ")), String::new()];
        Ok(file([head, written.lines].concat(), &written.robot))
    }

    /// The corrected arm as other programs read it, and a sentence on what they have no place for.
    ///
    /// # Errors
    /// [`Failure`]: the log is one of currents, or the table has cells that are no numbers.
    pub fn exported(&self, format: Format) -> Result<(String, Option<String>), Failure> {
        exported(&self.written()?.robot, format)
    }

    fn written(&self) -> Result<Written, Failure> {
        let mut robot = self.source.robot.clone();
        robot.effects.extend(self.source.motion.iter().cloned());
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
        let units: Vec<&'static str> = self.found.gap.iter().map(|gap| gap.unit).collect();
        let explained = model.explain(&self.arm, &self.log).map_err(plain)?;
        let [_, left] = screen::left(&explained.gap(model.rows, &units));
        Ok((model, left))
    }
}
