//! The gap: measured minus simulated, row by row and component by component.

use std::borrow::Cow;
use std::collections::BTreeMap;

use nalgebra::Vector6;
use serde::{Deserialize, Serialize};

use crate::infer::ascending;
pub use crate::infer::percentile;
use crate::measurement::{Kind, Measurements, Row};
use crate::simulate::Reading;

/// Measured minus predicted, m and rad; 0 where nothing is measured.
///
/// The rotation is the rotation vector of `R_measured R_predictedᵀ` in base axes. Where only some
/// components of a rotation are measured, it is the difference of those.
pub fn row_gap(data: &Measurements, row: &Row, predicted: &Reading) -> Vector6<f64> {
    let components = data.kind.components();
    let mut gap = row.measured - predicted.vector();
    if components[3..] == [true; 3] {
        let measured = Reading::from_vector(&row.measured);
        let turn = (measured.rotation * predicted.rotation.inverse()).scaled_axis();
        gap.fixed_rows_mut::<3>(3).copy_from(&turn);
    }
    for k in (0..6).filter(|&k| !components[k]) {
        gap[k] = 0.0;
    }
    gap
}

/// Size of a gap over rows. Position is the norm over the measured translations of a row.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Statistics {
    /// Root mean square over rows, m.
    pub position_rms: f64,
    /// 95th percentile over rows, m (linear between ranks).
    pub position_p95: f64,
    /// Largest, m.
    pub position_max: f64,
    /// Root mean square over rows of the norm over the measured rotations, rad; 0 if none is
    /// measured.
    pub rotation_rms: f64,
    /// Of the readings of a bench the size by kind of instrument, each in its own unit.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub kinds: BTreeMap<String, OfKind>,
}

/// Size of a gap over the rows of one kind of instrument.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OfKind {
    /// Root mean square over rows of the norm.
    pub rms: f64,
    /// `m`, `rad` or `px`.
    pub unit: Cow<'static, str>,
}

impl Statistics {
    /// Of rows with their gaps; of a bench lengths and angles each over the rows that read them.
    pub fn of_rows<'g>(
        kind: Kind,
        rows: impl IntoIterator<Item = (&'g Row, &'g Vector6<f64>)>,
    ) -> Statistics {
        let (rows, gaps): (Vec<&Row>, Vec<&Vector6<f64>>) = rows.into_iter().unzip();
        let Kind::Bench { .. } = kind else { return Statistics::of(gaps) };
        let read = |first: usize| {
            let both = rows.iter().zip(gaps.iter().copied());
            both.filter(move |(row, _)| row.reads(kind, first)).map(|(_, gap)| gap)
        };
        let (lengths, angles) = (Statistics::of(read(0)), Statistics::of(read(3)));
        let mut sizes: BTreeMap<String, (Vec<f64>, &'static str)> = BTreeMap::new();
        for (aim, gap) in
            rows.iter().zip(&gaps).filter_map(|(row, gap)| Some((row.aim.as_ref()?, gap)))
        {
            let (part, unit) = aim.view.unit();
            sizes
                .entry(aim.seen.thing().to_owned())
                .or_insert((Vec::new(), unit))
                .0
                .push(gap.norm() / part);
        }
        let of_kind = |(kind, (sizes, unit)): (String, (Vec<f64>, &'static str))| {
            (kind, OfKind { rms: rms(&sizes), unit: unit.into() })
        };
        let kinds = sizes.into_iter().map(of_kind).collect();
        Statistics { rotation_rms: angles.rotation_rms, kinds, ..lengths }
    }

    /// Of one gap per row.
    pub fn of<'g>(gaps: impl IntoIterator<Item = &'g Vector6<f64>>) -> Statistics {
        let norm = |g: &Vector6<f64>, from: usize| g.fixed_rows::<3>(from).norm();
        let norms = gaps.into_iter().map(|g| (norm(g, 0), norm(g, 3)));
        let (positions, rotations): (Vec<f64>, Vec<f64>) = norms.unzip();
        let positions = ascending(positions);
        Statistics {
            position_rms: rms(&positions),
            position_p95: percentile(&positions, 0.95),
            position_max: positions.last().copied().unwrap_or(0.0),
            rotation_rms: rms(&rotations),
            kinds: BTreeMap::new(),
        }
    }
}

/// Root mean square; 0 of nothing.
pub fn rms(values: &[f64]) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    (values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{row, table};

    #[test]
    fn statistics_of_known_gaps() {
        let gaps: Vec<_> = (0..=20)
            .map(|k| Vector6::new(0.0, 3.0 * f64::from(k), 4.0 * f64::from(k), 0.0, 2.0, 0.0))
            .collect();
        let s = Statistics::of(&gaps);
        assert_eq!(s.position_max, 100.0);
        assert_eq!(s.position_p95, 95.0);
        assert!((s.position_rms - 5.0 * (2870.0 / 21.0_f64).sqrt()).abs() < 1e-12);
        assert_eq!(s.rotation_rms, 2.0);
        assert_eq!(Statistics::of(&[]), Statistics::default());
    }

    #[test]
    fn a_rotation_gap_is_a_rotation() {
        let mut r = row(&[0.0], Vector6::zeros());
        r.measured = Vector6::new(1.0, 0.0, 0.0, 0.0, 0.0, 3.1);
        let data = table(vec![r], Kind::Pose { orientation: true });
        let predicted = Reading::from_vector(&Vector6::new(0.5, 0.0, 0.0, 0.0, 0.0, -3.1));
        let gap = row_gap(&data, &data.rows[0], &predicted);
        let want = 6.2 - 2.0 * core::f64::consts::PI;
        assert!((gap - Vector6::new(0.5, 0.0, 0.0, 0.0, 0.0, want)).norm() < 1e-12, "{gap}");
    }

    #[test]
    fn only_what_is_measured_counts() {
        let mut r = row(&[0.0], Vector6::zeros());
        r.measured = Vector6::new(0.0, -3.0, 0.0, 0.0, 0.25, 0.0);
        let components = [false, true, false, false, true, false];
        let data = table(vec![r], Kind::Displacement { components });
        let predicted = Reading::from_vector(&Vector6::new(9.0, -1.0, 9.0, 0.1, 0.2, 0.1));
        let gap = row_gap(&data, &data.rows[0], &predicted);
        assert!((gap - Vector6::new(0.0, -2.0, 0.0, 0.0, 0.05, 0.0)).norm() < 1e-12, "{gap}");
    }
}
