//! The measurement file (CSV): read to the letter, or refused with every mistake at its place.
//!
//! A header row, then one row per measurement; `#` begins a comment line. A column is `name` or
//! `name[unit]`; the order is free. A file measures *either* poses (`x y z`, and all or none of `rx
//! ry rz`) *or* displacements (any subset of `dx dy dz drx dry drz`). Nothing is guessed: an angle
//! without a unit is in radians, and a column that is not known is kept as it is and reported.

mod cells;
mod group;
mod header;
mod mistake;
mod role;
mod seen;
mod table;
mod unit;

use std::path::Path;

use nalgebra::Vector6;

pub use mistake::{Column, Fault, MOST_MISTAKES, Mistake, ReadError};
pub use role::{
    DISPLACEMENT_NAMES, Layout, Marker, POSE_NAMES, SIGMA_PREFIX, SIM_PREFIX, WRENCH_NAMES,
};
pub use unit::{Dimension, UNITS, Unit};

use mistake::Mistakes;

pub(crate) use group::Near;
pub(crate) use role::Role;
pub(crate) use unit::nearest;

/// A measurement file, in SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurements {
    /// The file as it was named.
    pub file: String,
    /// In the order of the file, which is the order of measuring; at least one.
    pub rows: Vec<Row>,
    /// What was measured.
    pub kind: Kind,
    /// Which components the user's own simulator predicts.
    pub sim_given: [bool; 6],
    /// Number of distinct poses: each row's [`Row::group`] is below it.
    pub poses: usize,
    /// The columns that have no meaning here, as they stand.
    pub extra: Vec<ExtraColumn>,
    /// Columns that are known but play no part: a component that is simulated, or has a standard
    /// deviation, and is not measured.
    pub unused: Vec<Column>,
    /// Rows that were left out, and why: a cell of theirs is empty or not a number. Never more than
    /// one row in [`ONE_IN`].
    pub skipped: Vec<Mistake>,
    /// The unit in which the file has each measured component; `None` where it is not measured.
    pub measured_in: [Option<Unit>; 6],
    /// The unit in which the file has each component of the wrench; `None` where it has no column.
    pub wrench_in: [Option<Unit>; 6],
}

/// A file of which more than one row in so many has holes is refused: a campaign loses a reading now
/// and then (a beam that was cut), not every tenth.
pub const ONE_IN: usize = 10;

/// Wrists turn ±700° at the most: a joint that reads more than two turns is not read in radians.
pub(crate) const MOST_RADIANS: f64 = 4.0 * core::f64::consts::PI;

/// What the file measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The tool's position in the base frame, and perhaps its orientation.
    Pose {
        /// Whether `rx ry rz` are there.
        orientation: bool,
    },
    /// Loaded minus unloaded, base axes.
    Displacement {
        /// Which of `dx dy dz drx dry drz` are there.
        components: [bool; 6],
    },
}

impl Kind {
    /// The names of the six components.
    pub fn names(self) -> [&'static str; 6] {
        match self {
            Kind::Pose { .. } => POSE_NAMES,
            Kind::Displacement { .. } => DISPLACEMENT_NAMES,
        }
    }

    /// The names of those that are measured.
    pub fn measured(self) -> Vec<&'static str> {
        let named = self.names().into_iter().zip(self.components());
        named.filter_map(|(name, is)| is.then_some(name)).collect()
    }

    /// Which of the six components are measured, translations first.
    pub fn components(self) -> [bool; 6] {
        match self {
            Kind::Pose { orientation: o } => [true, true, true, o, o, o],
            Kind::Displacement { components } => components,
        }
    }
}

/// One measurement, in SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Line of the file, from 1.
    pub line: u64,
    /// Joint readings, n, rad (m if prismatic).
    pub q: Vec<f64>,
    /// Wrench on the tool, base axes, at the tool origin, N and N·m; 0 where the file has no
    /// column.
    pub wrench: Vector6<f64>,
    /// Direction from which each joint came to rest, n, each −1, 0 or +1 (0 where it has no
    /// column).
    pub direction: Option<Vec<i8>>,
    /// Degrees Celsius.
    pub temperature: Option<f64>,
    /// Seconds from the start.
    pub time: Option<f64>,
    /// Id of the pose, as written.
    pub pose: Option<String>,
    /// Rows of one group are one pose, and never stand on both sides of a fold. By the `pose`
    /// column where there is one; else rows whose readings agree to 1e-4 rad (m), wherever they
    /// stand.
    pub group: usize,
    /// Name of the measured point.
    pub marker: Option<String>,
    /// Where the measured point is in the tool frame, m; `None` is unknown. Zero without a marker.
    pub offset: Option<[f64; 3]>,
    /// Position and rotation vector, or displacement, m and rad; 0 where it is not measured.
    pub measured: Vector6<f64>,
    /// The instrument's own standard deviation of each of these, m and rad, 0 where the file has no
    /// column for it; `None` if it has none at all.
    pub sigma: Option<Vector6<f64>>,
    /// The same by the user's own simulator; 0 where [`Measurements::sim_given`] is false.
    pub sim: Option<Vector6<f64>>,
}

impl Row {
    /// A row at some readings, without load, of which nothing was measured.
    pub fn new(line: u64, q: Vec<f64>) -> Row {
        Row {
            line,
            q,
            wrench: Vector6::zeros(),
            direction: None,
            temperature: None,
            time: None,
            pose: None,
            group: 0,
            marker: None,
            offset: Some([0.0; 3]),
            measured: Vector6::zeros(),
            sigma: None,
            sim: None,
        }
    }
}

/// A column that has no meaning here.
#[derive(Clone, Debug, PartialEq)]
pub struct ExtraColumn {
    /// Where it stands.
    pub column: Column,
    /// Its header without the unit.
    pub name: String,
    /// The text in its header's brackets, whatever it says.
    pub unit: Option<String>,
    /// One cell per row.
    pub cells: Vec<String>,
    /// The cells as numbers, as written and not converted, if every one is a finite number.
    pub values: Option<Vec<f64>>,
    /// A known name that it may have been meant to be; nothing is assumed.
    pub suggestion: Option<String>,
}

impl Measurements {
    /// Rows that no file holds, each of the pose that its `group` says.
    pub fn new(file: &str, kind: Kind, rows: Vec<Row>) -> Measurements {
        Measurements {
            file: file.to_owned(),
            poses: rows.iter().map(|row| row.group + 1).max().unwrap_or(0),
            rows,
            kind,
            sim_given: [false; 6],
            extra: Vec::new(),
            unused: Vec::new(),
            skipped: Vec::new(),
            measured_in: [None; 6],
            wrench_in: [None; 6],
        }
    }

    /// Whether every row has a time.
    pub fn is_timed(&self) -> bool {
        self.rows.iter().all(|row| row.time.is_some())
    }

    /// Reads a measurement file for a robot of the given layout.
    ///
    /// # Errors
    /// [`ReadError`]: the file cannot be opened, or all its mistakes.
    pub fn read(path: &Path, layout: &Layout) -> Result<Measurements, ReadError> {
        let file = path.display().to_string();
        match std::fs::read(path) {
            Ok(bytes) => Measurements::from_bytes(&file, &bytes, layout),
            Err(source) => Err(ReadError::Open { file, source }),
        }
    }

    /// Reads the bytes of a measurement file; `file` is what messages call it.
    ///
    /// # Errors
    /// [`ReadError::Mistakes`]: all its mistakes, up to [`MOST_MISTAKES`].
    pub fn from_bytes(
        file: &str,
        bytes: &[u8],
        layout: &Layout,
    ) -> Result<Measurements, ReadError> {
        Measurements::of_bytes(file, bytes, layout, false)
    }

    /// The same of a file that is still to be measured, in which cells of what is measured may be
    /// empty; they are 0.
    ///
    /// # Errors
    /// As [`Measurements::from_bytes`].
    pub fn plan_from_bytes(
        file: &str,
        bytes: &[u8],
        layout: &Layout,
    ) -> Result<Measurements, ReadError> {
        Measurements::of_bytes(file, bytes, layout, true)
    }

    fn of_bytes(
        file: &str,
        bytes: &[u8],
        layout: &Layout,
        planned: bool,
    ) -> Result<Measurements, ReadError> {
        let mut mistakes = Mistakes::default();
        let read = read_into(&mut mistakes, file, bytes, layout, planned);
        match read.filter(|_| mistakes.is_empty()) {
            Some(measurements) => Ok(measurements),
            None => Err(mistakes.into_error(file)),
        }
    }

    /// Number of measured components of one row.
    pub fn components(&self) -> usize {
        self.kind.components().into_iter().filter(|c| *c).count()
    }
}

/// `None` only if there is a mistake.
fn read_into(
    mistakes: &mut Mistakes,
    file: &str,
    bytes: &[u8],
    layout: &Layout,
    planned: bool,
) -> Option<Measurements> {
    let records = match table::records(bytes) {
        Ok(records) => records,
        Err(not) => {
            mistakes.add(not.line, not.column, not.fault);
            return None;
        }
    };
    let Some((top, body)) = records.split_first() else {
        mistakes.add(1, None, Fault::EmptyFile);
        return None;
    };
    if let Some(fault) = no_header(top) {
        mistakes.add(top.line, None, fault);
        return None;
    }
    let heads = header::read(top, layout, mistakes);
    let kind = header::kind(&heads, top.line, layout, mistakes);
    if body.is_empty() {
        mistakes.add(top.line, None, Fault::NoRows);
    }
    let mut rows = Vec::with_capacity(body.len());
    let mut whole = Vec::with_capacity(body.len());
    let mut skipped = Vec::new();
    for record in body {
        match cells::row(record, &heads, layout, planned) {
            Ok(row) => {
                rows.push(row);
                whole.push(record);
            }
            Err(found) if found.iter().all(|m| m.fault.is_hole()) => skipped.push(found),
            Err(found) => mistakes.extend(found),
        }
    }
    if skipped.len() * ONE_IN > body.len() {
        skipped.drain(..).for_each(|found| mistakes.extend(found));
    }
    let (kind, sim_given) = kind.filter(|_| mistakes.is_empty())?;
    let poses = group::assign(&mut rows);
    let measured = kind.components();
    let unused = |h: &&header::Head| match h.role {
        Some(Role::Sim(_, k) | Role::Sigma(Some((_, k)))) => !measured[k],
        Some(Role::Sigma(None)) => measured[..3] == [false; 3],
        _ => false,
    };
    let unit_of = |role| heads.iter().find(|h| h.role == Some(role)).and_then(|h| h.unit);
    let family = match kind {
        Kind::Pose { .. } => role::Family::Pose,
        Kind::Displacement { .. } => role::Family::Displacement,
    };
    Some(Measurements {
        file: file.to_owned(),
        measured_in: core::array::from_fn(|k| unit_of(Role::Measured(family, k))),
        wrench_in: core::array::from_fn(|k| unit_of(Role::Wrench(k))),
        unused: heads.iter().filter(unused).map(|h| h.column.clone()).collect(),
        extra: extra(&heads, &whole, layout),
        skipped: skipped.into_iter().flatten().collect(),
        rows,
        kind,
        sim_given,
        poses,
    })
}

/// A first row that is no header at all.
fn no_header(top: &table::Record) -> Option<Fault> {
    if let Some(found) = cells::only_numbers(&top.cells) {
        return Some(Fault::HeaderMissing { found });
    }
    let separators = [(';', "semicolons"), ('\t', "tabs"), ('|', "bars")];
    let lone = top.cells.iter().next().filter(|_| top.cells.len() == 1)?;
    let (_, separator) = separators.into_iter().find(|(c, _)| lone.contains(*c))?;
    Some(Fault::Separator { separator })
}

fn extra(heads: &[header::Head], body: &[&table::Record], layout: &Layout) -> Vec<ExtraColumn> {
    let unknown = heads.iter().filter(|h| h.role == Some(Role::Extra));
    unknown
        .map(|head| {
            let index = head.column.number - 1;
            let cells: Vec<String> =
                body.iter().map(|r| r.cells.get(index).unwrap_or_default().to_owned()).collect();
            ExtraColumn {
                column: head.column.clone(),
                name: head.name.clone(),
                unit: head.unit_text.clone(),
                values: cells.iter().map(|c| cells::number(c, "a number").ok()).collect(),
                cells,
                suggestion: role::nearest_name(&head.name, layout),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests;
