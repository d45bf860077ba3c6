//! The withheld check of joint logs.

use stiffarm_gap::effects::IN_MOTION;
use stiffarm_gap::log::LogOptions;
use stiffarm_gap::plant::motion::{LAWS, Law, Logged};
use stiffarm_gap::withhold::logs::{LogPlan, LogReport, withhold};

use super::{Args, FULL, THREADS, rates_of, rest};
use crate::Verdict;
use crate::input::quantity::counted;
use crate::motion::{self, Courses};
use crate::simulate::plain;
use crate::terminal::failure::Failure;
use crate::terminal::json;
use crate::terminal::output::print;
use crate::terminal::progress::Progress;
use crate::terminal::text::{bold, dim, indented, short};

/// Moves the arm many times, with an effect or without.
///
/// # Errors
/// [`Failure`]: the robot, the commands, the options, or an output that cannot be written.
pub(super) fn run(args: &Args, quiet: bool) -> Result<Verdict, Failure> {
    if args.report.is_some() {
        let what =
            "--report: found --motion, expected measurements at rest: withheld logs have no page";
        return Err(Failure::with_help(what, "--json has every case, and the screen the rates"));
    }
    let source = args.robot.load(quiet)?;
    let arm = motion::arm(&source, "withhold --motion")?;
    let (logged, seed) = (args.record.logged(), args.experiment.seed);
    let how = (&args.moved, &args.record);
    let courses = Courses::of(args.data.as_ref(), &source, &arm, how, seed)?;
    let cases = if args.full { FULL } else { args.cases };
    let plan = LogPlan {
        arm: &arm,
        stages: &courses.stages(),
        logged,
        recording: args.record.recording()?,
        effects: &effects(args.effects.as_deref(), logged)?,
        cases,
        multiple: args.multiple([1.0, 3.0])?,
        seed,
        options: &LogOptions {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            known: source.motion.clone(),
            ..LogOptions::default()
        },
        threads: THREADS,
    };
    let progress = Progress::new("withheld logs", cases, quiet);
    let report = withhold(&plan, &|_, _| progress.add(1)).map_err(plain)?;
    drop(progress);
    if let Some(target) = &args.json {
        target.write(&json::text(&report)?)?;
    }
    if !args.is_enough(quiet) {
        print(&screen(&report, logged))?;
    }
    Ok(Verdict::Good)
}

/// What is put in: those of such a log that the diagnosis knows, or those that are named.
fn effects(names: Option<&[String]>, logged: Logged) -> Result<Vec<&'static Law>, Failure> {
    let is_known = |law: &&Law| IN_MOTION.iter().any(|effect| effect.identifier() == law.name);
    let known: Vec<&'static Law> =
        LAWS.iter().filter(|law| law.rows.contains(&logged.rows())).filter(is_known).collect();
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

fn screen(report: &LogReport, logged: Logged) -> String {
    let noise = match logged {
        Logged::Torque(_) => {
            format!("{} % of the torques' spread", short(100.0 * report.noise_torque))
        }
        Logged::Position => format!("{} of a reading", short(report.noise_reading)),
    };
    let facts = format!(
        "{} of {} s at {} Hz, noise {noise}; {}, sizes {} to {} × noise",
        counted(report.runs, "run"),
        short(report.duration / report.runs as f64),
        short(report.rate),
        counted(report.cases.len(), "case"),
        short(report.multiple[0]),
        short(report.multiple[1]),
    );
    let size = report.single.mean_set_size;
    let size = size.map_or_else(String::new, |s| format!("mean set size {}", short(s)));
    let none = String::new;
    let rates = rates_of(&[
        ("an effect where there is none", report.false_alarms, none()),
        ("something unexplained where there is none", report.false_unexplained, none()),
        ("the effect and its place, named first", report.single.first_named, none()),
        ("  or not to be told from what is", report.single.in_set, size),
        ("more than the effect", report.single.more_than_one, none()),
        ("that an unknown effect is unexplained", report.removed_flagged, none()),
    ]);
    let mut text = format!("{}\n{}\n\n{}\n", bold(&report.robot), dim(facts), bold("Found"));
    text.push_str(&indented(&rates, 2));
    let error = report.cases.iter().find_map(|case| case.error.as_deref());
    text + &rest(&report.confusion, &report.cannot_plant, report.failed, error)
}
