//! This diagnosis against an earlier one of the same arm, in JSON: what came, what went, what changed.

use std::path::Path;

use serde::{Deserialize, Serialize};
use stiffarm_gap::Diagnosis;
use stiffarm_gap::diagnose::{Finding, Shrink};

use super::provenance::Hashes;
use crate::input::source;
use crate::terminal::failure::Failure;

/// What is read of the earlier diagnosis.
#[derive(Deserialize)]
struct Last {
    robot: String,
    gap: LastGap,
    findings: Vec<LastFinding>,
    data_sha256: Option<String>,
    robot_sha256: Option<String>,
}

#[derive(Deserialize)]
struct LastGap {
    shrink: Reached,
}

/// The gap on rows that no fit has seen, m (rad without positions).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reached {
    /// Root mean square without findings.
    pub before: f64,
    /// With them.
    pub after: f64,
    /// 95 % interval of `1 − after/before`.
    #[serde(rename = "shrink_ci95")]
    pub shrink: [f64; 2],
}

#[derive(Deserialize)]
struct LastFinding {
    effect: String,
    place: String,
    parameters: Vec<LastParameter>,
}

#[derive(Deserialize)]
struct LastParameter {
    name: String,
    value: f64,
    unit: String,
    ci95: [f64; 2],
}

/// What is different.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Compared {
    /// The earlier diagnosis.
    pub file: String,
    /// Whether both are of the same measurements; `None` where the earlier one does not say.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub same_data: Option<bool>,
    /// Whether both begin from the same robot file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub same_robot: Option<bool>,
    /// Then.
    pub last: Reached,
    /// Now.
    pub now: Reached,
    /// Effects and places that only this one has.
    pub came: Vec<(String, String)>,
    /// Those that only the earlier one has.
    pub went: Vec<(String, String)>,
    /// The numbers of what both have.
    pub numbers: Vec<Number>,
}

/// A number that both have.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Number {
    pub effect: String,
    pub place: String,
    pub name: String,
    pub unit: &'static str,
    /// Value then and now.
    pub values: [f64; 2],
    /// Their 95 % intervals.
    pub ci95: [[f64; 2]; 2],
    /// Whether the difference of two independent numbers with these intervals is told from zero.
    pub changed: bool,
}

impl Compared {
    /// Compares with the diagnosis in `file`.
    ///
    /// # Errors
    /// [`Failure`]: it cannot be read, is no diagnosis, or one of another robot.
    pub fn with(file: &Path, found: &Diagnosis, now: &Hashes) -> Result<Compared, Failure> {
        let text = source::text(file)?;
        let name = file.display().to_string();
        let last: Last = serde_json::from_str(&text).map_err(|error| {
            Failure::with_help(
                format!("{name}: {error}: expected a diagnosis (JSON)"),
                "write one with stiffarm diagnose … --json",
            )
        })?;
        if last.robot != found.robot {
            return Err(Failure::new(format!(
                "{name}: found a diagnosis of `{}`, expected one of `{}`",
                last.robot, found.robot
            )));
        }
        let known = |effect: &str, place: &str| {
            last.findings.iter().find(|l| l.effect == effect && l.place == place)
        };
        let has = |l: &&LastFinding| {
            found.findings.iter().any(|f| f.effect == l.effect && f.place == l.place)
        };
        let came = found.findings.iter().filter(|f| known(f.effect, &f.place).is_none());
        let went = last.findings.iter().filter(|l| !has(l));
        let numbers = found.findings.iter().filter_map(|f| Some((f, known(f.effect, &f.place)?)));
        Ok(Compared {
            same_data: last.data_sha256.map(|hash| hash == now.data_sha256),
            same_robot: last.robot_sha256.map(|hash| hash == now.robot_sha256),
            last: last.gap.shrink,
            now: Reached::from(&found.gap.shrink),
            came: came.map(|f| (f.effect.to_owned(), f.place.clone())).collect(),
            went: went.map(|l| (l.effect.clone(), l.place.clone())).collect(),
            numbers: numbers.flat_map(|(now, last)| numbers_of(last, now)).collect(),
            file: name,
        })
    }
}

/// The numbers of the same name and unit.
fn numbers_of(last: &LastFinding, now: &Finding) -> Vec<Number> {
    let both = now.parameters.iter().filter_map(|p| {
        let then = last.parameters.iter().find(|l| l.name == p.name && l.unit == p.unit)?;
        Some((then, p))
    });
    let each = both.map(|(then, p)| Number {
        effect: now.effect.to_owned(),
        place: now.place.clone(),
        name: p.name.clone(),
        unit: p.unit,
        values: [then.value, p.value],
        ci95: [then.ci95, p.ci95],
        changed: (p.value - then.value).abs() > half(then.ci95).hypot(half(p.ci95)),
    });
    each.collect()
}

/// Half the width of an interval.
fn half([low, high]: [f64; 2]) -> f64 {
    0.5 * (high - low)
}

impl From<&Shrink> for Reached {
    fn from(shrink: &Shrink) -> Reached {
        Reached { before: shrink.before, after: shrink.after, shrink: shrink.shrink_ci95 }
    }
}

impl Reached {
    /// 95 % interval of the gap with the findings.
    pub fn interval(&self) -> [f64; 2] {
        let [low, high] = self.shrink;
        [self.before * (1.0 - high), self.before * (1.0 - low)]
    }
}
