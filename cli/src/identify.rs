//! `stiffarm identify`: stiffnesses from loaded measurements.

mod corrected;

use std::path::PathBuf;

use serde_json::{Value, json};
use stiffarm_document::TOP;
use stiffarm_document::identified::{Identified, is_translation, stiffness};
use stiffarm_gap::Measurements;
use stiffarm_gap::diagnose::Nuisance;
use stiffarm_gap::gap::Statistics;
use stiffarm_gap::identify::measured::{
    Answer, Parameter, Question, Status, Unknown, identify_measured,
};
use stiffarm_gap::measurement::Dimension;
use stiffarm_kernels::generic::Arm;

use super::Verdict;
use crate::host::Host;
use crate::input::data::{self, BenchArgs};
use crate::input::quantity;
use crate::input::source::{RobotArgs, Source};
use crate::terminal::failure::Failure;
use crate::terminal::output::Target;
use crate::terminal::progress::{PARTS, Progress};

const EXAMPLES: &str = "\
Examples:
  stiffarm identify arm.toml run1.csv
  stiffarm identify arm.toml run1.csv --noise-position 30um --write-robot arm_stiff.toml
  stiffarm identify arm.toml run1.csv --links --base --json -
  stiffarm identify arm.toml run1.csv --report springs.html

DATA is a measurement file with loads (fx … mz) and displacements dx dy dz [drx dry drz], any subset
of them; or with poses x y z [rx ry rz], each pose under two loads or more: only the differences
between the loads of a pose count then, so that base, tool and geometry need not be exact.
`stiffarm poses` plans such a file.

The robot file's arm is evaluated at static equilibrium, with weights and loaded geometry. A compliance
that the data do not determine is held at the robot file's value, and the load that would determine it is
named. The error is judged on held-out poses.";

/// Joint stiffnesses, and if asked those of links and base, from loaded measurements
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    robot: RobotArgs,
    /// The measurement file (CSV)
    data: PathBuf,
    /// Identify the beams of the robot file too, each as a multiple of its flexibility
    #[arg(long)]
    links: bool,
    /// Identify the foundation too: three translations, three rotations
    #[arg(long)]
    base: bool,
    /// Standard deviation of a measured coordinate: 30um [default: from repeats, else from the residuals]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    noise_position: Option<String>,
    /// Standard deviation of a measured rotation: 0.02deg [default: from repeats, else from the residuals]
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    noise_rotation: Option<String>,
    #[command(flatten)]
    bench: BenchArgs,
    /// Number of folds [default: one per pose up to 10]
    #[arg(long, value_name = "K")]
    folds: Option<usize>,
    /// Seed of the folds; the same seed gives the same bytes
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Write the result as JSON (`-`: to standard output, in place of the screen)
    #[arg(long, value_name = "OUT")]
    json: Option<Target>,
    /// Write the robot file with the identified springs
    #[arg(long, value_name = "OUT.toml")]
    write_robot: Option<Target>,
    /// Write the result as one self-contained page
    #[arg(long, value_name = "OUT.html")]
    report: Option<Target>,
}

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    let question = args.question()?;
    let source = args.robot.load(host)?;
    let question = Question { known: source.known.clone(), ..question };
    let arm = source.arm_at_its_base()?;
    let data = data::read(&args.data, &args.bench.layout(&source, host)?, host)?;
    // Loads are told in the base's axes, and so are springs.
    let data = data.seen_from(&source.arm()?.base).ok_or_else(|| {
        let message = format!("{}: found some components alone", args.data.display());
        Failure::with_help(
            message,
            "seen from a [base] that is turned, all three or none are measured",
        )
    })?;
    // Only what loads change is used, whatever frame it is in.
    data::doubted(&arm, &data, &Nuisance::ALL, host);
    let progress = Progress::new(&source.given, PARTS, host);
    let answer = identify_measured(&arm, &data, &question, &|part| progress.reach(part, PARTS));
    drop(progress);
    let answer = answer?;
    let result = written(&source, &arm, &data, &answer, &args.data.display().to_string());
    if data.sim_given.contains(&true) {
        host.note("the columns sim_… play no part: springs are compared with the robot file");
    }
    host.put(&args.json, || crate::terminal::json::text(&result))?;
    host.put(&args.write_robot, || corrected::robot(&source, &answer, &data.file))?;
    let identified = Identified {
        robot: &source.robot.name,
        given: &source.given,
        arm: &arm,
        data: &data,
        question: &question,
        answer: &answer,
    };
    host.put(&args.report, || {
        Ok(identified.document(true).html(&identified.embedded(&result)?)?)
    })?;
    if host.shows(&[&args.json, &args.write_robot, &args.report]) {
        host.print(&identified.document(false).text(TOP))?;
    }
    Ok(Verdict::Good)
}

impl Args {
    fn question(&self) -> Result<Question, Failure> {
        let noise = |option, text: &Option<String>, dimension| {
            text.as_ref().map(|t| quantity::with_unit(option, t, dimension)).transpose()
        };
        Ok(Question {
            links: self.links,
            base: self.base,
            noise_position: noise("--noise-position", &self.noise_position, Dimension::Length)?,
            noise_rotation: noise("--noise-rotation", &self.noise_rotation, Dimension::Angle)?,
            folds: self.folds,
            seed: self.seed,
            ..Question::default()
        })
    }
}

/// The result as it is written; SI.
fn written(source: &Source, arm: &Arm, data: &Measurements, answer: &Answer, file: &str) -> Value {
    let sizes = |s: &Statistics| {
        json!({
            "position_rms": s.position_rms,
            "position_max": s.position_max,
            "rotation_rms": s.rotation_rms,
        })
    };
    let noise = &answer.noise;
    json!({
        "stiffarm": env!("CARGO_PKG_VERSION"),
        "robot": source.robot.name,
        "data": file,
        "measurements": data.rows.len(),
        "poses": data.poses,
        "folds": answer.gap.folds,
        "gap": {"before": sizes(&answer.gap.before), "held_out": sizes(&answer.gap.held_out)},
        "noise": {"position": noise.position, "rotation": noise.rotation, "from": noise.from},
        "freedom": answer.freedom,
        "reduced_chi2": answer.reduced_chi2,
        "scaled_condition": answer.scaled_condition,
        "parameters": answer.parameters.iter().map(|p| entry(arm, p)).collect::<Vec<_>>(),
    })
}

/// One number, found or held: its interval is none of one that is held; its stiffness is none where it is rigid, or
/// unbounded.
fn entry(arm: &Arm, parameter: &Parameter) -> Value {
    let unknown = parameter.unknown;
    let compliance = !matches!(unknown, Unknown::Link(_));
    let unit = match (compliance, is_translation(arm, unknown)) {
        (false, _) => "1",
        (true, true) => "m/N",
        (true, false) => "rad/(N·m)",
    };
    let (status, with, pull) = match &parameter.status {
        Status::Determined => ("determined", Vec::new(), None),
        Status::Weak(pull) => ("weak", Vec::new(), pull.as_ref()),
        Status::Held { with, pull } => {
            ("held", with.iter().map(Unknown::to_string).collect(), pull.as_ref())
        }
    };
    let interval = parameter.interval();
    json!({
        "place": unknown.to_string(),
        "name": if compliance { "compliance" } else { "flexibility" },
        "unit": unit,
        "status": status,
        "value": parameter.value,
        "ci95": interval,
        "stiffness": stiffness(parameter.value).filter(|_| compliance),
        "stiffness_ci95": interval.filter(|_| compliance).map(|[low, high]| [high, low].map(stiffness)),
        "file": parameter.file,
        "with": with,
        "to_show_it": pull.map(ToString::to_string),
    })
}
