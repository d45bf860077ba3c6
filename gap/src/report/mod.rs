//! A diagnosis as it is written: one [`Report`] of a campaign at rest or of a log in motion.
//!
//! Field names and their order are those of the JSON format. What only one kind of observation has is a
//! variant `AtRest` or `InMotion`; the keys of the other kind are then absent.

pub mod campaign;
pub mod log;

use std::borrow::Cow;

use serde::{Deserialize, Deserializer, Serialize};

pub use campaign::Diagnosis;
pub use log::LogDiagnosis;

use crate::shrink::Shrink;

/// A word of the program, or one that was read.
pub type Word = Cow<'static, str>;

/// The result of a diagnosis. Serialised, it is the format's JSON; every number is finite.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Report {
    /// Of measurements at rest.
    Campaign(Box<Diagnosis>),
    /// Of a log of the arm in motion.
    Log(Box<LogDiagnosis>),
}

impl Report {
    /// The robot's name.
    pub fn robot(&self) -> &str {
        match self {
            Report::Campaign(found) => &found.robot,
            Report::Log(found) => &found.robot,
        }
    }

    /// What was found, in the order in which it was added.
    pub fn findings(&self) -> &[Finding] {
        match self {
            Report::Campaign(found) => &found.findings,
            Report::Log(found) => &found.findings,
        }
    }

    /// What this data could not have shown.
    pub fn cannot_see(&self) -> &[CannotSee] {
        match self {
            Report::Campaign(found) => &found.cannot_see,
            Report::Log(found) => &found.cannot_see,
        }
    }

    /// From the gap before to the gap with all findings, held out.
    pub fn shrink(&self) -> &Shrink {
        match self {
            Report::Campaign(found) => &found.gap.shrink,
            Report::Log(found) => &found.shrink,
        }
    }
}

/// A finding that removes less than this part of the held-out gap is shown in one line with others: it
/// decides what is shown first, never what is found.
pub const MATTERS: f64 = 0.02;

/// An effect at a place that explains the gap, or part of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Identifier of the effect.
    pub effect: Word,
    /// Where it acts.
    pub place: String,
    /// Its size, of the complete model.
    pub parameters: Vec<Parameter>,
    /// How far the gap shrinks.
    #[serde(flatten)]
    pub held_out: HeldOutGap,
    /// The part of the held-out gap before any finding that it removes; 0 in reports of versions that did not
    /// write it.
    #[serde(default)]
    pub share: f64,
    /// The probability that the best of all candidates does as well without a cause.
    pub p_value: f64,
    /// Part of random halves of the poses in which the finding is the best explanation again; of
    /// campaigns only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stability: Option<f64>,
    /// Other candidates in the finding's place, beside the other findings. Of a campaign all of them, those
    /// that are not distinguishable first; of a log those that are not distinguishable.
    pub alternatives: Vec<Alternative>,
    /// The measurement that would separate the finding from the nearest indistinguishable alternative: of a
    /// campaign `null` if all are distinguishable, of a log absent then.
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    pub to_separate: Option<Option<String>>,
}

/// A field that is there, `null` or not.
fn present<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D) -> Result<Option<T>, D::Error> {
    T::deserialize(from).map(Some)
}

impl Finding {
    /// The measurement that would separate it from what is not distinguishable from it.
    pub fn advice(&self) -> Option<&str> {
        self.to_separate.as_ref()?.as_deref()
    }

    /// The alternatives that this data does not distinguish from the finding.
    pub fn indistinguishable(&self) -> impl Iterator<Item = &Alternative> {
        self.alternatives.iter().filter(|other| !other.separable())
    }

    /// Whether it is this effect at this place.
    pub fn is(&self, effect: &str, place: &str) -> bool {
        self.effect == effect && self.place == place
    }
}

/// The held-out gap without and with a finding, beside those that were added before it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum HeldOutGap {
    /// Root mean square over the rows, with the interval of the shrink.
    AtRest {
        /// From the one to the other.
        held_out: Shrink,
    },
    /// Mean over the joints, as a part of their sizes.
    InMotion {
        /// Before the finding was added.
        held_out_before: f64,
        /// With it.
        held_out_after: f64,
    },
}

impl HeldOutGap {
    /// Without the finding.
    pub fn before(&self) -> f64 {
        match self {
            Self::AtRest { held_out } => held_out.before,
            Self::InMotion { held_out_before, .. } => *held_out_before,
        }
    }

    /// With it.
    pub fn after(&self) -> f64 {
        match self {
            Self::AtRest { held_out } => held_out.after,
            Self::InMotion { held_out_after, .. } => *held_out_after,
        }
    }

    /// The part of a gap, `whole` before any finding, that the finding removes.
    pub(crate) fn share(&self, whole: f64) -> f64 {
        if whole > 0.0 { (self.before() - self.after()) / whole } else { 0.0 }
    }

    /// The shrink with its interval; of campaigns only.
    pub fn shrink(&self) -> Option<&Shrink> {
        match self {
            Self::AtRest { held_out } => Some(held_out),
            Self::InMotion { .. } => None,
        }
    }
}

/// One fitted number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// What it is.
    pub name: Word,
    /// Its value, added to what the robot file has.
    pub value: f64,
    /// Of the value, SI.
    pub unit: Word,
    /// 95 % interval.
    pub ci95: [f64; 2],
    /// The same number with the commanded motion as instrument; of a log's torques, where one is logged.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub by_command: Option<f64>,
}

/// Another explanation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Alternative {
    /// Identifier of the effect.
    pub effect: Word,
    /// Where it acts.
    pub place: String,
    /// What it leaves in place of the finding.
    #[serde(flatten)]
    pub left: Left,
}

/// What an alternative leaves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Left {
    /// The held-out gap with it.
    AtRest {
        /// As [`Shrink::after`], with the alternative in place of the finding.
        held_out_after: f64,
        /// Whether resampling the poses distinguishes the two in 95 % of cases.
        separable: bool,
    },
    /// Of a log, whose alternatives are those that are not distinguishable.
    InMotion {
        /// What it leaves on unseen time, for each that the finding leaves.
        leaves: f64,
    },
}

impl Left {
    /// The held-out gap, or the ratio of gaps.
    pub fn size(&self) -> f64 {
        match self {
            Left::AtRest { held_out_after, .. } => *held_out_after,
            Left::InMotion { leaves } => *leaves,
        }
    }
}

impl Alternative {
    /// Whether this data distinguishes it from the finding.
    pub fn separable(&self) -> bool {
        matches!(self.left, Left::AtRest { separable: true, .. })
    }
}

/// What this data could not have shown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CannotSee {
    /// Identifier of the effect.
    pub effect: Word,
    /// Where.
    pub place: String,
    /// Why.
    #[serde(flatten)]
    pub why: Hidden,
}

/// Why something could not be shown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Hidden {
    /// At these poses and loads.
    AtRest {
        /// What a unit of it does to the measured quantities (rms over rows), relative to the place of
        /// the same effect at which that is largest.
        visible: f64,
        /// Why.
        because: Word,
    },
    /// In this motion.
    InMotion {
        /// Why.
        reason: String,
    },
}

impl CannotSee {
    /// Why.
    pub fn because(&self) -> &str {
        match &self.why {
            Hidden::AtRest { because, .. } => because,
            Hidden::InMotion { reason } => reason,
        }
    }
}
