//! The result of the withheld check of logs, as it is written.

use serde::Serialize;

use super::LogPlan;
use crate::log::LogDiagnosis;
use crate::plant::motion::Law;
use crate::withhold::Kind;
use crate::withhold::report::{Confusion, Named, Rate, Single};
use crate::withhold::summary::{CLOSED, confusion};

/// The result.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LogReport {
    /// The version that made it.
    pub stiffarm: String,
    /// The robot's name.
    pub robot: String,
    /// How long it was moved, s.
    pub duration: f64,
    /// Number of runs.
    pub runs: usize,
    /// Samples a second.
    pub rate: f64,
    /// Standard deviation of the torques' noise, as a part of their spread.
    pub noise_torque: f64,
    /// Of a reading, rad or m.
    pub noise_reading: f64,
    /// Sizes that were drawn, in multiples of the noise.
    pub multiple: [f64; 2],
    /// Decides everything.
    pub seed: u64,
    /// Cases without an effect in which the diagnosis found one.
    pub false_alarms: Rate,
    /// Cases without an effect in which it found something unexplained.
    pub false_unexplained: Rate,
    /// Cases with one effect.
    pub single: Single,
    /// Cases whose effect the diagnosis does not know, in which it found something unexplained.
    pub removed_flagged: Rate,
    /// Of those in which what it knows does not do as well.
    pub removed_flagged_of_open: Rate,
    /// Of single effects: what was named first how often, most frequent first.
    pub confusion: Vec<Confusion>,
    /// Effects that were to be put in and show nothing in this motion at any place.
    pub cannot_plant: Vec<&'static str>,
    /// Diagnoses that ended with an error; they count as cases without findings.
    pub failed: usize,
    /// Every case.
    pub cases: Vec<LogCase>,
}

/// A diagnosis of a log, as far as it is held against the truth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LogVerdict {
    /// Of each finding itself, then what would do instead.
    pub sets: Vec<Vec<Named>>,
    /// Whether something is left that no effect explains.
    pub unexplained: bool,
    /// What is left, as a part of the joints' spreads: their mean.
    pub left: f64,
    /// Of each joint, N·m (N) or rad (m).
    pub after: Vec<f64>,
}

/// What was asked.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Asked {
    /// What kind of case.
    pub kind: Kind,
    /// What was put in, as `stiffarm simulate --effect` takes it.
    pub truth: Option<String>,
    /// The same without sizes.
    pub label: Option<Named>,
    /// Its size in multiples of the noise.
    pub multiple: Option<f64>,
}

/// One case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LogCase {
    /// What was asked.
    #[serde(flatten)]
    pub asked: Asked,
    /// What the diagnosis said.
    pub verdict: Option<LogVerdict>,
    /// Of an effect that it does not know: what it said of the same log without the effect.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub without: Option<LogVerdict>,
    /// Why it said nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
}

impl LogVerdict {
    /// Of a diagnosis.
    pub fn of(found: &LogDiagnosis) -> LogVerdict {
        let left = found.gap.iter().map(|g| g.after / g.size).sum::<f64>();
        LogVerdict {
            sets: found.findings.iter().map(Named::set).collect(),
            unexplained: found.unexplained.present,
            left: left / found.gap.len() as f64,
            after: found.gap.iter().map(|gap| gap.after).collect(),
        }
    }
}

impl LogCase {
    fn sets(&self) -> &[Vec<Named>] {
        self.verdict.as_ref().map_or(&[], |verdict| &verdict.sets)
    }

    fn first(&self) -> Option<&Named> {
        self.sets().first()?.first()
    }

    /// Whether the effect and its place were named first.
    pub fn is_right(&self) -> bool {
        self.first().is_some() && self.first() == self.asked.label.as_ref()
    }

    fn in_first_set(&self) -> bool {
        let set = self.sets().first().zip(self.asked.label.as_ref());
        set.is_some_and(|(set, truth)| set.contains(truth))
    }

    fn is_unexplained(&self) -> bool {
        self.verdict.as_ref().is_some_and(|verdict| verdict.unexplained)
    }

    /// Whether something of an effect that the diagnosis does not know is left to be told: as much as it takes
    /// for a gap of a campaign to be open.
    pub fn is_open(&self) -> bool {
        let Some((verdict, without)) = self.verdict.as_ref().zip(self.without.as_ref()) else {
            return true;
        };
        let mut pairs = verdict.after.iter().zip(&without.after);
        self.is_unexplained() || pairs.any(|(after, without)| *after > CLOSED * without)
    }
}

impl LogReport {
    /// Of some cases; `hidden` are the effects that do not show.
    pub(super) fn of(plan: &LogPlan<'_>, cases: Vec<LogCase>, hidden: &[&'static Law]) -> Self {
        let of = |kind: Kind| cases.iter().filter(move |case| case.asked.kind == kind);
        let single = || of(Kind::Single);
        let sizes: Vec<usize> = single().filter_map(|c| Some(c.sets().first()?.len())).collect();
        let mean = sizes.iter().sum::<usize>() as f64 / sizes.len() as f64;
        let named = single().filter_map(|case| {
            let label = case.asked.label.as_ref()?;
            let law = plan.effects.iter().find(|law| law.name == label.effect)?;
            Some((law.name, label, case.first()))
        });
        LogReport {
            stiffarm: plan.options.version.clone(),
            robot: plan.arm.name.clone(),
            duration: plan.stages.iter().map(|stage| stage.course.duration()).sum(),
            runs: plan.stages.len(),
            rate: plan.recording.rate,
            noise_torque: plan.recording.torque,
            noise_reading: plan.recording.reading,
            multiple: plan.multiple,
            seed: plan.seed,
            false_alarms: Rate::of(of(Kind::None).map(|case| !case.sets().is_empty())),
            false_unexplained: Rate::of(of(Kind::None).map(LogCase::is_unexplained)),
            single: Single {
                first_named: Rate::of(single().map(LogCase::is_right)),
                in_set: Rate::of(single().map(LogCase::in_first_set)),
                mean_set_size: (!sizes.is_empty()).then_some(mean),
                more_than_one: Rate::of(single().map(|case| case.sets().len() > 1)),
            },
            removed_flagged: Rate::of(of(Kind::Removed).map(LogCase::is_unexplained)),
            removed_flagged_of_open: Rate::of(
                of(Kind::Removed).filter(|case| case.is_open()).map(LogCase::is_unexplained),
            ),
            confusion: confusion(named),
            cannot_plant: hidden.iter().map(|law| law.name).collect(),
            failed: cases.iter().filter(|case| case.verdict.is_none()).count(),
            cases,
        }
    }
}
