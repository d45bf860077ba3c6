//! Another log of the same arm, predicted with what was found.

use serde::Serialize;
use stiffarm_gap::log::report::JointGap;
use stiffarm_gap::log::{Log, LogDiagnosis, Model, Refused};
use stiffarm_kernels::generic::Arm;

/// The gap on time that played no part in the diagnosis: nothing is fitted to it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// The files.
    pub files: Vec<String>,
    /// Samples that were read.
    pub samples: usize,
    /// Each joint's, with the rigid links as they were fitted alone, and with the findings.
    pub gap: Vec<JointGap>,
    /// What was noticed of its rows and its clock.
    pub remarks: Vec<String>,
}

impl Check {
    /// Predicts `other` with what was found.
    ///
    /// # Errors
    /// [`Refused`]: it has not the rows that were diagnosed.
    pub fn of(
        arm: &Arm,
        found: &LogDiagnosis,
        model: &Model,
        other: &Log,
    ) -> Result<Check, Refused> {
        let units: Vec<&'static str> = found.gap.iter().map(|gap| gap.unit).collect();
        Ok(Check {
            files: other.files.clone(),
            samples: other.samples,
            gap: model.explain(arm, other)?.gap(model.rows, &units),
            remarks: other.remarks(),
        })
    }
}
