//! The result of the withheld check, as it is written.

use serde::Serialize;

use super::Kind;
use super::verdict::Verdict;
use crate::report::Finding;

/// The result.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The version that made it.
    pub stiffarm: String,
    /// The robot's name.
    pub robot: String,
    /// What the rows are called.
    pub design: String,
    /// Number of rows.
    pub measurements: usize,
    /// Number of poses.
    pub poses: usize,
    /// Standard deviation of each measured coordinate, m.
    pub noise_position: f64,
    /// Of each measured rotation, rad.
    pub noise_rotation: f64,
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
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shrink: Option<Shrunk>,
    /// Of single effects: what was named first how often, most frequent first.
    pub confusion: Vec<Confusion>,
    /// Effects that were to be put in and show nothing on this design at any place.
    pub cannot_plant: Vec<&'static str>,
    /// Diagnoses that ended with an error; they count as cases without findings.
    pub failed: usize,
    /// Every case.
    pub cases: Vec<Case>,
}

/// An effect at a place.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Named {
    /// Identifier of the effect.
    pub effect: String,
    /// Where.
    pub place: String,
}

impl Named {
    pub(super) fn new(effect: impl ToString, place: &impl ToString) -> Named {
        Named { effect: effect.to_string(), place: place.to_string() }
    }

    /// A finding, and what the data do not distinguish from it.
    pub(in crate::withhold) fn set(finding: &Finding) -> Vec<Named> {
        let others = finding.indistinguishable().map(|a| Named::new(&a.effect, &a.place));
        core::iter::once(Named::new(&finding.effect, &finding.place)).chain(others).collect()
    }
}

/// How often.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
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

    fn count(hits: usize, of: usize) -> Rate {
        if of == 0 {
            return Rate::default();
        }
        const Z: f64 = 1.959_963_984_540_054;
        let (n, p) = (of as f64, hits as f64 / of as f64);
        let middle = p + Z * Z / (2.0 * n);
        let half = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
        let end = |x: f64| (x / (1.0 + Z * Z / n)).clamp(0.0, 1.0);
        Rate { hits, of, rate: Some(p), ci95: Some([end(middle - half), end(middle + half)]) }
    }
}

/// Cases with one effect.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
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
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Pairs {
    /// Each was in the set of a finding of its own.
    pub both_in_sets: Rate,
}

/// Cases whose effect the diagnosis does not know.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
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
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct After {
    /// The held-out gap is at most 1.2 times the noise.
    pub within_1_2_of_noise: Rate,
    /// Median of the held-out gap in multiples of the noise.
    pub median: Option<f64>,
}

/// Predicted against real.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Shrunk {
    /// The real shrink lay in the predicted 95 % interval; of cases with one effect and one
    /// finding.
    pub inside: Rate,
    /// Median of real minus predicted.
    pub median_off: f64,
}

/// How often an effect was taken for another.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Confusion {
    /// What was put in.
    pub truth: &'static str,
    /// What was named first; `null` if nothing was.
    pub named: Option<String>,
    /// Whether the place was right too.
    pub at_its_place: bool,
    /// So often.
    pub cases: usize,
}

/// One case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Case {
    /// What kind of case.
    pub kind: Kind,
    /// What was put in, as `stiffarm simulate --effect` takes it.
    pub truths: Vec<String>,
    /// The same without sizes.
    pub labels: Vec<Named>,
    /// Each effect's gap in multiples of the noise.
    pub multiples: Vec<f64>,
    /// What the diagnosis said.
    pub verdict: Option<Verdict>,
    /// Why it said nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// Held-out gap with the findings in multiples of the noise.
    pub after: Option<f64>,
    /// How far the gap shrank at poses never met.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub realised: Option<f64>,
}
