//! `stiffarm compensate`: set-points at which the loaded arm stands where it should, and programs with such points.

mod places;
mod program;
mod report;

use std::path::{Path, PathBuf};

use nalgebra::{UnitQuaternion, Vector3, Vector6};
use stiffarm_compensate::reach::{Ended, Reached, Search, Target as Goal, reach_by_branches};
use stiffarm_document::text::{bold, counted, dim, short};
use stiffarm_gap::Measurements;
use stiffarm_gap::doubts;
use stiffarm_gap::io::{Columns, ReadError, quoted};
use stiffarm_gap::measurement::{Dimension, Kind, Layout, POSE_NAMES, Row};
use stiffarm_gap::simulate::moments;
use stiffarm_gap::whole::{Situation, Whole};
use stiffarm_kernels::generic::Joint;

use super::Verdict;
use crate::host::Host;
use crate::input::branches::Branches;
use crate::input::source::{RobotArgs, Source};
use crate::input::wrench::wrench;
use crate::input::{data, quantity};
use crate::terminal::failure::Failure;
use crate::terminal::output::Target;
use crate::terminal::progress::Progress;

const EXAMPLES: &str = "\
Examples:
  stiffarm compensate arm.toml --targets path.csv --wrench 0,0,-500,0,0,0 --out corrected.csv
  stiffarm compensate arm_stiff.toml --targets path.csv --tolerance 10um --out - | column -ts,
  stiffarm compensate better.toml --program weld.src --program weld.dat --nominal arm.toml --out corrected/
  stiffarm compensate better.toml --program pick.ls --nominal arm.toml --frame 1=500,0,200,0,0,0 \
    --tool 2=robot --home 0,0,0,0,-90deg,0 --out corrected.ls --moves moves.csv

TARGETS is a file like a measurement file: x y z and perhaps rx ry rz, where the tool should be in
the base frame; perhaps q1 … qn, from where to start; perhaps fx … mz, a load for each row in place
of --wrench. Without q1 … qn each row starts where the row before ended; the first, and any that
does not come to its target so, from the branches of the inverse kinematics where the arm has a closed
form or is near one that has, else from many postures; the one that gives way least is taken.

OUT has the set-points of every row, what the loaded arm misses there (error) and what it would miss
without compensation (before), and a status: reached, nearest (at limit: the joints named) or
unstable. Exit status 1 if a row is not reached. The arm is that of the robot file at static
equilibrium: springs, beams, weights, the load. `stiffarm identify --write-robot` puts measured
springs into it.

A program is KRL (.src, .dat), RAPID (.mod), FANUC's TP in letters (.ls), URScript (.script) or a table of
poses or joint values (.csv). Its points are rewritten so that the arm of the robot file stands where the
controller, which computes with the arm of --nominal, believes; nothing else of the program changes. q1 … qn of both
robot files are the controller's joint values, and their bases the controller's: [base] is left out.
A frame or tool that the program does not define is given by --frame and --tool.";

/// Joint set-points at which the loaded arm stands at the targets
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    robot: RobotArgs,
    /// Where the tool should be (CSV)
    #[arg(long, value_name = "CSV", required_unless_present = "program")]
    targets: Option<PathBuf>,
    #[command(flatten)]
    program: program::ProgramArgs,
    /// Load on the tool: base axes, at the tool origin; N and N·m, or with a unit [default: the
    /// targets' own, else the links' weights alone]
    #[arg(long, value_name = "fx,fy,fz,mx,my,mz", allow_hyphen_values = true)]
    wrench: Option<String>,
    /// Largest distance from a target
    #[arg(long, value_name = "LENGTH", default_value = "1um", allow_hyphen_values = true)]
    tolerance: String,
    /// Largest angle from a target
    #[arg(long, value_name = "ANGLE", default_value = "0.001mrad", allow_hyphen_values = true)]
    tolerance_rotation: String,
    /// Postures to start from where the first start does not lead to the target
    #[arg(long, value_name = "N", default_value_t = 24)]
    starts: u16,
    /// Seed of these postures; the same seed gives the same bytes
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Write the set-points, or the program: a file, of several files a folder (`-`: to standard output, in
    /// place of the screen)
    #[arg(long, value_name = "FILE")]
    out: Target,
}

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    let (length, angle) = (Dimension::Length, Dimension::Angle);
    let search = Search {
        translation: quantity::with_unit("--tolerance", &args.tolerance, length)?,
        rotation: quantity::with_unit("--tolerance-rotation", &args.tolerance_rotation, angle)?,
        starts: usize::from(args.starts),
        seed: args.seed,
    };
    let given = args.wrench.as_ref().map(|text| wrench("--wrench", text)).transpose()?;
    let source = args.robot.load(host)?;
    let Some(path) = &args.targets else {
        let load = given.unwrap_or_default();
        return args.program.run(source, (load, search), &args.out, host);
    };
    let arm = source.arm()?;
    let whole = Whole { arm: &arm, known: &source.known };
    let inverse = Branches::of(&source);
    let (targets, starts) = targets(path, &source, host)?;
    doubts::units(&arm, &targets).iter().for_each(|doubt| host.note(doubt));
    if given.is_some() && targets.wrench_in.iter().any(Option::is_some) {
        let message = format!("--wrench: {} has loads of its own", path.display());
        return Err(Failure::with_help(message, "leave out --wrench or the columns fx … mz"));
    }
    let gives = |joint: &Joint| joint.compliance != 0.0 || joint.beam.is_some();
    if source.known.is_empty() && !arm.joints.iter().any(gives) {
        host.note("nothing in the robot file gives way: the set-points are those of a rigid arm");
    }
    let progress = Progress::new(&source.given, targets.rows.len(), host);
    let mut found: Vec<Reached> = Vec::new();
    for (row, now) in targets.rows.iter().zip(moments(&targets)) {
        let at = Situation {
            load: given.unwrap_or(row.wrench),
            direction: row.direction.clone(),
            warming: row.temperature.map(|_| now.warming),
            before: found.last().map(|end| end.q.clone()),
        };
        source.refuse_undecided("compensate", &whole, &at)?;
        let before = found.last().filter(|end| end.ended == Ended::Reached);
        let from = if starts { Some(&row.q) } else { before.map(|end| &end.q) };
        let goal = goal(row, targets.kind);
        let branches = || inverse.as_ref().map_or_else(Vec::new, |arm| arm.set_points(&goal, &at));
        let start = (from.map(Vec::as_slice), &branches as &dyn Fn() -> _);
        let end = reach_by_branches(whole, &goal, &at, start, &search);
        found.push(end.map_err(|error| {
            Failure::new(format!("{}: line {}: {error}", targets.file, row.line))
        })?);
        progress.add(1);
    }
    drop(progress);
    host.write(&args.out, &file(&source, &targets, &found))?;
    let missed = found.iter().filter(|end| end.ended != Ended::Reached).count();
    if args.out != Target::Stdout && !host.is_quiet() {
        host.print(&screen(&source, &targets, &found))?;
    }
    if missed > 0 {
        host.note(&format!("{} of {} targets are not reached", missed, found.len()));
        return Ok(Verdict::Failed);
    }
    Ok(Verdict::Good)
}

/// The targets, and whether they have joint values to start from.
fn targets(path: &Path, source: &Source, host: &Host) -> Result<(Measurements, bool), Failure> {
    let bytes = host.read(path)?;
    let starts = has_readings(&bytes);
    let layout = Layout { readings: starts, ..data::layout(source)? };
    let targets = data::from_bytes(path, &bytes, &layout)?;
    if !targets.skipped.is_empty() {
        return Err(data::refusal(
            &bytes,
            &ReadError { file: targets.file, mistakes: targets.skipped, more: 0 },
        ));
    }
    let refused = |text: &str, help: &str| {
        Err(Failure::with_help(format!("{}: {text}", path.display()), help))
    };
    if !targets.kind.is_pose() {
        return refused(
            &format!("found {}, expected poses: x, y, z", targets.kind.measured().join(", ")),
            "a target is a place in the base frame",
        );
    }
    if targets.rows.iter().any(|row| row.payload.is_some()) {
        return refused(
            "found a column of payloads, expected loads: fx, fy, fz, mx, my, mz",
            "what a payload pulls at the tool depends on the posture that is looked for",
        );
    }
    if targets.rows.iter().any(|row| row.marker.is_some()) {
        return refused(
            "found a column of markers, expected targets of the tool origin",
            "move the targets by the marker's offset, or the [tool] to the marker",
        );
    }
    Ok((targets, starts))
}

/// Whether the header has a column `q1`, `q2`, ….
fn has_readings(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    let header = text.lines().find(|line| !line.starts_with('#') && !line.trim().is_empty());
    let reading = |cell: &str| {
        let name = cell.trim().trim_matches('"');
        name.strip_prefix('q').is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
    };
    header.is_some_and(|header| header.split(',').any(reading))
}

fn goal(row: &Row, kind: Kind) -> Goal {
    let m = &row.measured;
    let rotation = matches!(kind, Kind::Pose { orientation: true })
        .then(|| UnitQuaternion::from_scaled_axis(Vector3::new(m[3], m[4], m[5])));
    Goal { position: Vector3::new(m[0], m[1], m[2]), rotation }
}

/// `[position, rotation]` of an error, m and rad.
fn sizes(error: &Vector6<f64>) -> [f64; 2] {
    [error.fixed_rows::<3>(0).norm(), error.fixed_rows::<3>(3).norm()]
}

/// A row for each target.
fn file(source: &Source, targets: &Measurements, found: &[Reached]) -> String {
    let turned = matches!(targets.kind, Kind::Pose { orientation: true });
    let mut columns: Columns<'_, (&Row, &Reached)> = Columns::default();
    if targets.rows.iter().any(|row| row.pose.is_some()) {
        columns.add("pose", |(row, _)| quoted(row.pose.as_deref()));
    }
    let is_stable = |end: &Reached| end.ended != Ended::Unstable;
    for (k, (head, reading)) in source.heads().zip(source.readings()).enumerate() {
        columns.add(head, move |(_, end)| match (is_stable(end), reading) {
            (false, _) => String::new(),
            // To a nanoradian and a nanometre.
            (true, Dimension::Angle) => format!("{:.8}", rounded(end.q[k].to_degrees(), 1e8)),
            (true, _) => format!("{:.6}", rounded(1e3 * end.q[k], 1e6)),
        });
    }
    for (k, name) in POSE_NAMES.iter().enumerate().take(if turned { 6 } else { 3 }) {
        let unit = if k < 3 { "mm" } else { "deg" };
        columns.add(format!("{name}[{unit}]"), move |(row, _)| match k < 3 {
            true => format!("{:.6}", 1e3 * row.measured[k]),
            false => format!("{:.8}", row.measured[k].to_degrees()),
        });
    }
    type Error = fn(&Reached) -> Option<Vector6<f64>>;
    let errors: [(&str, Error); 2] = [
        ("error", |end| Some(end.error).filter(|_| end.ended != Ended::Unstable)),
        ("before", |end| end.uncompensated),
    ];
    let parts = [("[mm]", 0), ("_rotation[mrad]", 1)];
    for (name, error) in errors {
        for (of, part) in parts.into_iter().take(1 + usize::from(turned)) {
            columns.add(format!("{name}{of}"), move |(_, end)| {
                error(end).map_or_else(String::new, |e| format!("{:.6}", 1e3 * sizes(&e)[part]))
            });
        }
    }
    columns.add("status", |(_, end)| status(&end.ended));
    columns.text(Vec::<String>::new(), targets.rows.iter().zip(found))
}

/// To a part of one, without a minus before zero.
fn rounded(x: f64, parts: f64) -> f64 {
    (x * parts).round() / parts + 0.0
}

fn status(ended: &Ended) -> String {
    match ended {
        Ended::Reached => "reached".to_owned(),
        Ended::Unstable => "unstable".to_owned(),
        Ended::Nearest(joints) if joints.is_empty() => "nearest".to_owned(),
        Ended::Nearest(joints) => {
            let names: Vec<String> = joints.iter().map(|joint| format!("q{joint}")).collect();
            format!("nearest (at limit: {})", names.join(" "))
        }
    }
}

fn screen(source: &Source, targets: &Measurements, found: &[Reached]) -> String {
    let reached = || found.iter().filter(|end| end.ended == Ended::Reached);
    let largest =
        |value: &dyn Fn(&Reached) -> Option<f64>| reached().filter_map(value).fold(0.0, f64::max);
    let before = largest(&|end| end.uncompensated.map(|e| sizes(&e)[0]));
    let after = largest(&|end| Some(sizes(&end.error)[0]));
    let mut text = format!(
        "{}\n{}\n\n",
        bold(&source.robot.name),
        dim(format!("{}: {}", targets.file, counted(found.len(), "target")))
    );
    text.push_str(&format!("  reached  {} of {}\n", reached().count(), found.len()));
    if reached().next().is_some() {
        text.push_str(&format!("  without compensation  {} mm at most\n", short(1e3 * before)));
        // What the steps leave is rounding; nobody needs its digits.
        let left = if after < 1e-9 { "below 1e-6".to_owned() } else { short(1e3 * after) };
        text.push_str(&format!("  with compensation     {left} mm at most\n"));
    }
    const SHOWN: usize = 5;
    let missed: Vec<(&Row, &Reached)> =
        targets.rows.iter().zip(found).filter(|(_, e)| e.ended != Ended::Reached).collect();
    for (row, end) in missed.iter().take(SHOWN) {
        let gap = match end.ended {
            Ended::Unstable => String::new(),
            _ => format!(", {} mm away", short(1e3 * sizes(&end.error)[0])),
        };
        text.push_str(&format!("  line {}: {}{gap}\n", row.line, status(&end.ended)));
    }
    if missed.len() > SHOWN {
        text.push_str(&format!("  and {} more\n", missed.len() - SHOWN));
    }
    text
}
