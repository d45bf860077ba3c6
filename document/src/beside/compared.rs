//! This diagnosis against an earlier one of the same arm: what came, what went, what changed.

use serde::{Deserialize, Serialize};
use stiffarm_gap::report::{Diagnosis, Finding, Parameter, Word};
use stiffarm_gap::shrink::Shrink;

use super::provenance::Hashes;

/// An earlier diagnosis, and of what it was made where it says so.
#[derive(Deserialize)]
pub struct Last {
    /// What was found.
    #[serde(flatten)]
    pub report: Diagnosis,
    data_sha256: Option<String>,
    robot_sha256: Option<String>,
}

/// The gap on rows that no fit has seen, m (rad without positions).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Reached {
    /// Root mean square without findings.
    pub before: f64,
    /// With them.
    pub after: f64,
    /// 95 % interval of `1 − after/before`.
    #[serde(rename = "shrink_ci95")]
    pub shrink: [f64; 2],
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
    /// By this one.
    pub now: Reached,
    /// Effects and places that only this one has.
    pub added: Vec<(Word, String)>,
    /// Those that only the earlier one has.
    pub removed: Vec<(Word, String)>,
    /// The numbers of what both have.
    pub numbers: Vec<Number>,
}

/// A number that both have.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Number {
    /// Identifier of the effect.
    pub effect: Word,
    /// Where it acts.
    pub place: String,
    /// What the effect calls the number.
    pub name: Word,
    /// Its SI unit.
    pub unit: Word,
    /// Value then and now.
    pub values: [f64; 2],
    /// Their 95 % intervals.
    pub ci95: [[f64; 2]; 2],
    /// Whether the difference of two independent numbers with these intervals is told from zero.
    pub changed: bool,
}

impl Compared {
    /// Of what was `found` with the earlier diagnosis of the same arm that is in `file`.
    pub fn with(file: String, last: Last, found: &Diagnosis, now: &Hashes) -> Compared {
        let Last { report: last, data_sha256, robot_sha256 } = last;
        let [then, now_found] = [&last.findings, &found.findings];
        let in_both = now_found.iter().filter_map(|now| Some((same(then, now)?, now)));
        let only = |these: &[Finding], others: &[Finding]| {
            let only = these.iter().filter(|one| same(others, one).is_none());
            only.map(|one| (one.effect.clone(), one.place.clone())).collect()
        };
        Compared {
            file,
            same_data: data_sha256.map(|hash| hash == now.data_sha256),
            same_robot: robot_sha256.map(|hash| hash == now.robot_sha256),
            last: Reached::from(&last.gap.shrink),
            now: Reached::from(&found.gap.shrink),
            added: only(now_found, then),
            removed: only(then, now_found),
            numbers: in_both.flat_map(|(last, now)| numbers_of(last, now)).collect(),
        }
    }
}

/// The finding of the same effect at the same place.
fn same<'a>(among: &'a [Finding], one: &Finding) -> Option<&'a Finding> {
    among.iter().find(|other| other.is(&one.effect, &one.place))
}

/// The numbers of the same name and unit.
fn numbers_of(last: &Finding, now: &Finding) -> Vec<Number> {
    let both = now.parameters.iter().filter_map(|p| {
        let same = |l: &&Parameter| l.name == p.name && l.unit == p.unit;
        Some((last.parameters.iter().find(same)?, p))
    });
    let each = both.map(|(then, p)| Number {
        effect: now.effect.clone(),
        place: now.place.clone(),
        name: p.name.clone(),
        unit: p.unit.clone(),
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
