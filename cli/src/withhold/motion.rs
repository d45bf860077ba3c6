//! The withheld check of joint logs.

use stiffarm_gap::log::LogOptions;
use stiffarm_plant::motion::{LAWS, Law, Logged};
use stiffarm_study::withhold::{Experiment, Motion, Report};

use super::Args;
use crate::host::Host;
use crate::motion::{self, Courses};
use crate::terminal::failure::Failure;

/// Moves the arm many times, with an effect or without; and whether positions are logged.
pub(super) fn report(args: &Args, host: &Host) -> Result<(Report, bool), Failure> {
    let source = args.robot.load(host)?;
    let arm = motion::arm(&source, "withhold --motion")?;
    let (logged, seed) = (args.record.logged(), args.experiment.seed);
    let how = (&args.moved, &args.record);
    let courses = Courses::of((args.data.as_ref(), host), &source, &arm, how, seed)?;
    let experiment = Experiment::Log(Motion {
        stages: &courses.stages(),
        logged,
        recording: args.record.recording()?,
        effects: &effects(args.effects.as_deref(), logged)?,
        options: &LogOptions {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            known: source.motion.clone(),
            ..LogOptions::default()
        },
    });
    let report = args.tried(&arm, experiment, args.multiple([1.0, 3.0])?, host)?;
    Ok((report, logged == Logged::Position))
}

/// What is put in: those of such a log, or those that are named.
fn effects(names: Option<&[String]>, logged: Logged) -> Result<Vec<&'static Law>, Failure> {
    let known: Vec<&'static Law> =
        LAWS.iter().filter(|law| law.rows.contains(&logged.rows())).collect();
    let Some(names) = names else { return Ok(known) };
    let named = |name: &String| {
        known.iter().find(|law| law.name == name).copied().ok_or_else(|| {
            let all: Vec<&str> = known.iter().map(|law| law.name).collect();
            let all = all.join(", ");
            Failure::new(format!("--effects: found `{name}`, expected one of {all}"))
        })
    };
    names.iter().map(named).collect()
}
