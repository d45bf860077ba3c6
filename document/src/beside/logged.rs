//! Another log of the same arm, predicted with what was found.

use serde::Serialize;
use stiffarm_gap::log::model::Explained;
use stiffarm_gap::log::report::JointGap;
use stiffarm_gap::log::{Log, LogDiagnosis, Model};

/// The gap on time that played no part in the diagnosis: nothing is fitted to it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// The other files.
    pub files: Vec<String>,
    /// Samples that were read.
    pub samples: usize,
    /// Each joint's, with the rigid links as they were fitted alone, and with the findings.
    pub gap: Vec<JointGap>,
    /// What was noticed of its rows and its clock.
    pub remarks: Vec<String>,
}

impl Check {
    /// Of `other`, whose rows are as the model of a diagnosis has them.
    pub fn of(found: &LogDiagnosis, model: &Model, other: &Log, explained: &Explained) -> Check {
        Check {
            files: other.files.clone(),
            samples: other.samples,
            gap: explained.gap(model.rows, &found.gap),
            remarks: other.remarks(),
        }
    }
}
