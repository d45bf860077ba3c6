//! A joint log: known by its columns, diagnosed by its rows.

mod check;
mod files;
mod motion;
mod written;

use std::path::PathBuf;

use clap::ValueEnum;
use stiffarm_gap::io::Map;
use stiffarm_gap::log::{Names, TorqueSide};

pub use check::Check;
pub use files::{Files, Part, files, is_log};
pub use motion::{Motion, Told};

use crate::input::source::{Source, text};
use crate::terminal::failure::Failure;

/// What may be said of a log.
#[derive(Clone, clap::Args)]
#[command(next_help_heading = "For joint logs")]
pub struct LogArgs {
    /// Where its torques are measured: motor (joint side of the gear), link (a sensor behind it),
    /// current, commanded [default: as the log says]
    #[arg(long, value_name = "SIDE", value_parser = side)]
    torque_side: Option<TorqueSide>,
    /// Which rows, where a log has both [default: torque]
    #[arg(long, value_name = "ROWS")]
    rows: Option<Rows>,
    /// Cut-off frequency of the low-pass: 50Hz [default: where the joint values exceed their noise]
    #[arg(long, value_name = "FREQUENCY", value_parser = hertz)]
    band: Option<f64>,
    /// Speed, rad/s or m/s, below which a joint's torque is not used [default: 0.5 % of its largest]
    #[arg(long, value_name = "SPEED")]
    standstill: Option<f64>,
    /// Take the robot file's masses and inertias as known; a difference is a finding [default: they are
    /// co-estimated]
    #[arg(long)]
    known_masses: bool,
    /// Names of the columns: ros, rtde, libfranka, lerobot, sage, pace, or a map (TOML)
    #[arg(long, value_name = "MAP")]
    map: Option<String>,
    /// Topic of a bag with the arm's joints, if several have any
    #[arg(long, value_name = "TOPIC")]
    topic: Option<String>,
}

/// Which rows.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Rows {
    /// Joint torques or currents
    Torque,
    /// Position errors: joint values minus commands
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
            (self.known_masses, "--known-masses"),
            (self.map.is_some(), "--map"),
            (self.topic.is_some(), "--topic"),
        ]
        .into_iter()
        .find_map(|(given, name)| given.then_some(name))
    }

    /// What the columns are called.
    fn names(&self, source: &Source) -> Result<Names, Failure> {
        let joints = source.robot.joints.iter().map(|joint| joint.name.clone()).collect();
        let own = Names::own(joints);
        let own = match &self.topic {
            Some(topic) => own.of_topic(topic.clone()),
            None => own,
        };
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
