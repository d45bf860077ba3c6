//! What a page draws of an experiment, whatever was made of it: the rows, the arm, and the gap
//! before and after.

use nalgebra::{Isometry3, Point3, Vector6};
use stiffarm_gap::Measurements;
use stiffarm_gap::measurement::{Row, Sight};
use stiffarm_kernels::generic::Arm;

use crate::Unit;

/// An experiment and its gap.
pub struct Experiment<'a> {
    /// What was measured.
    pub data: &'a Measurements,
    /// The arm of the robot file.
    pub arm: &'a Arm,
    /// The same with base and tool where they were fitted.
    pub placed: &'a Arm,
    /// The boards or cameras that are on the tool, and where they were found, tool frame.
    pub mounts: Vec<(&'a str, Isometry3<f64>)>,
    /// Where the markers that the file does not know were found, m, tool frame.
    pub markers: Vec<(&'a str, [f64; 3])>,
    /// Of each row, before and after, m and rad.
    pub gaps: [&'a [Vector6<f64>]; 2],
    /// Parts of the gap by place.
    pub shares: Vec<Share>,
    /// In what translations are shown.
    pub length: Unit<'static>,
    /// In what rotations are shown.
    pub angle: Unit<'static>,
}

/// What has to do with a place.
pub struct Share {
    /// `joint 2`.
    pub place: String,
    /// Part of the gap's mean square.
    pub share: Option<f64>,
    /// Whether a finding lies there.
    pub found: bool,
}

/// Rows that a page draws at most: more lie on top of one another, and make it slow.
const MOST_DRAWN: usize = 4000;

/// Of so many rows each this many-th is drawn.
fn every(rows: usize) -> usize {
    rows.div_ceil(MOST_DRAWN).max(1)
}

/// What a page says of the rows that it draws; nothing where these are all.
pub fn drawn_of(rows: usize) -> String {
    match every(rows) {
        1 => String::new(),
        every => format!(
            "{} of {rows} rows are drawn, one in {every}; the CSV file has the same.",
            rows.div_ceil(every)
        ),
    }
}

/// The rows that are drawn of very many, with their gaps.
pub struct Drawn {
    data: Measurements,
    gaps: [Vec<Vector6<f64>>; 2],
}

impl Drawn {
    pub fn of(experiment: &Experiment<'_>) -> Drawn {
        let Experiment { data, gaps, .. } = experiment;
        let every = every(data.rows.len());
        let rows = data.rows.iter().step_by(every).cloned().collect();
        Drawn {
            data: Measurements::new(&data.file, data.kind, rows),
            gaps: gaps.map(|gaps| gaps.iter().step_by(every).copied().collect()),
        }
    }
}

impl<'a> Experiment<'a> {
    /// The same of the rows that are drawn.
    pub fn with(self, drawn: &'a Drawn) -> Experiment<'a> {
        let [before, after] = &drawn.gaps;
        Experiment { data: &drawn.data, gaps: [before, after], ..self }
    }
}

impl Experiment<'_> {
    /// Whether positions are measured; else rotations are what is judged.
    pub fn has_positions(&self) -> bool {
        self.data.kind.components()[..3].contains(&true)
    }

    /// In what the part of the gap is shown that is judged and drawn.
    pub fn main_unit(&self) -> Unit<'static> {
        if self.has_positions() { self.length } else { self.angle }
    }

    /// The frame of which a row has a point: the tool's, or that of what is mounted on it; measuring frame.
    pub fn frame(&self, row: &Row) -> Isometry3<f64> {
        let tool = self.placed.pose(&row.q);
        let mounted = row.camera.as_deref().and_then(Sight::mounted);
        let mount = mounted.and_then(|name| self.mounts.iter().find(|(known, _)| *known == name));
        mount.map_or(tool, |(_, mount)| tool * mount)
    }

    /// The measured point of a row in the measuring frame, m.
    pub fn point(&self, row: &Row) -> Point3<f64> {
        self.frame(row) * Point3::from(self.offset(row))
    }

    /// The same in the frame of which the row has it.
    fn offset(&self, row: &Row) -> [f64; 3] {
        let fitted = row.marker.as_ref().and_then(|marker| {
            self.markers.iter().find(|(name, _)| name == marker).map(|(_, at)| *at)
        });
        row.offset.or(fitted).unwrap_or_default()
    }
}
