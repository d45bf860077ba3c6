//! Another measurement file of the same arm, predicted with what was found.

use serde::Serialize;
use stiffarm_gap::diagnose::Explanation;
use stiffarm_gap::gap::Statistics;
use stiffarm_gap::{DiagnoseError, Measurements};

/// The gap on measurements that played no part in the diagnosis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// The file.
    pub file: String,
    /// Its rows.
    pub rows: usize,
    /// Those within the joint ranges and loads of the diagnosed data; only they are judged.
    pub inside: usize,
    /// The gap of the robot file as it is on the rows inside; `None` if there are none.
    pub before: Option<Statistics>,
    /// The same with the findings.
    pub after: Option<Statistics>,
}

impl Check {
    /// Predicts `other`.
    ///
    /// # Errors
    /// [`DiagnoseError`]: what in the data stands in the way.
    pub fn of(explanation: &Explanation, other: &Measurements) -> Result<Check, DiagnoseError> {
        let predicted = explanation.predict(other)?;
        let inside = predicted.inside.iter().filter(|inside| **inside).count();
        let size = |gaps: &[nalgebra::Vector6<f64>]| {
            let judged = gaps.iter().zip(&predicted.inside).filter(|(_, inside)| **inside);
            let judged: Vec<_> = judged.map(|(gap, _)| *gap).collect();
            (inside > 0).then(|| Statistics::of(&judged))
        };
        Ok(Check {
            file: other.file.clone(),
            rows: other.rows.len(),
            inside,
            before: size(&predicted.before),
            after: size(&predicted.after),
        })
    }
}
