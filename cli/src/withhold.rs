//! `stiffarm withhold`: what an experiment can find, before anyone runs it.

mod document;
mod motion;

use std::path::PathBuf;

use stiffarm_document::text::counted;
use stiffarm_document::{Embedded, TOP};
use stiffarm_gap::Options;
use stiffarm_gap::whole::Whole;
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::{Frames, effects};
use stiffarm_study::withhold::{Campaign, Experiment, Plan, Report, with_findings, withhold};

use super::Verdict;
use super::simulate::ExperimentArgs;
use crate::host::Host;
use crate::input::named;
use crate::input::source::RobotArgs;
use crate::motion::{MotionArgs, RecordArgs};
use crate::terminal::failure::Failure;
use crate::terminal::json;
use crate::terminal::output::Target;
use crate::terminal::progress::Progress;

const EXAMPLES: &str = "\
Examples:
  stiffarm withhold ur5 --cases 40 --report check.html
  stiffarm withhold arm.toml run1.csv --noise-position 30um --json check.json
  stiffarm withhold arm.toml --design force --payload 500N --effects backlash,joint_compliance
  stiffarm withhold panda --motion --cases 40 --period 30s --noise-torque 3%
  stiffarm withhold arm.toml commands.csv --motion --logged position --effects latency,backlash

Effects are put into a simulated arm one at a time, in pairs and not at all, and also with the effect
removed from the diagnosis' dictionary; the diagnosis is not told. Each is scaled so that its error is a
multiple of the noise.";

/// What an experiment can find, before anyone runs it
///
/// With DATA, the poses and loads are those of that file; without, of a random design. With --motion the
/// arm is moved and its joint log diagnosed: along the commands of DATA, or along random motions.
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
    /// As many cases as distinguish 95 % from 98 %: 500
    #[arg(long)]
    full: bool,
    /// Smallest and largest error of an effect, in multiples of the noise [default: 8,20; of a
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

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    let (report, position_log) =
        if args.motion { motion::report(args, host)? } else { (report(args, host)?, false) };
    let document = document::document(&report, position_log);
    host.put(&args.json, || json::text(&report))?;
    host.put(&args.report, || Ok(document.html(&Embedded::new((), &report, "")?)?))?;
    if !args.is_enough(host) {
        host.print(&document.text(TOP))?;
    }
    Ok(Verdict::Good)
}

/// Of a campaign.
fn report(args: &Args, host: &Host) -> Result<Report, Failure> {
    let effects = match &args.effects {
        Some(names) => {
            let known: Vec<_> = effects().into_iter().map(|e| (e.identifier(), e)).collect();
            named::effects(&known, names, "--effects: ")?
        }
        None => effects(),
    };
    let multiple = args.multiple([8.0, 20.0])?;
    let source = args.robot.load(host)?;
    let (arm, design) =
        args.experiment.rows(args.data.as_ref(), &source, source.arm_at_its_base()?, host)?;
    let fresh = match args.data {
        Some(_) => Vec::new(),
        None => args.experiment.other_sessions(&source, &arm, host)?,
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
        noise: args.experiment.noise(&design)?,
        // Where a camera stands, and where its board sits, nobody knows.
        frames: design.by_camera.then(Frames::default),
        effects: &effects,
        options: &options,
    };
    args.tried(&arm, Experiment::Campaign(campaign), multiple, host)
}

impl Args {
    /// Tries all cases.
    fn tried(
        &self,
        arm: &Arm,
        experiment: Experiment<'_>,
        multiple: [f64; 2],
        host: &Host,
    ) -> Result<Report, Failure> {
        let what = match &experiment {
            Experiment::Campaign(_) => "withheld cases",
            Experiment::Log(_) => "withheld logs",
        };
        let cases = if self.full { FULL } else { self.cases };
        let seed = self.experiment.seed;
        let plan = Plan { arm, experiment, cases, multiple, seed, threads: THREADS };
        let progress = Progress::new(what, cases, host);
        Ok(withhold(&plan, &|_, _| progress.add(1))?)
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
    fn is_enough(&self, host: &Host) -> bool {
        let piped = [&self.json, &self.report].contains(&&Some(Target::Stdout));
        piped || host.is_quiet() && self.json.is_some()
    }
}
