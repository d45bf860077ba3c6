//! The arm and the gap in space.

use nalgebra::{Isometry3, Point3, Vector3};
use serde::Serialize;
use serde_json::Value;
use stiffarm_gap::diagnose::Nuisance;
use stiffarm_gap::measurement::{Kind, Row};
use stiffarm_kernels::generic::Convention;

use super::Report;
use super::table::point;

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

/// The scene of a report.
pub fn scene(report: &Report<'_>) -> Scene {
    let rows = &report.data.rows;
    let base = base(report);
    let middle = &rows[middle(rows)];
    let unit = report.main_unit();
    Scene {
        line: middle.line,
        places: places(report, &base, &middle.q),
        points: rows.iter().map(|row| point(measured(report, &base, row).into())).collect(),
        unit: unit.name,
        si: unit.si,
        gap: if report.has_positions() { "position" } else { "rotation" },
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

/// The base in the measuring frame: as it was fitted, or the two are one.
pub fn base(report: &Report<'_>) -> Isometry3<f64> {
    let name = Nuisance::BaseFrame.identifier();
    let fitted = report.found.nuisances.iter().find(|n| n.name == name);
    fitted.map_or_else(Isometry3::identity, |n| {
        Isometry3::new(n.translation.into(), n.rotation.into())
    })
}

/// Where a row was measured: as measured, or for a displacement where the model has the point.
fn measured(report: &Report<'_>, base: &Isometry3<f64>, row: &Row) -> Vector3<f64> {
    match report.data.kind {
        Kind::Pose { .. } => row.measured.fixed_rows::<3>(0).into_owned(),
        Kind::Displacement { .. } => {
            let tool = base * report.placed.pose(&row.q);
            (tool * Point3::from(offset(report, row))).coords
        }
    }
}

/// The measured point of a row in the tool frame, m.
pub fn offset(report: &Report<'_>, row: &Row) -> [f64; 3] {
    let fitted = row.marker.as_ref().and_then(|marker| {
        report.found.nuisances.iter().find(|n| n.name == *marker).map(|n| n.translation)
    });
    row.offset.or(fitted).unwrap_or_default()
}

/// Base, joints and links in their order, tool. A link runs along the lengths of its row.
fn places(report: &Report<'_>, base: &Isometry3<f64>, q: &[f64]) -> Vec<Place> {
    let arm = report.placed;
    let found = report.found;
    let place = |name: String, through: Vec<Vector3<f64>>| Place {
        share: found.places.iter().find(|p| p.place == name).map(|p| p.share),
        found: found.findings.iter().any(|f| f.place == name),
        through: through.into_iter().map(|p| point(p.into())).collect(),
        name,
    };
    let frames: Vec<Isometry3<f64>> = arm.frames(q).iter().map(|f| base * f).collect();
    let origin = |f: &Isometry3<f64>| f.translation.vector;
    let mut places = vec![place("base".to_owned(), vec![origin(&frames[0])])];
    for (j, joint) in arm.joints.iter().enumerate() {
        let (from, to) = (origin(&frames[j]), origin(&frames[j + 1]));
        // Standard: along z of the frame before, then along x of its own; modified: along x of
        // the frame before, then along z of its own, after the joint's axis is reached.
        let (corner, axis) = match arm.convention {
            Convention::Standard => (to - frames[j + 1] * Vector3::x() * joint.a, from),
            Convention::Modified => {
                let corner = from + frames[j] * Vector3::x() * joint.a;
                (corner, corner)
            }
        };
        places.push(place(format!("link {}", j + 1), vec![from, corner, to]));
        places.push(place(format!("joint {}", j + 1), vec![axis]));
    }
    let last = origin(&frames[arm.dof()]);
    let tool = origin(&(base * arm.pose(q)));
    places.push(place("tool".to_owned(), vec![last, tool]));
    places
}
