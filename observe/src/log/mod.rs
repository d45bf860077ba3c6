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
//! has. They are left out, counted, and told by line; a cell that other joints do without costs them nothing
//! (`holes`). What is wrong with the header is an error.

#[cfg(any(feature = "mcap", feature = "rosbag2"))]
mod cdr;
mod clock;
mod column;
mod format;
mod holes;
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
mod text;

use std::collections::BTreeMap;

pub use clock::Clock;
pub use column::Signal;
pub use format::{Format, Opened};
pub use holes::{GAP, Hole};
pub use names::Names;
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use crate::beyond;
use crate::infer::middle;
use crate::io::{Fault, ReadError, listed};

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

    /// As a file says it.
    fn said(word: &str) -> Result<TorqueSide, Fault> {
        TorqueSide::named(word).ok_or_else(|| {
            let expected = "motor, link, current, commanded or external";
            Fault::new(format!("`torque_side = {word}`"), expected, "")
        })
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
    /// Where what drives a joint is missing or at its limit: rows of that joint are left out, of no other.
    pub holes: Vec<Hole>,
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
    /// Columns that lack numbers in rows that were read.
    pub lacking: Vec<Lacking>,
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

/// A column that lacks numbers in rows that are read without them.
#[derive(Clone, Debug, PartialEq)]
pub struct Lacking {
    /// The file.
    pub file: String,
    /// What the column is: `tau3`.
    pub name: String,
    /// How many rows lack it.
    pub rows: usize,
    /// What its rows are called: `line`, `row`, `message`.
    pub row: &'static str,
    /// The first of them, from 1.
    pub line: u64,
    /// What stands there in place of a number.
    pub found: String,
}

/// Rows and columns that a remark names before the rest is counted.
const MOST_NAMED: usize = 8;

/// A file that is none of its kind.
#[cfg(any(feature = "mcap", feature = "parquet", feature = "rosbag2"))]
fn unreadable(file: &str, kind: &str, error: impl std::fmt::Display) -> ReadError {
    Fault::new("a file that cannot be read", kind, error.to_string()).of(file)
}

impl Log {
    /// Reads one file: its name for messages, its bytes; `motions` are those of the arm's joints.
    ///
    /// # Errors
    /// [`ReadError`]: what is wrong with its header, or that none of its rows can be read.
    pub fn from_bytes(
        file: &str,
        bytes: &[u8],
        motions: &[Motion],
        names: &Names,
    ) -> Result<Log, ReadError> {
        text::read(file, bytes, motions, names)
    }

    /// Reads the text of a log of this arm under our own names.
    ///
    /// # Errors
    /// As [`Log::from_bytes`].
    pub fn of_arm(arm: &Arm, file: &str, text: &str) -> Result<Log, ReadError> {
        let motions: Vec<Motion> = arm.joints.iter().map(|joint| joint.motion).collect();
        Log::from_bytes(file, text.as_bytes(), &motions, &Names::default())
    }

    /// With the runs of another file.
    ///
    /// # Errors
    /// [`ReadError`]: it has other signals, or another torque side.
    pub fn and(mut self, other: Log) -> Result<Log, ReadError> {
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
            let expected = format!("what {} has", self.files.concat());
            let help = "the files of one log have the same columns and the same torque_side";
            return Err(Fault::new(found, expected, help).of(&other.files.concat()));
        }
        self.files.extend(other.files);
        self.samples += other.samples;
        self.runs.extend(other.runs);
        self.damaged.extend(other.damaged);
        self.lacking.extend(other.lacking);
        Ok(self)
    }

    /// The usual step of all runs, s.
    pub fn period(&self) -> f64 {
        let periods = self.runs.iter().map(|run| run.clock.period);
        middle(periods.filter(|period| *period > 0.0)).unwrap_or(1.0)
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
            let lines: Vec<u64> = self.damaged.iter().map(|damaged| damaged.line).collect();
            said.push(format!(
                "{}: {} of {} rows are damaged and left out: {row} {}; {row} {}: {}",
                first.file,
                self.damaged.len(),
                self.damaged.len() + self.samples,
                listed(&lines, MOST_NAMED),
                first.line,
                first.reason,
                row = first.row,
            ));
        }
        said.extend(holes::remark(&self.lacking));
        if !self.unknown.is_empty() {
            said.push(format!("nothing reads {}", listed(&self.unknown, MOST_NAMED)));
        }
        said.extend(clock::remarks(&self.runs));
        said
    }
}
