//! The poses with the largest residuals.

use std::collections::BTreeMap;

use nalgebra::Vector6;
use stiffarm_gap::gap::rms;
use stiffarm_gap::measurement::Row;

use super::{Campaign, Fitted};

/// Poses that are shown.
const MOST: usize = 8;

/// A pose with its gap.
pub(super) struct Pose {
    /// Its id, or its first line.
    pub name: String,
    pub rows: usize,
    /// Root mean square over its rows, of what is judged, m (rad without positions).
    pub before: f64,
    pub after: f64,
}

impl Campaign<'_> {
    /// The worst first. The residuals are those of the models that were fitted to all rows.
    pub(super) fn worst(&self, fitted: &Fitted<'_>) -> Vec<Pose> {
        let first = if self.units().positions { 0 } else { 3 };
        let size = |gaps: &[Vector6<f64>], rows: &[usize]| {
            rms(&rows.iter().map(|k| gaps[*k].fixed_rows::<3>(first).norm()).collect::<Vec<_>>())
        };
        let out = |row: &Row| self.found.left_out.iter().any(|out| out.is(row));
        let mut poses: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (k, row) in self.data.rows.iter().enumerate().filter(|(_, row)| !out(row)) {
            poses.entry(row.group).or_default().push(k);
        }
        let pose = |rows: &Vec<usize>| {
            let row = &self.data.rows[rows[0]];
            let name = match &row.pose {
                Some(id) => format!("pose {id}"),
                None => format!("line {}", row.line),
            };
            let session =
                row.session.as_ref().map_or_else(String::new, |s| format!(" of session {s}"));
            Pose {
                name: name + &session,
                rows: rows.len(),
                before: size(&fitted.gaps.before, rows),
                after: size(&fitted.gaps.after, rows),
            }
        };
        let mut poses: Vec<Pose> = poses.values().map(pose).collect();
        poses.sort_by(|a, b| b.after.total_cmp(&a.after));
        poses.truncate(MOST);
        poses
    }
}
