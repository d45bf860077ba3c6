//! `stiffarm poses`: a measurement file that is still to be measured.

use clap::ValueEnum;
use nalgebra::Vector6;
use stiffarm_gap::dexterity::design::{Design, Expected, Plan, Planned, Purpose, design};
use stiffarm_gap::measurement::{DISPLACEMENT_NAMES, Dimension, POSE_NAMES, WRENCH_NAMES};

use super::failure::Failure;
use super::output::{Target, print};
use super::progress::{PARTS, Progress};
use super::source::{RobotArgs, Source};
use super::text::{Align, bold, dim, indented, short, table};
use super::wrench::wrench;
use super::{Verdict, quantity};

const EXAMPLES: &str = "\
Examples:
  stiffarm poses arm.toml --count 20 --load 0,0,-50kgf,0,0,0 --csv plan.csv
  stiffarm poses kuka_kr240 --count 15 --load 0,0,-2kN,0,0,0 --load 2kN,0,0,0,0,0 --csv plan.csv
  stiffarm poses arm.toml --count 30 --for diagnose --load 0,0,-100,0,0,0 --csv plan.csv

Postures are drawn within the joint limits; those that are not dexterous are left out, and those in
which the loaded geometry (K_C) would matter most. Of the rest, each with one of the loads, those
are chosen that together say most (D-optimality). For `identify` each posture is one displacement,
loaded minus unloaded; for `diagnose` each is two poses, without a load and with one.

Fill in the empty columns, put the readings that the controller shows into q1 … qn, and give the
file to `stiffarm identify` or `stiffarm diagnose`. Nothing here knows of floor, cables or cell:
leave out the rows that cannot be reached.";

/// Test postures and loads that say most, as a measurement file to fill in
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    robot: RobotArgs,
    /// How many postures
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000))]
    count: u16,
    /// What the measurements are for
    #[arg(long = "for", value_enum, value_name = "PURPOSE", default_value_t = For::Identify)]
    purpose: For,
    /// A load to choose from, given as often as there are loads; base axes, at the tool origin; N
    /// and N·m, or with a unit [default: pulls of 100 N along ±x, ±y and −z]
    #[arg(long = "load", value_name = "fx,fy,fz,mx,my,mz", allow_hyphen_values = true)]
    loads: Vec<String>,
    /// Rotations will be measured too
    #[arg(long)]
    rotations: bool,
    /// Standard deviation of a measured coordinate
    #[arg(long, value_name = "LENGTH", default_value = "30um", allow_hyphen_values = true)]
    noise_position: String,
    /// Standard deviation of a measured rotation
    #[arg(long, value_name = "ANGLE", default_value = "0.1mrad", allow_hyphen_values = true)]
    noise_rotation: String,
    /// Seed of the postures that are chosen from; the same seed gives the same bytes
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Write the measurement file (`-`: to standard output, in place of the screen)
    #[arg(long, value_name = "OUT")]
    csv: Target,
}

/// What the measurements are for.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum For {
    /// The joints' stiffnesses
    Identify,
    /// Zeros and stiffnesses of the joints, and whatever else shows
    Diagnose,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`]: the robot, the options, or an output that cannot be written.
pub fn run(args: &Args, quiet: bool) -> Result<Verdict, Failure> {
    let plan = args.plan()?;
    let source = args.robot.load(quiet)?;
    let arm = source.arm()?;
    let progress = Progress::new(&source.given, PARTS, quiet);
    let found = design(&arm, &plan, &|part| progress.reach(part, PARTS));
    drop(progress);
    let found = found.map_err(|error| Failure::new(error.to_string()))?;
    args.csv.write(&file(&source, &plan, &found, args))?;
    if args.csv != Target::Stdout && !quiet {
        print(&screen(&source, &arm, &plan, &found))?;
    }
    Ok(Verdict::Good)
}

impl Args {
    fn plan(&self) -> Result<Plan, Failure> {
        let given = self.loads.iter().map(|text| wrench("--load", text));
        let mut loads: Vec<Vector6<f64>> = given.collect::<Result<_, _>>()?;
        if loads.is_empty() {
            let pull = |x: f64, y: f64, z: f64| Vector6::new(x, y, z, 0.0, 0.0, 0.0) * 100.0;
            loads = vec![
                pull(1.0, 0.0, 0.0),
                pull(-1.0, 0.0, 0.0),
                pull(0.0, 1.0, 0.0),
                pull(0.0, -1.0, 0.0),
                pull(0.0, 0.0, -1.0),
            ];
        }
        let (length, angle) = (Dimension::Length, Dimension::Angle);
        let turned = quantity::with_unit("--noise-rotation", &self.noise_rotation, angle)?;
        Ok(Plan {
            count: usize::from(self.count),
            purpose: match self.purpose {
                For::Identify => Purpose::Identify,
                For::Diagnose => Purpose::Diagnose,
            },
            loads,
            noise_position: quantity::with_unit("--noise-position", &self.noise_position, length)?,
            noise_rotation: self.rotations.then_some(turned),
            seed: self.seed,
        })
    }
}

/// The measurement file, its measured columns empty.
fn file(source: &Source, plan: &Plan, found: &Design, args: &Args) -> String {
    let revolute: Vec<bool> = source.readings().iter().map(|d| *d == Dimension::Angle).collect();
    let mut heads = vec!["pose".to_owned()];
    heads.extend(
        revolute
            .iter()
            .enumerate()
            .map(|(j, turns)| format!("q{}[{}]", j + 1, if *turns { "deg" } else { "mm" })),
    );
    let loaded: Vec<usize> =
        (0..6).filter(|&k| plan.loads.iter().any(|load| load[k] != 0.0)).collect();
    heads.extend(
        loaded.iter().map(|&k| format!("{}[{}]", WRENCH_NAMES[k], if k < 3 { "N" } else { "Nm" })),
    );
    let names = match plan.purpose {
        Purpose::Identify => DISPLACEMENT_NAMES,
        Purpose::Diagnose => POSE_NAMES,
    };
    let measured = if args.rotations { 6 } else { 3 };
    heads.extend((0..measured).map(|k| {
        let unit = match (k < 3, plan.purpose) {
            (true, _) => "mm",
            (false, Purpose::Identify) => "mrad",
            (false, Purpose::Diagnose) => "deg",
        };
        format!("{}[{unit}]", names[k])
    }));
    let what = match plan.purpose {
        Purpose::Identify => "loaded minus unloaded, of the tool origin",
        Purpose::Diagnose => "of the tool in the base frame, before and under the load",
    };
    let mut text = format!(
        "# {}: fill in {} to {}, {what}, base axes.\n{}\n",
        source.robot.name.replace(char::is_control, " "),
        names[0],
        names[measured - 1],
        heads.join(",")
    );
    for (k, test) in found.tests.iter().enumerate() {
        let zero = Vector6::zeros();
        let wrenches: &[&Vector6<f64>] = match plan.purpose {
            Purpose::Identify => &[&test.wrench],
            Purpose::Diagnose => &[&zero, &test.wrench],
        };
        for load in wrenches {
            let mut cells = vec![format!("{}", k + 1)];
            cells.extend(readings(test, &revolute));
            cells.extend(loaded.iter().map(|&k| plain(load[k], 6)));
            cells.extend((0..measured).map(|_| String::new()));
            text.push_str(&cells.join(","));
            text.push('\n');
        }
    }
    text
}

/// To a thousandth of a degree or millimetre: finer than a controller is told.
fn readings(test: &Planned, revolute: &[bool]) -> Vec<String> {
    let shown = |(q, turns): (&f64, &bool)| plain(if *turns { q.to_degrees() } else { 1e3 * q }, 3);
    test.q.iter().zip(revolute).map(shown).collect()
}

/// With so many digits behind the point at most.
fn plain(x: f64, digits: usize) -> String {
    let text = format!("{x:.digits$}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}

fn screen(
    source: &Source,
    arm: &stiffarm_kernels::generic::Arm,
    plan: &Plan,
    found: &Design,
) -> String {
    let least = |value: fn(&Planned) -> f64| found.tests.iter().map(value).fold(1.0, f64::min);
    let most = found.tests.iter().map(|t| t.nu_p).fold(0.0, f64::max);
    let mut text = format!(
        "{}\n{}\n\n",
        bold(&source.robot.name),
        dim(format!(
            "{}; 1/κ of {} or more with L = {} m, K_C adds {} % or less",
            quantity::counted(found.tests.len(), "posture"),
            short(least(|t| t.inverse_condition)),
            short(found.length),
            short(100.0 * most),
        ))
    );
    let mut heads = vec![bold("Expected"), dim("compliance ±"), dim("of the file's")];
    if plan.purpose == Purpose::Diagnose {
        heads.push(dim("zero ±"));
    }
    let mut rows = vec![heads];
    let readings = source.readings();
    for (expected, joint) in found.expected.iter().zip(&arm.joints) {
        rows.push(line(expected, joint.compliance, readings.get(expected.joint - 1), plan));
    }
    let lines = table(&rows, &[Align::Left; 4]);
    let (head, rest) = lines.split_once('\n').unwrap_or((&lines, ""));
    text.push_str(&format!("{}\n{}", head.replacen("  ", "    ", 1), indented(rest, 2)));
    text.push_str(&format!(
        "\nas good as {} times as many random tests of the same kind\n",
        short(found.efficiency)
    ));
    text
}

fn line(expected: &Expected, file: f64, reading: Option<&Dimension>, plan: &Plan) -> Vec<String> {
    let slides = reading == Some(&Dimension::Length);
    let unit = if slides { "µm/N" } else { "µrad/(N·m)" };
    let mut cells = vec![format!("joint {}", expected.joint)];
    match expected.compliance {
        Some(sd) => {
            cells.push(format!("{} {unit}", short(1e6 * sd)));
            let part = || format!("{} %", short(100.0 * sd / file));
            cells.push(if file > 0.0 { part() } else { dim("rigid") });
        }
        None => cells.extend(["no load shows it".to_owned(), dim("–")]),
    }
    if plan.purpose == Purpose::Diagnose {
        let unit = if slides { "µm" } else { "µrad" };
        let shown = |sd: f64| format!("{} {unit}", short(1e6 * sd));
        cells.push(expected.zero.map_or_else(|| "nothing shows it".to_owned(), shown));
    }
    cells
}
