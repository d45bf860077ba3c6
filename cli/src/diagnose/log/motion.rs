//! A log that was diagnosed, and everything that is made of it.

use serde::Serialize;
use stiffarm_gap::log::{
    Domain, Log, LogDiagnosis, LogOptions, Model, Refused, TorqueSide, diagnosed,
};
use stiffarm_kernels::generic::Arm;

use super::super::{Args, Format};
use super::files::{self, Part};
use super::written::Written;
use super::{Check, Rows};
use crate::Verdict;
use crate::input::data::layout;
use crate::input::source::Source;
use crate::report::logged::Logged;
use crate::screen::log as screen;
use crate::terminal::failure::Failure;
use crate::terminal::json;
use crate::terminal::note::note;
use crate::terminal::output::{Target, print};

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
struct Told<'a> {
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
        json::text(&Told {
            diagnosis: &self.found,
            check: self.check.as_ref(),
            corrected: self.corrected(),
        })
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

    /// The robot file with all that was found; `None` of currents, which tell no newton-metres.
    pub fn corrected(&self) -> Option<String> {
        self.written().ok().map(|written| written.text)
    }

    /// The corrected arm as other programs read it, and a sentence on what they have no place for.
    ///
    /// # Errors
    /// [`Failure`]: the log is one of currents, or the table has cells that are no numbers.
    pub fn exported(&self, format: Format) -> Result<(String, Option<String>), Failure> {
        self.written()?.exported(format)
    }

    fn written(&self) -> Result<Written, Failure> {
        Written::of(&self.source, &self.arm, &self.log, &self.found, &self.model)
    }

    /// Writes what was found.
    ///
    /// # Errors
    /// [`Failure`]: an output that cannot be written.
    pub(in super::super) fn write(&self, args: &Args, quiet: bool) -> Result<Verdict, Failure> {
        if let Some(target) = &args.json {
            target.write(&self.json()?)?;
        }
        if args.arms().iter().any(|target| target.is_some()) {
            self.written()?.write(args, quiet)?;
        }
        if let Some(target) = &args.report {
            target.write(&self.page()?)?;
        }
        let written: Vec<&Target> =
            [&args.json, &args.report].into_iter().chain(args.arms()).flatten().collect();
        let enough = quiet && !written.is_empty();
        if !enough && !written.contains(&&Target::Stdout) {
            print(&self.text())?;
        }
        Ok(Verdict::Good)
    }
}
