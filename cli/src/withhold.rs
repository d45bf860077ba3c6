//! `stiffarm withhold`: what an experiment can find, before anyone runs it.

mod motion;

use std::path::PathBuf;

use stiffarm_gap::Options;
use stiffarm_gap::plant;
use stiffarm_gap::study::withhold::{
    Campaign, Confusion, Experiment, Facts, Plan, Rate, Report, with_findings, withhold,
};
use stiffarm_gap::whole::Whole;
use stiffarm_kernels::generic::Arm;

use super::Verdict;
use super::simulate::{ExperimentArgs, plain};
use crate::input::named;
use crate::input::quantity::counted;
use crate::input::source::RobotArgs;
use crate::motion::{MotionArgs, RecordArgs};
use crate::terminal::failure::Failure;
use crate::terminal::json;
use crate::terminal::output::{Target, print};
use crate::terminal::progress::Progress;
use crate::terminal::text::{Align, bold, dim, indented, short, table};

const EXAMPLES: &str = "\
Examples:
  stiffarm withhold ur5 --cases 40 --report check.html
  stiffarm withhold arm.toml run1.csv --noise-position 30um --json check.json
  stiffarm withhold arm.toml --design force --payload 500N --effects backlash,joint_compliance
  stiffarm withhold panda --motion --cases 40 --period 30s --noise-torque 3%
  stiffarm withhold arm.toml commands.csv --motion --logged position --effects latency,backlash

Effects are put into a plant one at a time, in pairs and not at all, and also with the effect taken
out of what the diagnosis knows; the diagnosis is not told. Each is sized so that its gap is so many
times the noise.";

/// What an experiment can find, before anyone runs it
///
/// With DATA, the poses and loads of that file; without, a drawn design. With --motion the arm is moved
/// and its joint log diagnosed: along the commands of DATA, or along motions that are drawn.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    robot: RobotArgs,
    /// Take poses, loads, order and measured components of this measurement file
    data: Option<PathBuf>,
    /// Put in only these effects [default: all]
    #[arg(long, value_name = "a,b,c", value_delimiter = ',')]
    effects: Option<Vec<String>>,
    /// Number of cases
    #[arg(long, value_name = "N", default_value_t = 100, conflicts_with = "full")]
    cases: usize,
    /// As many cases as it takes to tell 95 % from 98 %: 500
    #[arg(long)]
    full: bool,
    /// Smallest and largest size of an effect's gap, in multiples of the noise [default: 8,20; of a
    /// motion 1,3]
    #[arg(long, value_name = "FROM,TO", value_delimiter = ',')]
    sizes: Vec<f64>,
    #[command(flatten)]
    experiment: ExperimentArgs,
    /// Of joint logs: move the arm
    #[arg(
        long,
        group = "moved",
        conflicts_with_all = ["design", "poses", "payload", "repeats", "measure",
                              "noise_position", "noise_rotation"]
    )]
    motion: bool,
    #[command(flatten)]
    moved: MotionArgs,
    #[command(flatten)]
    record: RecordArgs,
    /// Write everything as JSON (`-`: to standard output, in place of the screen)
    #[arg(long, value_name = "OUT")]
    json: Option<Target>,
    /// Write a self-contained page
    #[arg(long, value_name = "OUT.html")]
    report: Option<Target>,
}

/// Cases of the full form.
const FULL: usize = 500;

/// Cases that are worked on at once.
const THREADS: usize = 2;

/// Confusions that are shown.
const MOST: usize = 6;

/// Runs the command.
///
/// # Errors
/// [`Failure`]: the robot, the data, the options, a load that the arm cannot carry, or an output
/// that cannot be written.
pub fn run(args: &Args, quiet: bool) -> Result<Verdict, Failure> {
    let (report, position_log) =
        if args.motion { motion::report(args, quiet)? } else { (report(args, quiet)?, false) };
    if let Some(target) = &args.json {
        target.write(&json::text(&report)?)?;
    }
    if let Some(target) = &args.report {
        let page = crate::report::withheld::html(&report);
        target.write(&page.map_err(|error| Failure::new(error.to_string()))?)?;
    }
    if !args.is_enough(quiet) {
        print(&screen(&report, position_log))?;
    }
    Ok(Verdict::Good)
}

/// Of a campaign.
fn report(args: &Args, quiet: bool) -> Result<Report, Failure> {
    let effects = match &args.effects {
        Some(names) => {
            let known: Vec<_> = plant::effects().into_iter().map(|e| (e.identifier(), e)).collect();
            named::effects(&known, names, "--effects: ")?
        }
        None => plant::effects(),
    };
    let multiple = args.multiple([8.0, 20.0])?;
    let source = args.robot.load(quiet)?;
    let arm = source.arm_at_its_base()?;
    let design = args.experiment.rows(args.data.as_ref(), &source, &arm, quiet)?;
    let fresh = match args.data {
        Some(_) => Vec::new(),
        None => args.experiment.other_sessions(&arm)?,
    };
    let options = Options {
        known: source.known.clone(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        ..Options::default()
    };
    let predict = with_findings(Whole { arm: &arm, known: &options.known }, &options.catalogue);
    let campaign = Campaign {
        design: &design,
        fresh: &fresh,
        predict: Some(&predict),
        noise: args.experiment.noise()?,
        frames: None,
        effects: &effects,
        options: &options,
    };
    args.tried(&arm, Experiment::Campaign(campaign), multiple, quiet)
}

impl Args {
    /// Tries all cases.
    fn tried(
        &self,
        arm: &Arm,
        experiment: Experiment<'_>,
        multiple: [f64; 2],
        quiet: bool,
    ) -> Result<Report, Failure> {
        let what = match &experiment {
            Experiment::Campaign(_) => "withheld cases",
            Experiment::Log(_) => "withheld logs",
        };
        let cases = if self.full { FULL } else { self.cases };
        let seed = self.experiment.seed;
        let plan = Plan { arm, experiment, cases, multiple, seed, threads: THREADS };
        let progress = Progress::new(what, cases, quiet);
        withhold(&plan, &|_, _| progress.add(1)).map_err(plain)
    }

    /// The sizes that are asked for, else the usual ones.
    fn multiple(&self, usual: [f64; 2]) -> Result<[f64; 2], Failure> {
        match self.sizes[..] {
            [] => Ok(usual),
            [from, to] => Ok([from, to]),
            _ => {
                let found = counted(self.sizes.len(), "value");
                Err(Failure::new(format!("--sizes: found {found}, expected two: 8,20")))
            }
        }
    }

    /// Whether the screen is not wanted beside what is written.
    fn is_enough(&self, quiet: bool) -> bool {
        let piped = [&self.json, &self.report].contains(&&Some(Target::Stdout));
        piped || quiet && self.json.is_some()
    }
}

fn screen(report: &Report, position_log: bool) -> String {
    let facts = format!(
        "{}; {}, sizes {} to {} × noise",
        facts(&report.experiment, position_log),
        counted(report.cases.len(), "case"),
        short(report.multiple[0]),
        short(report.multiple[1]),
    );
    let mut text = format!("{}\n{}\n\n{}\n", bold(&report.robot), dim(facts), bold("Found"));
    text.push_str(&indented(&rates(report), 2));
    text.push_str(&confusions(report));
    if !report.cannot_plant.is_empty() {
        let names = report.cannot_plant.join(", ");
        text.push_str(&format!("\n{}  {names}\n", bold("Does not show here")));
    }
    if report.failed > 0 {
        let failed = counted(report.failed, "diagnosis without result");
        let error = report.cases.iter().find_map(|case| case.error.as_deref());
        let error = error.unwrap_or_default();
        text.push_str(&format!("\n{}  {failed}, the first: {error}\n", bold("Failed")));
    }
    text
}

/// What is measured, and how well.
fn facts(facts: &Facts, position_log: bool) -> String {
    match facts {
        Facts::Campaign { design, measurements, poses, noise_position, noise_rotation } => format!(
            "{design}: {} at {}, noise {} µm and {} mrad",
            counted(*measurements, "measurement"),
            counted(*poses, "pose"),
            short(1e6 * noise_position),
            short(1e3 * noise_rotation),
        ),
        Facts::Log { duration, runs, rate, noise_torque, noise_reading } => {
            let noise = if position_log {
                format!("{} of a reading", short(*noise_reading))
            } else {
                format!("{} % of the torques' spread", short(100.0 * noise_torque))
            };
            format!(
                "{} of {} s at {} Hz, noise {noise}",
                counted(*runs, "run"),
                short(duration / *runs as f64),
                short(*rate),
            )
        }
    }
}

/// A line for each rate that there is.
fn rates_of(all: &[(&str, Rate, String)]) -> String {
    let line = |(what, rate, remark): &(&str, Rate, String)| {
        let percent = |x: f64| format!("{:.0}", 100.0 * x);
        let (value, [low, high]) = rate.rate.zip(rate.ci95)?;
        Some(vec![
            (*what).to_owned(),
            format!("{} %", percent(value)),
            format!("[{} to {}]", percent(low), percent(high)),
            format!("{} of {}", rate.hits, rate.of),
            remark.clone(),
        ])
    };
    let rows: Vec<Vec<String>> = all.iter().filter_map(line).collect();
    use Align::{Left, Right};
    table(&rows, &[Left, Right, Left, Left, Left])
}

fn rates(report: &Report) -> String {
    let mut rows = Vec::new();
    let mut add = |what, rate, remark| rows.push((what, rate, remark));
    let none = String::new;
    add("an effect where there is none", report.false_alarms, none());
    add("something unexplained where there is none", report.false_unexplained, none());
    add("the effect and its place, named first", report.single.first_named, none());
    let size = report.single.mean_set_size;
    let size = size.map_or_else(none, |s| format!("mean set size {}", short(s)));
    add("  or not to be told from what is", report.single.in_set, size);
    if let Facts::Log { .. } = report.experiment {
        add("more than the effect", report.single.more_than_one, none());
    }
    add("both of two", report.pairs.both_in_sets, none());
    add("that an unknown effect is unexplained", report.removed.flagged, none());
    let open = report.removed.flagged_of_open;
    add("  where the known ones leave a gap", open, none());
    add("  and at which joint", report.removed.right_joint, none());
    let median = report.after.median.map_or_else(none, |m| format!("median {}", short(m)));
    add("gap left at most 1.2 × noise", report.after.within_1_2_of_noise, median);
    if let Some(shrink) = &report.shrink {
        add("shrink at new poses as predicted", shrink.inside, none());
    }
    rates_of(&rows)
}

fn confusions(report: &Report) -> String {
    let wrong = |c: &&Confusion| c.named.as_ref() != Some(&c.truth) || !c.at_its_place;
    let row = |c: &Confusion| {
        let named = match &c.named {
            None => "nothing".to_owned(),
            Some(named) if *named == c.truth => format!("{named}, at another place"),
            Some(named) => named.clone(),
        };
        vec![c.truth.clone(), format!("→ {named}"), counted(c.cases, "case")]
    };
    let all: Vec<_> = report.confusion.iter().filter(wrong).collect();
    if all.is_empty() {
        return String::new();
    }
    let rows: Vec<_> = all.iter().take(MOST).map(|c| row(c)).collect();
    let rest: usize = all.iter().skip(MOST).map(|c| c.cases).sum();
    let rest = match rest {
        0 => String::new(),
        n => format!("  and {} more\n", counted(n, "case")),
    };
    let lines = indented(&table(&rows, &[]), 2);
    format!("\n{}\n{lines}{rest}", bold("Taken for another"))
}
