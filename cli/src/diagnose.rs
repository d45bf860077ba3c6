//! `stiffarm diagnose`: the gap between model and measurement, and what closes it.

mod accepted;
mod check;
mod compared;
mod corrected;
mod provenance;

use std::path::PathBuf;

use serde::Serialize;
use stiffarm_gap::diagnose::{Stage, Stop};
use stiffarm_gap::measurement::Dimension;
use stiffarm_gap::{DiagnoseError, Diagnosis, Options, diagnose_with};

pub use accepted::Accepted;
pub use check::Check;
pub use compared::{Compared, Reached};
use corrected::{Corrections, Format};
pub use provenance::{Hashes, Provenance};

use super::Verdict;
use super::screen::Screen;
use crate::input::data;
use crate::input::quantity::{self, counted};
use crate::input::source::{RobotArgs, Source};
use crate::report::Report;
use crate::terminal::failure::Failure;
use crate::terminal::interrupt;
use crate::terminal::json;
use crate::terminal::note::note;
use crate::terminal::output::{Target, print};
use crate::terminal::progress::Stages;

const EXAMPLES: &str = "\
Examples:
  stiffarm diagnose arm.toml run1.csv
  stiffarm diagnose arm.toml run1.csv --nuisance base_frame,tool_frame --noise-position 30um
  stiffarm diagnose arm.toml run1.csv --write-robot better.toml --check run2.csv --json run1.json
  stiffarm diagnose lin_planar robots/data/lin1991_table3.csv --rival ycd --rival ytd

DATA has a header row of columns `name` or `name[unit]`: readings q1 … qn; the wrench fx fy fz mx my
mz; what was measured, x y z [rx ry rz] or dx dy dz [drx dry drz]; and optionally pose, marker,
s1 … sn, temperature, time, and your own simulator's sim_x … or sim_dx ….";

/// Why the real arm is not where the model says
///
/// The gap between robot file and measurements, which unmodelled effects cause it and how far it
/// shrinks with them, judged on poses that no fit has seen.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    robot: RobotArgs,
    /// The measurement file (CSV)
    data: PathBuf,
    /// What is known to be unknown, fitted along and never a finding: base_frame, tool_frame,
    /// geometry (zeros, lengths and twists, within --tolerance)
    #[arg(long, value_name = "a,b", value_delimiter = ',')]
    nuisance: Vec<String>,
    /// How well the maker holds lengths and angles, standard deviations [default: 0.3mm,0.5mrad]
    #[arg(long, value_name = "LENGTH,ANGLE", allow_hyphen_values = true)]
    tolerance: Option<String>,
    /// Standard deviation of a measured coordinate: 30um [default: from repeats, else estimated]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    noise_position: Option<String>,
    /// Standard deviation of a measured rotation: 0.02deg [default: from repeats, else estimated]
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    noise_rotation: Option<String>,
    /// Fit and count rows that do not fit all the same
    #[arg(long)]
    keep_all: bool,
    /// Try only these effects
    #[arg(long, value_name = "a,b,c", value_delimiter = ',')]
    effects: Option<Vec<String>>,
    /// Number of folds [default: one per pose up to 30 poses, else 10]
    #[arg(long, value_name = "K")]
    folds: Option<usize>,
    /// Run the search again for each fold on the others, and tell the gap that it leaves there
    #[arg(long)]
    nested: bool,
    /// Seed of folds, permutations and intervals; the same seed gives the same bytes
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Compare with another model's predictions: the columns PREFIX_x … or PREFIX_dx …
    #[arg(long = "rival", value_name = "PREFIX")]
    rivals: Vec<String>,
    /// Predict another measurement file of the same arm with what was found
    #[arg(long, value_name = "OTHER.csv")]
    check: Option<PathBuf>,
    /// Compare with an earlier diagnosis of the arm (JSON): what came, what went, what changed
    #[arg(long, value_name = "LAST.json")]
    compare: Option<PathBuf>,
    /// The position error that is accepted of the corrected arm in 95 % of the rows, held out or of
    /// --check; exit status 1 if it is larger
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    accept: Option<String>,
    /// Write the robot file with what was found put into it
    #[arg(long, value_name = "OUT.toml")]
    write_robot: Option<Target>,
    /// Write the arm with what was found as a URDF, as far as one can hold it; what is lost is said
    #[arg(long, value_name = "OUT.urdf")]
    write_urdf: Option<Target>,
    /// The same as an MJCF model for MuJoCo, with the joints' springs
    #[arg(long, value_name = "OUT.xml")]
    write_mjcf: Option<Target>,
    /// Write the diagnosis as JSON (`-`: to standard output, in place of the screen)
    #[arg(long, value_name = "OUT")]
    json: Option<Target>,
    /// Write the diagnosis as one self-contained page
    #[arg(long, value_name = "OUT.html")]
    report: Option<Target>,
}

/// The diagnosis as it is written.
#[derive(Serialize)]
struct Written<'a> {
    #[serde(flatten)]
    diagnosis: &'a Diagnosis,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    doubts: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    check: Option<&'a Check>,
    #[serde(skip_serializing_if = "Option::is_none")]
    accept: Option<&'a Accepted>,
    #[serde(skip_serializing_if = "Option::is_none")]
    compared: Option<&'a Compared>,
    #[serde(flatten)]
    hashes: &'a Hashes,
    /// The robot file with what was found: the whole is a robot to every command.
    corrected: String,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`]: the robot, the data, the options, or an output that cannot be written.
pub fn run(args: &Args, quiet: bool) -> Result<Verdict, Failure> {
    let source = args.robot.load(quiet)?;
    let options = args.options(&source)?;
    let length = |text: &String| quantity::with_unit("--accept", text, Dimension::Length);
    let tolerance = args.accept.as_ref().map(length).transpose()?;
    let arm = source.arm()?;
    let layout = data::layout(&source)?;
    let data = data::read(&args.data, &layout, quiet)?;
    let doubts = data::doubted(&arm, &data, &options.nuisances, quiet);
    let other = args.check.as_ref().map(|path| data::read(path, &layout, quiet)).transpose()?;
    if let Some(other) = &other {
        data::doubted(&arm, other, &options.nuisances, quiet);
    }
    let stages = Stages::new(quiet);
    interrupt::ends(&options.stop);
    let diagnosed = diagnose_with(&arm, &data, &options, &|stage| stages.say(in_words(stage)))
        .map_err(plain)?;
    drop(stages);
    let check = other.map(|other| Check::of(&diagnosed.explanation, &other)).transpose();
    let check = check.map_err(plain)?;
    let found = &diagnosed.diagnosis;
    let made = Provenance::of(&args.data, &source.text)?;
    let compared = args.compare.as_ref().map(|last| Compared::with(last, found, &made.hashes));
    let compared = compared.transpose()?;
    let has_positions = data.kind.components()[..3].contains(&true);
    let judge = |tolerance| Accepted::judge(tolerance, found, check.as_ref(), has_positions);
    let accepted = tolerance.map(judge).transpose()?;
    let corrected = Corrections::new(&source, &data, &diagnosed);
    if let Some(target) = &args.json {
        let written = Written {
            diagnosis: found,
            doubts,
            check: check.as_ref(),
            accept: accepted.as_ref(),
            compared: compared.as_ref(),
            hashes: &made.hashes,
            corrected: corrected.text(),
        };
        target.write(&json::text(&written)?)?;
    }
    args.write_arm(&corrected, quiet)?;
    let screen = Screen {
        found,
        data: &data,
        arm: &arm,
        catalogue: &options.catalogue,
        rivals: &args.rivals,
        check: check.as_ref(),
        accepted: accepted.as_ref(),
        compared: compared.as_ref(),
    };
    if let Some(target) = &args.report {
        let (explanation, words) = (&diagnosed.explanation, screen.words());
        let report = Report {
            found,
            data: &data,
            arm: &arm,
            placed: explanation.arm(),
            gaps: &explanation.predict(&data).map_err(plain)?,
            options: &options,
            words: &words,
            made: &made,
        };
        let page = report.html();
        let page = page.map_err(|e| Failure::new(format!("cannot make the report: {e}")))?;
        target.write(&page)?;
    }
    let written: Vec<_> =
        [&args.json, &args.report].into_iter().chain(args.arms()).flatten().collect();
    let enough = quiet && !written.is_empty();
    if !enough && !written.contains(&&Target::Stdout) {
        print(&screen.text())?;
    }
    match accepted {
        Some(Accepted { accepted: false, .. }) => Ok(Verdict::Failed),
        _ => Ok(Verdict::Good),
    }
}

fn in_words(stage: Stage) -> String {
    match stage {
        Stage::Align => "simulating the rows and fitting the unknown frames".to_owned(),
        Stage::Search(found) => format!("looking for effects, {found} found"),
        Stage::Try(found, effect, place) => {
            format!(
                "looking for effects, {found} found: fitting {} at {place}",
                effect.replace('_', " ")
            )
        }
        Stage::Judge(found) => format!("judging {} and their rivals", counted(found, "finding")),
    }
}

fn plain(error: DiagnoseError) -> Failure {
    Failure::new(error.to_string())
}

impl Args {
    /// Where the corrected arm goes.
    fn arms(&self) -> [&Option<Target>; 3] {
        [&self.write_robot, &self.write_urdf, &self.write_mjcf]
    }

    fn write_arm(&self, corrected: &Corrections<'_>, quiet: bool) -> Result<(), Failure> {
        if let Some(target) = &self.write_robot {
            target.write(&corrected.text())?;
        }
        for (target, format) in [(&self.write_urdf, Format::Urdf), (&self.write_mjcf, Format::Mjcf)]
        {
            if let Some(target) = target {
                let (text, lost) = corrected.exported(format)?;
                target.write(&text)?;
                lost.iter().for_each(|lost| note(lost, quiet));
            }
        }
        if self.arms().iter().any(|target| target.is_some()) {
            corrected.caveats().iter().for_each(|caveat| note(caveat, quiet));
        }
        Ok(())
    }

    fn options(&self, source: &Source) -> Result<Options, Failure> {
        let noise = |option, text: &Option<String>, dimension| {
            text.as_ref().map(|t| quantity::with_unit(option, t, dimension)).transpose()
        };
        let tolerance = self.tolerance.as_ref().map(|text| {
            let (length, angle) = text.split_once(',').ok_or_else(|| {
                let help = "write both, as --tolerance 0.3mm,0.5mrad";
                Failure::with_help(format!("--tolerance: found `{text}`, expected two"), help)
            })?;
            let one = |text, dimension| quantity::with_unit("--tolerance", text, dimension);
            Ok([one(length, Dimension::Length)?, one(angle, Dimension::Angle)?])
        });
        let mut options = Options {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            folds: self.folds,
            seed: self.seed,
            keep_all: self.keep_all,
            nested: self.nested,
            noise_position: noise("--noise-position", &self.noise_position, Dimension::Length)?,
            noise_rotation: noise("--noise-rotation", &self.noise_rotation, Dimension::Angle)?,
            effects: self.effects.clone(),
            tolerance: tolerance.transpose()?,
            rivals: self.rivals.clone(),
            known: source.known.clone(),
            stop: Stop::default(),
            ..Options::default()
        };
        options.fit_along(&self.nuisance).map_err(plain)?;
        Ok(options)
    }
}
