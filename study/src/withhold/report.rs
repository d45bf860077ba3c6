//! The result of the withheld check, as it is written.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, Normal};

use super::Kind;
use crate::report::Finding;

/// The result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The version that made it.
    pub stiffarm: String,
    /// The robot's name.
    pub robot: String,
    /// What is measured, and how well.
    #[serde(flatten)]
    pub experiment: Facts,
    /// Sizes that were drawn: an effect's gap in multiples of the noise.
    pub multiple: [f64; 2],
    /// Decides everything.
    pub seed: u64,
    /// Cases without an effect in which the diagnosis found one.
    pub false_alarms: Rate,
    /// Cases without an effect in which it found something unexplained.
    pub false_unexplained: Rate,
    /// Cases with one effect.
    pub single: Single,
    /// Cases with two.
    pub pairs: Pairs,
    /// Cases whose effect the diagnosis does not know.
    pub removed: Removed,
    /// What is left after the findings, where the diagnosis knows the effects.
    pub after: After,
    /// How far the gap shrank at poses never met, where that could be said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shrink: Option<Shrunk>,
    /// Of single effects: what was named first how often, most frequent first.
    pub confusion: Vec<Confusion>,
    /// Effects that were to be put in and show nothing on this design at any place.
    pub cannot_plant: Vec<String>,
    /// Diagnoses that ended with an error; they count as cases without findings.
    pub failed: usize,
    /// Every case.
    pub cases: Vec<Case>,
}

/// What is measured, and how well.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Facts {
    /// An arm at rest.
    Campaign {
        /// What the rows are called.
        design: String,
        /// Number of rows.
        measurements: usize,
        /// Number of poses.
        poses: usize,
        /// Standard deviation of each measured coordinate, m.
        noise_position: f64,
        /// Of each measured rotation, rad.
        noise_rotation: f64,
    },
    /// An arm in motion.
    Log {
        /// How long it was moved, s.
        duration: f64,
        /// Number of runs.
        runs: usize,
        /// Samples a second.
        rate: f64,
        /// Standard deviation of the torques' noise, as a part of their spread.
        noise_torque: f64,
        /// Of a reading, rad or m.
        noise_reading: f64,
    },
}

/// An effect at a place.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Named {
    /// Identifier of the effect.
    pub effect: String,
    /// Where.
    pub place: String,
}

impl Named {
    /// Of an identifier and a place.
    pub fn new(effect: impl ToString, place: &impl ToString) -> Named {
        Named { effect: effect.to_string(), place: place.to_string() }
    }

    /// A finding, and what the data do not distinguish from it.
    pub(super) fn set(finding: &Finding) -> Vec<Named> {
        let others = finding.indistinguishable().map(|a| Named::new(&a.effect, &a.place));
        core::iter::once(Named::new(&finding.effect, &finding.place)).chain(others).collect()
    }
}

/// How often.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rate {
    /// So often.
    pub hits: usize,
    /// Out of so many.
    pub of: usize,
    /// The quotient; `null` of none.
    pub rate: Option<f64>,
    /// 95 % interval of what it would be in many cases (Wilson).
    pub ci95: Option<[f64; 2]>,
}

impl Rate {
    /// Of yes and no.
    pub fn of(answers: impl IntoIterator<Item = bool>) -> Rate {
        let (mut hits, mut of) = (0, 0);
        for answer in answers {
            of += 1;
            hits += usize::from(answer);
        }
        Rate::count(hits, of)
    }

    /// Of several together.
    pub fn pooled(rates: impl IntoIterator<Item = Rate>) -> Rate {
        let sum = |(hits, of), rate: Rate| (hits + rate.hits, of + rate.of);
        let (hits, of) = rates.into_iter().fold((0, 0), sum);
        Rate::count(hits, of)
    }

    /// So many hits of so many.
    pub fn count(hits: usize, of: usize) -> Rate {
        if of == 0 {
            return Rate::default();
        }
        let z = Normal::standard().inverse_cdf(0.975);
        let (n, p) = (of as f64, hits as f64 / of as f64);
        let middle = p + z * z / (2.0 * n);
        let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
        let end = |x: f64| (x / (1.0 + z * z / n)).clamp(0.0, 1.0);
        Rate { hits, of, rate: Some(p), ci95: Some([end(middle - half), end(middle + half)]) }
    }
}

/// Cases with one effect.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Single {
    /// The effect and its place were the first finding.
    pub first_named: Rate,
    /// They were in the first finding's set: it, or an alternative that the data does not tell from
    /// it.
    pub in_set: Rate,
    /// Mean size of the first finding's set.
    pub mean_set_size: Option<f64>,
    /// There were findings beyond the first.
    pub more_than_one: Rate,
}

/// Cases with two effects.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pairs {
    /// Each was in the set of a finding of its own.
    pub both_in_sets: Rate,
}

/// Cases whose effect the diagnosis does not know.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Removed {
    /// Something was unexplained.
    pub flagged: Rate,
    /// The same, of those in which what the diagnosis knows does not close the gap all the same
    /// (to 1.2 times the noise, held out): there is then nothing to be flagged.
    pub flagged_of_open: Rate,
    /// Of those flagged, and with a place at a joint, link, base or tool: it lies first at that
    /// joint. A link's end and the next joint's axis are one place in the standard convention.
    pub right_joint: Rate,
}

/// What is left after the findings.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct After {
    /// The held-out gap is at most 1.2 times the noise.
    pub within_1_2_of_noise: Rate,
    /// Median of the held-out gap in multiples of the noise.
    pub median: Option<f64>,
}

/// Predicted against real.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shrunk {
    /// The real shrink lay in the predicted 95 % interval; of cases with one effect and one
    /// finding.
    pub inside: Rate,
    /// Median of real minus predicted.
    pub median_off: f64,
}

/// How often an effect was taken for another.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Confusion {
    /// What was put in.
    pub truth: String,
    /// What was named first; `null` if nothing was.
    pub named: Option<String>,
    /// Whether the place was right too.
    pub at_its_place: bool,
    /// So often.
    pub cases: usize,
}

/// What a diagnosis says, as far as it is compared with the truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Of each finding, in the order in which they were added: itself, then the alternatives that
    /// the data cannot tell from it.
    pub sets: Vec<Vec<Named>>,
    /// Whether something is left that no effect explains.
    pub unexplained: bool,
    /// Where that lies, largest share first.
    pub unexplained_places: Vec<String>,
    /// What is left with the findings.
    #[serde(flatten)]
    pub residual: Residual,
}

/// What is left with the findings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Residual {
    /// Of a campaign.
    Campaign {
        /// The held-out gap: position rms, m.
        after_position: f64,
        /// The same in rotation, rad.
        after_rotation: f64,
        /// How far the gap is predicted to shrink, with its 95 % interval: of a lone finding.
        shrink: Option<[f64; 3]>,
    },
    /// Of a log.
    Log {
        /// As a part of the joints' spreads: their mean.
        left: f64,
        /// Of each joint, N·m (N) or rad (m).
        after: Vec<f64>,
    },
}

/// One case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Case {
    /// What kind of case.
    pub kind: Kind,
    /// What was put in, as `stiffarm simulate --effect` takes it.
    pub truths: Vec<String>,
    /// The same without sizes.
    pub labels: Vec<Named>,
    /// Each effect's size in multiples of the noise.
    pub multiples: Vec<f64>,
    /// What the diagnosis said.
    pub verdict: Option<Verdict>,
    /// Of an effect in a log that the diagnosis does not know: what it said of the same log without
    /// the effect.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub without: Option<Verdict>,
    /// Why it said nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// Held-out gap of a campaign with the findings in multiples of the noise.
    pub after: Option<f64>,
    /// How far the gap shrank at poses never met.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub realised: Option<f64>,
}

/// Up to this many times the noise a gap counts as closed.
pub(super) const CLOSED: f64 = 1.2;

impl Case {
    /// What was found: each finding with what the data cannot tell from it.
    pub fn sets(&self) -> &[Vec<Named>] {
        self.verdict.as_ref().map_or(&[], |verdict| &verdict.sets)
    }

    /// The first finding.
    pub fn first(&self) -> Option<&Named> {
        self.sets().first()?.first()
    }

    /// Whether a lone effect and its place were named first.
    pub fn is_right(&self) -> bool {
        self.first() == self.labels.first()
    }

    /// Whether a lone effect is in the first finding's set.
    pub(super) fn in_first_set(&self) -> bool {
        let set = self.sets().first().zip(self.labels.first());
        set.is_some_and(|(set, truth)| set.contains(truth))
    }

    /// Whether each of two effects is in the set of a finding of its own.
    pub(super) fn both_in_sets(&self) -> bool {
        let [a, b] = self.labels.as_slice() else { return false };
        let sets = || self.sets().iter().enumerate();
        let apart = |(k, set): (usize, &Vec<Named>)| {
            set.contains(a) && sets().any(|(l, other)| k != l && other.contains(b))
        };
        sets().any(apart)
    }

    /// Whether something is left that no effect explains.
    pub fn is_unexplained(&self) -> bool {
        self.verdict.as_ref().is_some_and(|verdict| verdict.unexplained)
    }

    /// Whether the gap is closed to the noise.
    pub(super) fn is_closed(&self) -> bool {
        self.after.is_some_and(|after| after <= CLOSED)
    }

    /// Whether something of an effect that the diagnosis does not know is left to be reported: what
    /// it knows does not close the gap all the same.
    pub fn is_open(&self) -> bool {
        use Residual::Log;
        let with = self.verdict.as_ref().map(|verdict| &verdict.residual);
        let without = self.without.as_ref().map(|verdict| &verdict.residual);
        match (with, without) {
            (Some(Log { after, .. }), Some(Log { after: without, .. })) => {
                let mut pairs = after.iter().zip(without);
                self.is_unexplained() || pairs.any(|(after, without)| *after > CLOSED * without)
            }
            _ => self.is_unexplained() || !self.is_closed(),
        }
    }
}
