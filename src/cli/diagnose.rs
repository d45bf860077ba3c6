//! `stiffarm diagnose`: the gap between model and measurement, and what closes it.

use std::path::PathBuf;

use stiffarm_gap::measurement::{Dimension, Mistake};
use stiffarm_gap::{Diagnosis, Measurements, Options, ReadError, diagnose};

use super::failure::{Failure, Remark};
use super::output::{Target, print};
use super::quantity;
use super::screen::Screen;
use super::source::RobotArgs;
use super::{Verdict, json, snippet};

const EXAMPLES: &str = "\
Examples:
  stiffarm diagnose arm.toml run1.csv
  stiffarm diagnose arm.toml run1.csv --noise-position 30um --json run1.json
  stiffarm diagnose lin_planar robots/data/lin1991_table3.csv --rival ycd --rival ytd

DATA has a header row of columns `name` or `name[unit]`: readings q1 … qn; the wrench fx fy fz mx my
mz; what was measured, x y z [rx ry rz] or dx dy dz [drx dry drz]; and optionally pose, marker,
s1 … sn, temperature, time, and your own simulator's sim_x … or sim_dx ….";

/// Why the real arm is not where the model says
///
/// The gap between robot file and measurements, before and after the best explanation, judged on
/// poses that no fit has seen.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    robot: RobotArgs,
    /// The measurement file (CSV)
    data: PathBuf,
    /// Compare with another model's predictions: the columns PREFIX_x … or PREFIX_dx …
    #[arg(long = "rival", value_name = "PREFIX")]
    rivals: Vec<String>,
    /// Write the diagnosis as JSON (`-`: to standard output, in place of the screen)
    #[arg(long, value_name = "OUT")]
    json: Option<Target>,
    /// Standard deviation of a measured coordinate: 30um [default: from repeats, else estimated]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    noise_position: Option<String>,
    /// Standard deviation of a measured rotation: 0.02deg [default: from repeats, else estimated]
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    noise_rotation: Option<String>,
    /// Number of folds [default: one per pose up to 30 poses, else 10]
    #[arg(long, value_name = "K")]
    folds: Option<usize>,
    /// Seed of folds, permutations and intervals; the same seed gives the same bytes
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Try only these effects
    #[arg(long, value_name = "a,b,c", value_delimiter = ',')]
    effects: Option<Vec<String>>,
    /// Frames known to be unknown: base_frame, tool_frame (not in this version)
    #[arg(long, value_name = "a,b", value_delimiter = ',')]
    nuisance: Option<Vec<String>>,
    /// Write a report (not in this version)
    #[arg(long, value_name = "OUT.html")]
    report: Option<PathBuf>,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`]: the robot, the data, the options, or an output that cannot be written.
pub fn run(args: &Args, quiet: bool) -> Result<Verdict, Failure> {
    args.refuse_what_is_to_come()?;
    let options = args.options()?;
    let source = args.robot.load(quiet)?;
    let arm = source.arm()?;
    let data = read(&args.data, &source)?;
    let found: Diagnosis =
        diagnose(&arm, &data, &options).map_err(|error| Failure::new(error.to_string()))?;
    if let Some(target) = &args.json {
        target.write(&json::text(&found)?)?;
    }
    if args.json != Some(Target::Stdout) && !(quiet && args.json.is_some()) {
        let screen = Screen { found: &found, data: &data, arm: &arm, rivals: &args.rivals };
        print(&screen.text())?;
    }
    Ok(Verdict::Good)
}

impl Args {
    fn refuse_what_is_to_come(&self) -> Result<(), Failure> {
        let refused = |option: &str, what: &str| {
            Err(Failure::new(format!("{option} is not in this version: {what}")))
        };
        if self.nuisance.is_some() {
            return refused(
                "--nuisance",
                "base and tool frame are taken as the robot file has them",
            );
        }
        if self.report.is_some() {
            return refused("--report", "--json writes everything that a report would show");
        }
        Ok(())
    }

    fn options(&self) -> Result<Options, Failure> {
        let noise = |option, text: &Option<String>, dimension| {
            text.as_ref().map(|t| quantity::with_unit(option, t, dimension)).transpose()
        };
        Ok(Options {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            folds: self.folds,
            seed: self.seed,
            noise_position: noise("--noise-position", &self.noise_position, Dimension::Length)?,
            noise_rotation: noise("--noise-rotation", &self.noise_rotation, Dimension::Angle)?,
            effects: self.effects.clone(),
            rivals: self.rivals.clone(),
        })
    }
}

/// Reads the data; each mistake is shown at its cell.
fn read(path: &PathBuf, source: &super::source::Source) -> Result<Measurements, Failure> {
    let layout = stiffarm_gap::robot::layout(&source.robot);
    let layout = layout.map_err(|error| Failure::new(error.to_string()))?;
    let bytes = std::fs::read(path).map_err(|error| Failure::io("read", path, &error))?;
    let file = path.display().to_string();
    Measurements::from_bytes(&file, &bytes, &layout).map_err(|error| match &error {
        ReadError::Open { .. } => Failure::new(error.to_string()),
        ReadError::Mistakes { mistakes, more, .. } => {
            let text = String::from_utf8(bytes.clone()).unwrap_or_default();
            let mut remarks: Vec<Remark> =
                mistakes.iter().map(|mistake| remark(mistake, &file, &text)).collect();
            if *more > 0 {
                let rest = format!("and {more} more mistakes");
                remarks.push(Remark::error(rest, None, &file, "", None));
            }
            Failure::File(remarks)
        }
    })
}

fn remark(mistake: &Mistake, file: &str, text: &str) -> Remark {
    let column = mistake.column.as_ref().map(|column| column.number);
    let span = snippet::cell(text, mistake.line, column);
    Remark::error(mistake.to_string(), None, file, text, span)
}
