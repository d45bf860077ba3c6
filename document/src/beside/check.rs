//! Another measurement file of the same arm, predicted with what was found.

use serde::Serialize;
use stiffarm_gap::diagnose::Diagnosed;
use stiffarm_gap::gap::Statistics;
use stiffarm_gap::mistakes::Mended;
use stiffarm_gap::{DiagnoseError, Measurements};

/// The gap on measurements that played no part in the diagnosis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// The other file.
    pub file: String,
    /// Its rows.
    pub rows: usize,
    /// Those within the joint ranges, the loads and the largest leverage of the diagnosed data; only
    /// they are judged.
    pub inside: usize,
    /// Whether its readings are mended as those of the diagnosed data were.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub mended: bool,
    /// Whether these are the rows that were diagnosed. Those that were left out then are not judged.
    pub fitted: bool,
    /// The gap of the robot file as it is on the rows inside; `None` if there are none.
    pub before: Option<Statistics>,
    /// The same with the findings.
    pub after: Option<Statistics>,
    /// Both on all rows, those outside too; `None` where none is outside.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub all: Option<[Statistics; 2]>,
}

impl Check {
    /// Predicts `other` with what was found in `data`. Where the readings of `data` were `mended`, so are those of
    /// `other` if that leaves a smaller gap.
    pub fn of(
        diagnosed: &Diagnosed,
        mended: Option<&Mended>,
        data: &Measurements,
        other: &Measurements,
    ) -> Result<Check, DiagnoseError> {
        let (told, left) = Check::as_told(diagnosed, data, other)?;
        let Some(other) = mended.and_then(|mended| mended.readings(other)) else { return Ok(told) };
        let (again, left_again) = Check::as_told(diagnosed, data, &other)?;
        Ok(if left_again < left { Check { mended: true, ..again } } else { told })
    }

    /// The same of readings that mean what they say, and the gap that is left on all rows, m.
    fn as_told(
        diagnosed: &Diagnosed,
        data: &Measurements,
        other: &Measurements,
    ) -> Result<(Check, f64), DiagnoseError> {
        let mut predicted = diagnosed.explanation.predict(other)?;
        let fitted = other.rows == data.rows;
        if fitted {
            let rows = predicted.inside.iter_mut().zip(&other.rows);
            rows.for_each(|(inside, row)| {
                *inside = !diagnosed.diagnosis.left_out.iter().any(|out| out.is(row))
            });
        }
        let inside = predicted.inside.iter().filter(|inside| **inside).count();
        let size = |gaps: &[nalgebra::Vector6<f64>]| {
            let rows = other.rows.iter().zip(gaps).zip(&predicted.inside);
            let judged = rows.filter(|(_, inside)| **inside).map(|(row, _)| row);
            (inside > 0).then(|| Statistics::of_rows(other.kind, judged))
        };
        let is_extrapolated = !fitted && inside < other.rows.len();
        let all = [&predicted.before, &predicted.after]
            .map(|gaps| Statistics::of_rows(other.kind, other.rows.iter().zip(gaps)));
        let left = all[1].position_rms;
        let check = Check {
            file: other.file.clone(),
            rows: other.rows.len(),
            inside,
            mended: false,
            fitted,
            before: size(&predicted.before),
            after: size(&predicted.after),
            all: is_extrapolated.then_some(all),
        };
        Ok((check, left))
    }
}
