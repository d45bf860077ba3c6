//! What is reported of a campaign.

use serde::{Deserialize, Serialize};

pub use super::{CannotSee, Finding};
use super::{Parameter, Word};
use crate::gap::Statistics;
use crate::measurement::Row;
use crate::shrink::Shrink;

/// A part of a range within which a value beyond it still counts as inside.
pub(crate) const EDGE: f64 = 1e-6;

/// The result of a diagnosis. Serialised, it is the format's JSON; every number is finite.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Diagnosis {
    /// The version that made it.
    pub stiffarm: String,
    /// The robot's name.
    pub robot: String,
    /// Number of rows.
    pub measurements: usize,
    /// How measurements were held out.
    pub held_out: HeldOut,
    /// The gap before and after, and the noise.
    pub gap: GapReport,
    /// What is wrong with the file or the readings: all else is told without it. `None` if nothing is known to
    /// be.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mistaken: Option<Mistaken>,
    /// Where the gap lies, largest share first.
    #[serde(rename = "where")]
    pub places: Vec<Share>,
    /// What explains it, in the order in which they were added.
    pub findings: Vec<Finding>,
    /// What this data could not have shown.
    pub cannot_see: Vec<CannotSee>,
    /// What is left.
    pub unexplained: Unexplained,
    /// What is left, row by row; `None` where there is nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub residual: Option<Residual>,
    /// How well the data tell the fitted numbers; `None` where none was fitted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub observability: Option<Observability>,
    /// Numbers of the geometry that this data sees only together with others.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub gauge: Vec<Gauge>,
    /// Rows that do not fit: neither fitted nor counted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<LeftOut>,
    /// The gap taken apart by what it goes with; empty where the data are too few.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<Part>,
    /// How large the gap is along each joint's range, by load, direction and time.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub by: Vec<Slice>,
    /// Frames that were fitted along, and are no findings.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub nuisances: Vec<NuisanceReport>,
    /// Things of the bench that were fitted along.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bench: Vec<BenchReport>,
    /// Points of the bench whose distance is known.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pairs: Vec<PairReport>,
    /// Whether zeros, lengths and twists of the table were fitted along, and are no finding.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub geometry_along: bool,
    /// Whether loads and gravity were taken to be told in the measuring frame's axes, −z down, since the data say so, and
    /// not in the arm's.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub hangs_as_measured: bool,
    /// Where the data has been: predictions elsewhere are extrapolation.
    pub covers: Cover,
    /// Other models' predictions against this one's; only if they were asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rivals: Option<Vec<Rival>>,
    /// Whether it was told to stop before the search was at its end: there may be more to be found.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub stopped: bool,
}

impl Diagnosis {
    /// What the gap before is that of.
    pub fn before_is(&self) -> &'static str {
        let is_mended = self.mistaken.as_ref().is_some_and(|wrong| !wrong.mistakes.is_empty());
        match (self.nuisances.is_empty(), self.geometry_along) {
            (true, false) if is_mended => "mistakes mended",
            (false, false) if is_mended => "mistakes mended, unknown frames fitted",
            (true, false) => "robot file as it is",
            (false, false) => "with unknown frames fitted",
            (true, true) => "with geometry fitted",
            (false, true) => "with frames and geometry fitted",
        }
    }
}

/// Mistakes of a robot file or of readings, and what the gap is without them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mistaken {
    /// One or two; none where the gap is no arm's and no mistake explains it: then no effect was looked for.
    pub mistakes: Vec<Wrong>,
    /// Other mistakes that these data do not distinguish from them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub same: Vec<Vec<Wrong>>,
    /// Root mean square of the positions' gap with them and without, frames, zeros and springs fitted to both, m.
    pub position: [f64; 2],
    /// The same of rotations, rad; 0 where none is measured.
    pub rotation: [f64; 2],
}

/// A mistake.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Wrong {
    /// `joint_sign`, `reading_coupling`, …
    pub kind: Word,
    /// Where it is.
    pub place: String,
    /// What is wrong.
    pub sentence: String,
    /// What is to be changed in the measurement file; empty where the robot file is to be.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub mending: String,
    /// Whether a corrected robot file is without it.
    pub in_robot_file: bool,
}

/// A number of the geometry that is one with others: only a sum of them is seen.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Gauge {
    /// `d of link 3`.
    pub parameter: String,
    /// `d of link 2`, …
    pub same_as: Vec<String>,
}

/// A row that does not fit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeftOut {
    /// Its line in the file.
    pub line: u64,
    /// Its session, where there are several: of several files its file, too.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub session: Option<String>,
    /// How far it is from what the model with the findings predicts, m; `None` where that model comes to
    /// no rest under its load.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position: Option<f64>,
    /// The same of its rotation, rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation: Option<f64>,
}

impl LeftOut {
    /// Whether it is this row.
    pub fn is(&self, row: &Row) -> bool {
        self.line == row.line && (self.session.is_none() || self.session == row.session)
    }
}

/// A part of the gap.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// With what it goes.
    pub part: Word,
    /// Share of the mean square (whitened, held out), beside the parts before it.
    pub share: f64,
}

/// The gap on some of the rows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Slice {
    /// Along what: `q2`, `load` (N), `s3`, `time` (s).
    pub of: String,
    /// Least value, SI.
    pub from: f64,
    /// Largest value.
    pub to: f64,
    /// Number of rows.
    pub rows: usize,
    /// Root mean square of the gap of the robot file as it is, m (rad without positions).
    pub before: f64,
    /// The same with the findings, held out.
    pub after: f64,
}

/// A frame that was fitted along.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NuisanceReport {
    /// `base_frame`, `tool_frame`, a marker's name, or that of a point from which distances are
    /// measured (`centre` without one).
    pub name: String,
    /// The session whose base or point it is, or the camera or board, where there are several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub session: Option<String>,
    /// Where it is: the base and a distance's point in the measuring frame, the tool in the last frame,
    /// the marker in the tool frame; m.
    pub translation: [f64; 3],
    /// Rotation vector, rad; 0 of a point.
    pub rotation: [f64; 3],
}

/// A thing of the bench that was fitted along.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BenchReport {
    /// `point`, `plane` or `centre` (from which distances are measured).
    pub kind: String,
    /// As the file calls it; may be empty.
    pub name: String,
    /// The session whose it is, where there are several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub session: Option<String>,
    /// Measuring frame, m. Of a plane the unit normal and the distance from the origin along it.
    pub constants: Vec<Parameter>,
}

/// Two points of the bench whose distance is known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PairReport {
    /// Their names.
    pub points: [String; 2],
    /// The known distance, m.
    pub known: f64,
    /// Its standard deviation, m.
    pub sigma: f64,
    /// The distance of the points as they were fitted, m.
    pub fitted: f64,
}

/// The range of the data.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cover {
    /// Least and largest reading of each joint, rad (m if prismatic).
    pub joints: Vec<[f64; 2]>,
    /// Largest force on the tool, N.
    pub force: f64,
    /// Largest moment on the tool, N·m.
    pub moment: f64,
}

impl Cover {
    /// Whether a row lies within the joint ranges and loads.
    pub fn holds(&self, row: &Row) -> bool {
        let in_range = |(q, [low, high]): (&f64, &[f64; 2])| {
            let edge = EDGE * (high - low) + f64::EPSILON;
            (low - edge..=high + edge).contains(q)
        };
        let load = |from: usize| row.wrench.fixed_rows::<3>(from).norm();
        row.q.iter().zip(&self.joints).all(in_range)
            && load(0) <= self.force * (1.0 + EDGE)
            && load(3) <= self.moment * (1.0 + EDGE)
    }
}

/// How measurements were held out.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct HeldOut {
    /// Number of folds.
    pub folds: usize,
    /// What never stands on both sides of a fold.
    pub grouped_by: Word,
}

/// What the model with all findings leaves, row by row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Residual {
    /// Whether it is normal; `None` of too few numbers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normality: Option<Normality>,
    /// Whether it lingers; `None` of too few numbers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub autocorrelation: Option<Autocorrelation>,
    /// The rows that are left with the largest gaps, largest first.
    pub worst: Vec<Worst>,
}

/// The shape of what is left, in units of the noise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Normality {
    /// The fourth moment over the square of the second, less 3: 0 of normal numbers, positive of
    /// heavy tails.
    pub excess_kurtosis: f64,
    /// The statistic of Anderson and Darling.
    pub anderson_darling: f64,
    /// How often normal numbers have one as large.
    pub p_value: f64,
    /// Where a number of its rank lies if they are normal, and where it does, both in standard
    /// deviations, ascending from the least to the largest; of many, some.
    pub quantiles: Vec<[f64; 2]>,
}

/// What is left at one visit beside what is left at the next.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Autocorrelation {
    /// Correlation, −1 to 1.
    pub lag_1: f64,
    /// How often one as large is chance.
    pub p_value: f64,
}

/// A row with a large gap.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Worst {
    /// Its line in the file.
    pub line: u64,
    /// Its pose, where the file names it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pose: Option<String>,
    /// Held-out gap without findings, m (rad without positions).
    pub before: f64,
    /// With all of them.
    pub after: f64,
}

/// How well the data tell the fitted numbers from each other, frames and effects together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Observability {
    /// Numbers that were fitted.
    pub parameters: usize,
    /// Directions of them that the data decide; the others stay where they are.
    pub decided: usize,
    /// Largest over least of their singular values.
    pub condition: f64,
    /// Of the columns, each scaled to length 1, largest first, of what is decided.
    pub singular_values: Vec<f64>,
    /// The pairs of numbers that are hardest to tell from each other, one of them of an effect beyond
    /// ordinary calibration; none that are correlated by less than one half.
    pub correlations: Vec<Correlation>,
    /// Correlations of the findings' numbers with each other, of the first of them.
    pub matrix: CorrelationMatrix,
}

/// Correlations of numbers with each other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CorrelationMatrix {
    /// What the rows and columns are.
    pub of: Vec<String>,
    /// Row by row, −1 to 1.
    pub rows: Vec<Vec<f64>>,
}

/// Two fitted numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Correlation {
    /// `compliance of joint_compliance at joint 2`.
    pub of: String,
    /// The other.
    pub with: String,
    /// −1 to 1.
    pub correlation: f64,
}

/// The gap before and after, and the noise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GapReport {
    /// Of the robot file as it is; with what is fitted along, each row by fits that have not seen it.
    pub before: Statistics,
    /// With the findings, each row by fits that have not seen it. Equal to `before` without
    /// findings.
    pub after: Statistics,
    /// From the one to the other.
    pub shrink: Shrink,
    /// What the model that is reported leaves on the rows that it was fitted to: what `--check` says of
    /// them, and a diagnosis of the robot file with the findings. Less than `after` by what a fit takes
    /// of the noise.
    pub fitted: Statistics,
    /// As `after`, the search run again for each fold on the others; only if it was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nested: Option<Statistics>,
    /// The same where each fold is a stretch of time: what a campaign tells of the next.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nested_in_time: Option<Statistics>,
    /// Of the measurement.
    pub noise: NoiseReport,
    /// What that is at the tool; of an instrument that does not read the tool's position, where something was found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_tool: Option<AtTool>,
}

/// The tool's error in the axes of the arm's base, by the model, at the postures and loads that were measured: root mean
/// squares, m.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AtTool {
    /// Without the findings: how far they move the tool, and what they are uncertain by.
    pub before: f64,
    /// With them: what they are uncertain by. What no finding explains is not in it.
    pub after: f64,
}

/// The noise of the measurement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NoiseReport {
    /// Root mean square of the norm over the measured translations, m.
    pub position_rms: f64,
    /// Root mean square of the norm over the measured rotations, rad.
    pub rotation_rms: f64,
    /// `repeats`, `columns` (the file's own standard deviations), `option` or `residual`: of the
    /// positions, or of the rotations if there are no positions.
    pub from: Word,
    /// The same of the positions, if there are any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position_from: Option<Word>,
    /// The same of the rotations.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation_from: Option<Word>,
    /// The part of the positions' noise that comes and goes with visits: the arm's repeatability,
    /// root mean square, m; only where poses were read more than once and visited again.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub visits_position_rms: Option<f64>,
    /// The same of the rotations, rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub visits_rotation_rms: Option<f64>,
}

/// What a place alone explains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Share {
    /// The place.
    pub place: String,
    /// Part of the mean square of the gap (whitened), held out, that the best single effect at this
    /// place takes away. Shares overlap: they do not add up to 1.
    pub share: f64,
}

/// What is left of the gap.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Unexplained {
    /// Whether it is more than noise, or still depends on something.
    pub present: bool,
    /// What is left beyond the noise, m; 0 if not present.
    pub position_rms: f64,
    /// Where it lies: what a free-form displacement at each place takes of the mean square of what
    /// is left, held out.
    #[serde(rename = "where")]
    pub places: Vec<Share>,
    /// On what it depends, most first.
    pub depends_on: Vec<String>,
}

/// Another model's predictions against this one's held-out ones.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rival {
    /// The prefix of its columns.
    pub name: String,
    /// Root mean square of measured minus its prediction, m (rad if it predicts no position).
    pub rms: f64,
    /// The same of this diagnosis' held-out predictions, on the same components.
    pub held_out_rms: f64,
    /// Mean over rows of the rival's squared residual minus ours, m² (rad²): positive is in our
    /// favour.
    pub mean_square_gain: f64,
    /// 95 % interval of it by resampling poses.
    pub ci95: [f64; 2],
    /// Whether the interval leaves out 0.
    pub significant: bool,
}
