//! Joint logs: text, and the files of others, into runs of samples, in SI.
//!
//! ```csv
//! # torque_side = motor
//! t[s],q1[rad],q2[rad],tau1[N*m],tau2[N*m]
//! 0.000,0.10000,-0.52000,1.25,14.2
//! ```
//!
//! Needed are `t`, `q1` … `qn`, and one of `tau1 …` (N·m, N if prismatic), `i1 …` (A) and `q_cmd1 …`;
//! optional `qd`, `qdd`, `qd_cmd`, `tau_cmd`, `temp` of every joint, the wrench `fx … mz` on the tool,
//! `payload` and `run` (any texts), `contact` (0 or 1). A unit in brackets stands behind a name where it
//! is not SI. Lines that begin with `#` are comments, and may say `torque_side = …`.
//!
//! Damaged rows are what a real log has: cells missing or too many, no number, a number that no joint
//! has. They are left out, counted, and told by line. What is wrong with the header is an error.

#[cfg(any(feature = "mcap", feature = "rosbag2"))]
mod cdr;
mod clock;
mod column;
mod format;
#[cfg(feature = "mcap")]
mod mcap;
mod names;
#[cfg(feature = "parquet")]
mod parquet;
#[cfg(any(feature = "mcap", feature = "rosbag2"))]
mod ros;
#[cfg(feature = "rosbag2")]
mod rosbag2;
mod table;
#[cfg(test)]
mod tests;
mod text;
mod unit;

use std::collections::BTreeMap;

pub use clock::Clock;
pub use column::{Signal, is_log};
pub use format::{Format, Opened};
pub use names::Names;
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use crate::doubts::beyond;

/// Where along the drive the torque of a log is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TorqueSide {
    /// Of the motor, at the joint's side of its gear: friction and rotor are in it.
    Motor,
    /// Behind the gear, by a sensor at the link.
    Link,
    /// The motor's current.
    Current,
    /// What the controller asks of the drive.
    Commanded,
    /// What is left when the robot's own model is taken away.
    External,
}

impl TorqueSide {
    /// All of them, by their words.
    pub const ALL: [(&'static str, TorqueSide); 5] = [
        ("motor", TorqueSide::Motor),
        ("link", TorqueSide::Link),
        ("current", TorqueSide::Current),
        ("commanded", TorqueSide::Commanded),
        ("external", TorqueSide::External),
    ];

    /// Whether friction and rotors of the drive are in it.
    pub fn is_driven(self) -> bool {
        matches!(self, TorqueSide::Motor | TorqueSide::Commanded)
    }

    /// Of a word; `None` if it is none.
    pub fn named(word: &str) -> Option<TorqueSide> {
        Self::ALL.into_iter().find(|(name, _)| *name == word).map(|(_, side)| side)
    }
}

/// One motion without a break: samples in the order of time.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// As the `run` column has it, else the file.
    pub name: String,
    /// s.
    pub t: Vec<f64>,
    /// Of each signal that there is, each joint's samples.
    pub signals: BTreeMap<Signal, Vec<Vec<f64>>>,
    /// As the column `payload` has it.
    pub payload: Option<String>,
    /// Where the arm touches something: such samples are left out of every fit.
    pub contact: Vec<bool>,
    /// What was seen of its clock.
    pub clock: Clock,
}

/// A log as it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Log {
    /// As they were named.
    pub files: Vec<String>,
    /// Samples that were read.
    pub samples: usize,
    /// The runs.
    pub runs: Vec<Run>,
    /// As the file says.
    pub side: Option<TorqueSide>,
    /// Rows that were left out, of each why.
    pub damaged: Vec<Damaged>,
    /// Columns that nothing reads.
    pub unknown: Vec<String>,
}

/// A row that could not be read.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Damaged {
    /// The file.
    pub file: String,
    /// What its rows are called: `line`, `row`, `message`.
    pub row: &'static str,
    /// Which of them it is, from 1.
    pub line: u64,
    /// `found 20 cells, expected 13`.
    pub reason: String,
}

/// Why a log cannot be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the message beside each variant and field says what it is")]
pub enum LogError {
    #[error("{file}: found no header, expected a row of names: t[s], q1[rad] …, tau1[N*m] …")]
    NoHeader { file: String },
    #[error(
        "{file}: {at}: found no column `{missing}`, expected it beside `{beside}`: the arm has \
         {joints} joints{}",
        suggestion.as_ref().map_or_else(String::new, |s| format!("; did you mean `{s}`?"))
    )]
    Missing {
        file: String,
        at: String,
        missing: Box<str>,
        beside: Box<str>,
        joints: usize,
        suggestion: Option<String>,
    },
    #[error("{file}: {at}: found `{found}`, expected joints 1 to {joints}: the arm has no other")]
    Beyond { file: String, at: String, found: String, joints: usize },
    #[error(
        "{file}: {at}: found joint values alone, expected beside them tau1 … or i1 … (what \
         drives the joints) or q_cmd1 … (where they were to be)"
    )]
    NothingLogged { file: String, at: String },
    #[error(
        "{file}: {at}, column {column}: found the unit `{unit}` of `{name}`, expected one of {known}"
    )]
    Unit {
        file: String,
        at: String,
        column: usize,
        name: String,
        unit: Box<str>,
        known: &'static str,
    },
    #[error("{file}: {at}, columns {first} and {second}: found `{name}` twice, expected it once")]
    Twice { file: String, at: String, first: usize, second: usize, name: String },
    #[error(
        "{file}: found no row that can be read, expected rows of {cells} numbers below the header{}",
        first.as_ref().map_or_else(String::new, |d| format!(": {} {}: {}", d.row, d.line, d.reason))
    )]
    NoRows { file: String, cells: usize, first: Option<Damaged> },
    #[error(
        "{file}: {at}: found `torque_side = {found}`, expected motor, link, current, commanded or external"
    )]
    Side { file: String, at: String, found: String },
    #[error(
        "{file}: found {found}, expected what {first} has: the files of one log have the same columns and the same torque_side"
    )]
    Unlike { file: String, found: String, first: String },
    #[error("{file}: {message}")]
    Unreadable { file: String, message: String },
    #[error(
        "{file}: found {kind}, expected text: this build of stiffarm reads no other, and one with the \
         feature `{feature}` does: cargo install --path cli --features {feature}"
    )]
    NotBuilt { file: String, kind: &'static str, feature: &'static str },
    #[error(
        "{file}: found the arm's joints in {topics}, expected them in one topic: say which with --topic"
    )]
    Topics { file: String, topics: String },
    #[error(
        "{file}: found no joint states{}, expected messages of sensor_msgs/JointState or \
         control_msgs/JointTrajectoryControllerState in the topic",
        if topics.is_empty() { String::new() } else { format!(" (there are {topics})") }
    )]
    NoTopic { file: String, topics: String },
    #[error("{map}: {message}")]
    Map { map: String, message: String },
    #[error("{map}: found no column `{column}` in {file}, expected the one that is {ours}")]
    NoColumn { map: String, file: String, column: String, ours: String },
}

#[cfg(any(feature = "mcap", feature = "parquet", feature = "rosbag2"))]
impl LogError {
    /// A file that is none of its kind.
    fn unreadable(file: &str, kind: &str, error: impl std::fmt::Display) -> LogError {
        let message = format!("as {kind} it cannot be read: {error}");
        LogError::Unreadable { file: file.to_owned(), message }
    }
}

impl Log {
    /// Reads one file: its name for messages, its bytes; `motions` are those of the arm's joints.
    ///
    /// # Errors
    /// [`LogError`]: what is wrong with its header, or that none of its rows can be read.
    pub fn from_bytes(
        file: &str,
        bytes: &[u8],
        motions: &[Motion],
        names: &Names,
    ) -> Result<Log, LogError> {
        text::read(file, bytes, motions, names)
    }

    /// With the runs of another file.
    ///
    /// # Errors
    /// [`LogError::Unlike`]: it has other signals, or another torque side.
    pub fn and(mut self, other: Log) -> Result<Log, LogError> {
        let signals = |log: &Log| -> Vec<&'static str> {
            log.runs.iter().take(1).flat_map(|r| r.signals.keys().map(|s| s.name())).collect()
        };
        let (mine, others) = (signals(&self), signals(&other));
        if mine != others || self.side != other.side {
            let side = |log: &Log| format!("{:?}", log.side).to_lowercase();
            let found = match mine == others {
                true => format!("torque side {}", side(&other)),
                false => format!("columns of {}", others.join(", ")),
            };
            let (file, first) = (other.files.concat(), self.files.concat());
            return Err(LogError::Unlike { file, found, first });
        }
        self.files.extend(other.files);
        self.samples += other.samples;
        self.runs.extend(other.runs);
        self.damaged.extend(other.damaged);
        Ok(self)
    }

    /// The usual step of all runs, s.
    pub fn period(&self) -> f64 {
        let mut periods: Vec<f64> = self.runs.iter().map(|run| run.clock.period).collect();
        periods.retain(|period| *period > 0.0);
        periods.sort_by(f64::total_cmp);
        periods.get(periods.len() / 2).copied().unwrap_or(1.0)
    }

    /// Whether it has this signal.
    pub fn has(&self, signal: Signal) -> bool {
        self.runs.iter().all(|run| run.signals.contains_key(&signal))
    }

    /// What may mean otherwise than it says on this arm: a sentence each.
    pub fn doubts(&self, arm: &Arm) -> Vec<String> {
        let runs = |joint: usize| self.runs.iter().map(move |run| &run.signals[&Signal::Q][joint]);
        let readings = |joint: usize| runs(joint).flatten().copied();
        beyond(arm, &self.files.join(", "), readings).into_iter().collect()
    }

    /// What is to be said of its rows and its clock: a sentence each.
    pub fn remarks(&self) -> Vec<String> {
        let mut said = Vec::new();
        if let Some(first) = self.damaged.first() {
            let lines: Vec<String> =
                self.damaged.iter().take(8).map(|d| d.line.to_string()).collect();
            let more = self.damaged.len().saturating_sub(lines.len());
            let more = if more > 0 { format!(" and {more} more") } else { String::new() };
            said.push(format!(
                "{}: {} of {} rows are damaged and left out: {row} {}{more}; {row} {}: {}",
                first.file,
                self.damaged.len(),
                self.damaged.len() + self.samples,
                lines.join(", "),
                first.line,
                first.reason,
                row = first.row,
            ));
        }
        if !self.unknown.is_empty() {
            let named: Vec<&str> = self.unknown.iter().take(8).map(String::as_str).collect();
            let more = match self.unknown.len() - named.len() {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            said.push(format!("nothing reads {}{more}", named.join(", ")));
        }
        said.extend(clock::remarks(&self.runs));
        said
    }
}
