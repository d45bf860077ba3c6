//! What a log says, as data: all in SI.

use serde::Serialize;

use super::read::TorqueSide;
use super::scene::Domain;
use crate::shrink::Shrink;

/// The diagnosis of a log.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LogDiagnosis {
    /// The version that wrote it.
    pub stiffarm: String,
    /// The robot's name.
    pub robot: String,
    /// The files of the log.
    pub files: Vec<String>,
    /// What the rows are.
    pub rows: Domain,
    /// Where the torque is measured; of torque rows only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_side: Option<TorqueSide>,
    /// Runs, samples as they were read, and those left out as damaged.
    pub runs: usize,
    /// See `runs`.
    pub samples: usize,
    /// See `runs`.
    pub damaged: usize,
    /// How the samples were filtered.
    pub filter: Filter,
    /// How much of it is independent, and how it was held out.
    pub evidence: Evidence,
    /// Base parameters of the rigid links, which are fitted along; 0 of position rows.
    pub rigid_parameters: usize,
    /// The gap of each joint.
    pub gap: Vec<JointGap>,
    /// Of all joints, from the gap before to that with all findings.
    pub shrink: Shrink,
    /// In the order in which they were added.
    pub findings: Vec<Finding>,
    /// What this log cannot show, and why.
    pub cannot_see: Vec<Hidden>,
    /// What no effect that was tried explains.
    pub unexplained: Unexplained,
    /// What was noticed of rows and clocks.
    pub remarks: Vec<String>,
}

/// How the samples were filtered.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Filter {
    /// The usual step of the log, s.
    pub period: f64,
    /// The band's edge, Hz.
    pub band: f64,
    /// Whether it was given; else it is where the joint values stand clear of their noise.
    pub band_given: bool,
    /// Speed of each joint below which its torque rows are left out, rad/s or m/s.
    pub standstill: Vec<f64>,
}

/// How much is independent.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Evidence {
    /// Of what is left in each joint, s.
    pub correlation_time: Vec<f64>,
    /// Rows that count, of all joints.
    pub rows: usize,
    /// Independent numbers among them.
    pub effective: f64,
    /// Blocks of time.
    pub blocks: usize,
    /// Their length, s.
    pub block_length: f64,
    /// Whether a block is at least five correlation times.
    pub long_enough: bool,
    /// What is held out at once: `run` or `block`.
    pub held_out_by: &'static str,
    /// How often.
    pub folds: usize,
}

/// The gap of one joint.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JointGap {
    /// `N·m`, `N`, `A`, `rad` or `m`.
    pub unit: &'static str,
    /// Standard deviation of its torque, or root mean square of its position error.
    pub size: f64,
    /// Root mean square of what is left without any finding, on time that no fit has seen.
    pub before: f64,
    /// The same with the findings.
    pub after: f64,
    /// The same with what a search finds that has not seen that time either, where that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nested: Option<f64>,
}

/// An effect at a place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Its identifier.
    pub effect: &'static str,
    /// Where.
    pub place: String,
    /// Its numbers.
    pub parameters: Vec<Parameter>,
    /// Mean of all joints' gap, as a part of their sizes, before it was added, on unseen time.
    pub held_out_before: f64,
    /// The same with it.
    pub held_out_after: f64,
    /// The chance that something unrelated does as well, beside all other findings.
    pub p_value: f64,
    /// What would do instead, as far as these blocks tell.
    pub alternatives: Vec<Alternative>,
    /// What to record for them to be told apart; `None` where nothing else would do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_separate: Option<&'static str>,
}

/// A number of an effect.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// In its unit.
    pub value: f64,
    /// SI.
    pub unit: String,
    /// 95 % of it.
    pub ci95: [f64; 2],
    /// The same number with the commanded motion as instrument, of torques where one is logged.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by_command: Option<f64>,
}

/// What would do instead of a finding.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Alternative {
    /// Its identifier.
    pub effect: &'static str,
    /// Where.
    pub place: String,
    /// What it leaves on unseen time, for each that the finding leaves.
    pub leaves: f64,
}

/// What cannot be seen.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Hidden {
    /// Its identifier.
    pub effect: &'static str,
    /// Where.
    pub place: String,
    /// Why.
    pub reason: String,
}

/// What is left beyond accident.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Unexplained {
    /// Whether there is any.
    pub present: bool,
    /// On what it depends; the largest share first.
    pub depends_on: Vec<Dependence>,
}

/// What is left of a joint as far as it depends on something.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Dependence {
    /// Where.
    pub place: String,
    /// On what: `angle`, `speed`, `acceleration`, `load`, `time`, or `speed of joint 2`.
    pub of: String,
    /// The part of the squares that are left which goes with it.
    pub share: f64,
    /// The chance that it is accident.
    pub p_value: f64,
}
