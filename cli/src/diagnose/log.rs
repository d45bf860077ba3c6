//! A joint log: known by its columns, diagnosed by its rows.

use std::path::PathBuf;

use clap::ValueEnum;
use stiffarm_gap::log::{Domain, Log, LogError, LogOptions, Names, TorqueSide, diagnose, is_log};
use stiffarm_gap::readings::Map;

use super::Args;
use crate::Verdict;
use crate::input::source::{Source, text};
use crate::screen::log_text;
use crate::terminal::failure::Failure;
use crate::terminal::json;
use crate::terminal::note::note;
use crate::terminal::output::{Target, print};

/// What may be said of a log.
#[derive(clap::Args)]
#[command(next_help_heading = "Of a joint log")]
pub struct LogArgs {
    /// Where its torques are measured: motor (joint side of the gear), link (a sensor behind it),
    /// current, commanded [default: as the log says]
    #[arg(long, value_name = "SIDE", value_parser = side)]
    torque_side: Option<TorqueSide>,
    /// Which rows, where a log has both [default: torque]
    #[arg(long, value_name = "ROWS")]
    rows: Option<Rows>,
    /// Edge of the low-pass that everything goes through: 50Hz [default: where the joint values stand
    /// clear of their noise]
    #[arg(long, value_name = "FREQUENCY", value_parser = hertz)]
    band: Option<f64>,
    /// Speed, rad/s or m/s, below which a joint's torque tells nothing [default: 0.5 % of its largest]
    #[arg(long, value_name = "SPEED")]
    standstill: Option<f64>,
    /// What its columns are called: ros, rtde, libfranka, lerobot, sage, pace, or a map (TOML)
    #[arg(long, value_name = "MAP")]
    map: Option<String>,
}

/// Which rows.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Rows {
    /// What drives the joints
    Torque,
    /// Where they are, less where they were to be
    Position,
}

fn side(word: &str) -> Result<TorqueSide, String> {
    let known: Vec<&str> = TorqueSide::ALL.iter().map(|(name, _)| *name).collect();
    TorqueSide::named(word).ok_or_else(|| format!("expected one of {}", known.join(", ")))
}

fn hertz(text: &str) -> Result<f64, String> {
    let number = text.trim().strip_suffix("Hz").unwrap_or(text).trim();
    number.parse().map_err(|_| "expected a frequency, as 50Hz".to_owned())
}

impl LogArgs {
    /// The first of these options that is given.
    fn given(&self) -> Option<&'static str> {
        [
            (self.torque_side.is_some(), "--torque-side"),
            (self.rows.is_some(), "--rows"),
            (self.band.is_some(), "--band"),
            (self.standstill.is_some(), "--standstill"),
            (self.map.is_some(), "--map"),
        ]
        .into_iter()
        .find_map(|(given, name)| given.then_some(name))
    }

    /// What the columns are called.
    fn names(&self, source: &Source) -> Result<Names, Failure> {
        let joints = source.robot.joints.iter().map(|joint| joint.name.clone()).collect();
        let own = Names::own(joints);
        let Some(map) = &self.map else { return Ok(own) };
        if let Some(names) = own.clone().of_format(map) {
            return Ok(names);
        }
        if !map.contains(['.', '/', '\\']) {
            let known: Vec<&str> = Names::formats().collect();
            let message =
                format!("--map: found `{map}`, expected a file or one of {}", known.join(", "));
            return Err(Failure::new(message));
        }
        let read = Map::read(map, &text(PathBuf::from(map).as_path())?);
        Ok(own.mapped(read.map_err(|error| Failure::new(error.to_string()))?))
    }
}

/// What the files are.
pub enum Files {
    /// A joint log: names and bytes.
    Log(Vec<(String, Vec<u8>)>),
    /// The bytes of a measurement file.
    Measurements(Vec<u8>),
}

/// Reads the files, and knows by their columns what they are.
///
/// # Errors
/// [`Failure`]: a file that cannot be read, several that are no log, options of a log beside one that is
/// none.
pub fn files(args: &Args) -> Result<Files, Failure> {
    let read = |path: &PathBuf| -> Result<(String, Vec<u8>), Failure> {
        let bytes = stiffarm_gap::measurement::bytes(path)
            .map_err(|error| Failure::io("read", path, &error))?;
        Ok((path.display().to_string(), bytes))
    };
    let mut files: Vec<(String, Vec<u8>)> =
        args.data.iter().map(read).collect::<Result<_, Failure>>()?;
    if args.log.map.is_some() || files.iter().any(|(_, bytes)| logged(bytes)) {
        return Ok(Files::Log(files));
    }
    let refused = |what: String, help| {
        let first = &args.data[0].display();
        Err(Failure::with_help(format!("{what}, and {first} is no joint log by its columns"), help))
    };
    if let Some(option) = args.log.given() {
        let help =
            "a log has t, q1 …, and tau1 …, i1 … or q_cmd1 …; --map says how others call them";
        return refused(format!("{option} is for joint logs"), help);
    }
    match (files.pop(), files.len()) {
        (Some((_, bytes)), 0) => Ok(Files::Measurements(bytes)),
        (_, more) => {
            refused(format!("found {} files", more + 1), "measurements are diagnosed file by file")
        }
    }
}

/// Whether the columns are those of a log.
fn logged(bytes: &[u8]) -> bool {
    let mut lines = bytes.split(|b| *b == b'\n').map(String::from_utf8_lossy);
    let header = lines.find(|line| !line.starts_with('#') && !line.trim().is_empty());
    let header = header.unwrap_or_default();
    let names: Vec<&str> = header.trim().split([',', ';', '\t', ' ']).map(str::trim).collect();
    is_log(&names)
}

/// Diagnoses a log.
///
/// # Errors
/// [`Failure`]: the log, the options, or an output that cannot be written.
pub fn run(
    args: &Args,
    source: &Source,
    files: &[(String, Vec<u8>)],
    quiet: bool,
) -> Result<Verdict, Failure> {
    if let Some(option) = args.of_measurements() {
        return Err(Failure::new(format!(
            "{option} is for measurement files, and {} is a joint log by its columns",
            files[0].0
        )));
    }
    let arm = source.arm()?;
    let names = args.log.names(source)?;
    let motions: Vec<_> = arm.joints.iter().map(|joint| joint.motion).collect();
    let plain = |error: LogError| Failure::new(error.to_string());
    let mut log: Option<Log> = None;
    for (file, bytes) in files {
        let next = Log::from_bytes(file, bytes, &motions, &names).map_err(plain)?;
        log = Some(match log {
            Some(log) => log.and(next).map_err(plain)?,
            None => next,
        });
    }
    let Some(log) = log else { return Err(Failure::new("found no log, expected a file")) };
    let options = LogOptions {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        side: args.log.torque_side,
        rows: args.log.rows.map(|rows| match rows {
            Rows::Torque => Domain::Torque,
            Rows::Position => Domain::Position,
        }),
        band: args.log.band,
        standstill: args.log.standstill,
        effects: args.effects.clone(),
        seed: args.seed,
    };
    let found = diagnose(&arm, &log, &options).map_err(|e| Failure::new(e.to_string()))?;
    found.remarks.iter().for_each(|remark| note(remark, quiet));
    if let Some(target) = &args.json {
        target.write(&json::text(&found)?)?;
    }
    let enough = args.json.as_ref().is_some_and(|target| quiet || *target == Target::Stdout);
    if !enough {
        print(&log_text(&found))?;
    }
    Ok(Verdict::Good)
}
