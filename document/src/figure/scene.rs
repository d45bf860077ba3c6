//! The arm and the gap in space.

use nalgebra::{Isometry3, Vector3};
use serde::Serialize;
use serde_json::Value;
use stiffarm_gap::measurement::{Kind, Row};
use stiffarm_kernels::generic::Convention;

use super::csv::point;
use super::experiment::Experiment;

/// A place of the arm: joints, base and tool are points, links are lines.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Place {
    /// As findings name it.
    name: String,
    /// m, measuring frame.
    through: Vec<[Value; 3]>,
    /// What it alone takes of the gap; none if that is nothing.
    share: Option<f64>,
    /// Whether a finding lies there.
    found: bool,
}

/// Everything that is drawn.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scene {
    /// Line of the row at whose readings the arm stands.
    line: u64,
    /// From base to tool.
    places: Vec<Place>,
    /// Measured points, m, one per row.
    points: Vec<[Value; 3]>,
    /// Unit of the gap.
    unit: &'static str,
    si: f64,
    /// `position`, or `rotation` without positions: a vector is then one metre a radian.
    gap: &'static str,
}

pub fn scene(experiment: &Experiment<'_>) -> Scene {
    let rows = &experiment.data.rows;
    let middle = &rows[middle(rows)];
    let unit = experiment.main_unit();
    Scene {
        line: middle.line,
        places: places(experiment, middle),
        points: rows.iter().map(|row| point(measured(experiment, row).into())).collect(),
        unit: unit.name,
        si: unit.si,
        gap: if experiment.has_positions() { "position" } else { "rotation" },
    }
}

/// The row whose readings are nearest to the middle of the data, in parts of each joint's range.
fn middle(rows: &[Row]) -> usize {
    let count = rows.len() as f64;
    let joints = rows[0].q.len();
    let spread = |j: usize| {
        let values = rows.iter().map(|r| r.q[j]);
        let mean = values.clone().sum::<f64>() / count;
        let width = values.map(|q| (q - mean).abs()).fold(0.0, f64::max);
        (mean, if width > 0.0 { width } else { 1.0 })
    };
    let spreads: Vec<(f64, f64)> = (0..joints).map(spread).collect();
    let far = |row: &Row| -> f64 {
        row.q.iter().zip(&spreads).map(|(q, (mean, width))| ((q - mean) / width).powi(2)).sum()
    };
    (0..rows.len()).min_by(|a, b| far(&rows[*a]).total_cmp(&far(&rows[*b]))).unwrap_or(0)
}

/// Where a row was measured: as measured, or of what is no whole position where the model has the point.
fn measured(experiment: &Experiment<'_>, row: &Row) -> Vector3<f64> {
    match experiment.data.kind {
        Kind::Pose { .. } => row.measured.fixed_rows::<3>(0).into_owned(),
        _ => experiment.point(row).coords,
    }
}

/// Base, joints and links in their order, tool. A link runs along the lengths of its row.
fn places(experiment: &Experiment<'_>, row: &Row) -> Vec<Place> {
    let (arm, q) = (experiment.placed, &row.q);
    let part = |name: &str| experiment.shares.iter().find(|s| s.place == name);
    let place = |name: String, through: Vec<Vector3<f64>>| Place {
        share: part(&name).and_then(|s| s.share),
        found: part(&name).is_some_and(|s| s.found),
        through: through.into_iter().map(|p| point(p.into())).collect(),
        name,
    };
    let frames = arm.frames(q);
    let origin = |f: &Isometry3<f64>| f.translation.vector;
    let mut places = vec![place("base".to_owned(), vec![origin(&frames[0])])];
    for (j, joint) in arm.joints.iter().enumerate() {
        let (from, to) = (origin(&frames[j]), origin(&frames[j + 1]));
        // Standard: along z of the frame before, then along x of its own; modified: along x of
        // the frame before, then along z of its own, after the joint's axis is reached.
        let (corner, axis) = match arm.convention {
            Convention::Standard => {
                let tilt = Isometry3::rotation(-joint.beta * Vector3::y());
                (to - frames[j + 1] * tilt * Vector3::x() * joint.a, from)
            }
            Convention::Modified => {
                let tilt = Isometry3::rotation(joint.alpha * Vector3::x())
                    * Isometry3::rotation(joint.beta * Vector3::y());
                let corner = from + frames[j] * tilt * Vector3::x() * joint.a;
                (corner, corner)
            }
        };
        places.push(place(format!("link {}", j + 1), vec![from, corner, to]));
        places.push(place(format!("joint {}", j + 1), vec![axis]));
    }
    let last = origin(&frames[arm.dof()]);
    let tool = origin(&experiment.frame(row));
    places.push(place("tool".to_owned(), vec![last, tool]));
    places
}
