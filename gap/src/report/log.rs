//! What is reported of a log, in SI.

use serde::{Deserialize, Serialize};

use super::Word;
pub use super::{CannotSee, Finding};
use crate::log::{Domain, TorqueSide};
use crate::shrink::Shrink;

/// The diagnosis of a log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
    #[serde(default, skip_serializing_if = "Option::is_none")]
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
    /// These parameters; of torques where the links are co-estimated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rigid: Option<RigidLinks>,
    /// The gap of each joint.
    pub gap: Vec<JointGap>,
    /// Of all joints, from the gap before to that with all findings.
    pub shrink: Shrink,
    /// In the order in which they were added.
    pub findings: Vec<Finding>,
    /// What this log cannot show, and why.
    pub cannot_see: Vec<CannotSee>,
    /// What no effect that was tried explains.
    pub unexplained: Unexplained,
    /// What was noticed of rows and clocks.
    pub remarks: Vec<String>,
}

/// The rigid links as they are fitted beside the findings, by their base parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RigidLinks {
    /// Base to tip.
    pub parameters: Vec<BaseValue>,
    /// Covariance of the parameters in the order above, in the products of their units; zero where the motion does not
    /// determine one. Empty of more than [`MOST_COVARIANCES`](RigidLinks::MOST_COVARIANCES) parameters.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub covariance: Vec<Vec<f64>>,
}

impl RigidLinks {
    /// Parameters of which the covariance is reported: those of an arm of eight joints.
    pub const MOST_COVARIANCES: usize = 60;
}

/// A sum of moments of mass, the finest that the torques of any motion determine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BaseValue {
    /// The sum: `mx2 + 0.4318 m3`.
    pub name: String,
    /// Its parts.
    pub sum: Vec<Moment>,
    /// As it is fitted.
    pub value: f64,
    /// `kg`, `kg·m` or `kg·m²`.
    pub unit: Word,
    /// `None` where this motion does not determine it: it is not fitted then, and its value is zero.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ci95: Option<[f64; 2]>,
    /// The same sum of the robot file's moments.
    pub in_file: f64,
}

/// A part of a base parameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Moment {
    /// Which moment of mass, with the number of its link: `m`, `mx`, `my`, `mz`, or `xx`, `xy`, `yy`, `xz`, `yz`, `zz` of
    /// the inertia tensor about the origin of the row's frame.
    pub moment: String,
    /// How many times.
    pub times: f64,
}

/// How the samples were filtered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
    pub held_out_by: Word,
    /// How often.
    pub folds: usize,
}

/// The gap of one joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointGap {
    /// `N·m`, `N`, `A`, `rad` or `m`.
    pub unit: Word,
    /// Standard deviation of its torque, or root mean square of its position error.
    pub size: f64,
    /// Root mean square of what is left without any finding, on time that no fit has seen.
    pub before: f64,
    /// The same with the findings.
    pub after: f64,
    /// The same with what a search finds that has not seen that time either, where that was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nested: Option<f64>,
}

/// What is left beyond accident.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Unexplained {
    /// Whether there is any.
    pub present: bool,
    /// On what it depends; the largest share first.
    pub depends_on: Vec<Dependence>,
}

/// What is left of a joint as far as it depends on something.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
