//! A table of points: columns `x y z rx ry rz` or `q1 … qn`, each with its unit in brackets, and any others.
//!
//! A row with a pose is a pose, and its joint values are those beside which it is reached. Poses stand in the robot's
//! base.

use std::ops::Range;

use super::edit::{Cell, si};
use super::point::{Place, Point, Values};
use super::{Fault, File, Found};
use crate::io::columns::split;
use crate::io::{Dimension, Unit, plain};
use crate::measurement::POSE_NAMES;

/// The columns that matter: where each is, and metres or radians of its unit.
type Columns = Vec<(usize, f64)>;

pub(super) fn read(files: &[File], joints: usize, found: &mut Found) -> Result<(), Fault> {
    for (file, File { text, .. }) in files.iter().enumerate() {
        let mut heads: Option<(Columns, Columns)> = None;
        for line in lines(text) {
            let cells = cells(text, line.clone());
            let Some((pose, readings)) = &heads else {
                heads = Some(columns(file, text, line, &cells, joints)?);
                continue;
            };
            let read = |columns: &Columns| -> Result<Vec<Cell>, Fault> {
                let cell =
                    |(k, unit): &(usize, f64)| number(file, text, &line, cells.get(*k), *unit);
                columns.iter().map(cell).collect()
            };
            let (pose, readings) = (read(pose)?, read(readings)?);
            let near = si(&readings);
            let is_pose = !pose.is_empty();
            let values = if is_pose { Values::Pose(pose) } else { Values::Joints(readings) };
            let mut point = Point::new("row", file, values);
            point.near = Some(near).filter(|near| is_pose && !near.is_empty());
            (point.rank, point.is_fixed) = (Some(found.uses.next()), true);
            point.frame = Place::none();
            found.points.push(point);
        }
    }
    Ok(())
}

/// The lines that are neither empty nor comments.
fn lines(text: &[u8]) -> impl Iterator<Item = Range<usize>> + '_ {
    let mut start = 0;
    let all = text.split(|byte| *byte == b'\n').map(move |line| {
        let at = start;
        start += line.len() + 1;
        at..at + line.strip_suffix(b"\r").unwrap_or(line).len()
    });
    all.filter(|line| {
        let bytes = text[line.clone()].trim_ascii();
        !bytes.is_empty() && bytes[0] != b'#'
    })
}

/// The bytes of each cell of a line, without the spaces around it.
fn cells(text: &[u8], line: Range<usize>) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let (mut start, mut quoted) = (line.start, false);
    for at in line.clone().chain([line.end]) {
        let byte = if at == line.end { b',' } else { text[at] };
        quoted ^= byte == b'"';
        if byte == b',' && (!quoted || at == line.end) {
            let cell = &text[start..at];
            let left = start + (cell.len() - cell.trim_ascii_start().len());
            found.push(left..left + cell.trim_ascii().len());
            start = at + 1;
        }
    }
    found
}

/// Which columns are a pose's and which are joint values.
fn columns(
    file: usize,
    text: &[u8],
    line: Range<usize>,
    cells: &[Range<usize>],
    joints: usize,
) -> Result<(Columns, Columns), Fault> {
    let find = |name: &str, kinds: &[Dimension]| -> Result<Option<(usize, f64)>, Fault> {
        for (k, cell) in cells.iter().enumerate() {
            let head = String::from_utf8_lossy(&text[cell.clone()]);
            let (found, unit) = split(head.trim_matches('"'));
            if found != name {
                continue;
            }
            let unit = unit.map_or(Some(kinds[0].si()), Unit::named);
            let Some(unit) = unit.filter(|unit| kinds.contains(&unit.dimension)) else {
                let units: Vec<String> = kinds.iter().map(|kind| kind.units()).collect();
                let message = format!("found `{head}`, expected one of {}", units.join(", "));
                let help = format!("write {name}[{}]", kinds[0].si().name);
                return Err(Fault { file, span: cell.clone(), message, help });
            };
            return Ok(Some((k, unit.factor)));
        }
        Ok(None)
    };
    let mut pose = Vec::new();
    for (k, name) in POSE_NAMES.iter().enumerate() {
        let kind = if k < 3 { Dimension::Length } else { Dimension::Angle };
        pose.extend(find(name, &[kind])?);
    }
    let mut readings = Vec::new();
    for joint in 1..=joints {
        readings.extend(find(&format!("q{joint}"), &[Dimension::Angle, Dimension::Length])?);
    }
    let complete = |columns: &Columns, all: usize| columns.is_empty() || columns.len() == all;
    let (has_pose, has_joints) = (complete(&pose, 6), complete(&readings, joints));
    if has_pose && has_joints && !(pose.is_empty() && readings.is_empty()) {
        return Ok((pose, readings));
    }
    let message =
        format!("found no columns of points, expected x, y, z, rx, ry, rz or q1 … q{joints}");
    let help = "a column bears its unit: x[mm], rx[deg], q1[deg]".to_owned();
    Err(Fault { file, span: line, message, help })
}

fn number(
    file: usize,
    text: &[u8],
    line: &Range<usize>,
    cell: Option<&Range<usize>>,
    unit: f64,
) -> Result<Cell, Fault> {
    let span = cell.cloned().unwrap_or(line.clone());
    let shown = String::from_utf8_lossy(&text[span.clone()]);
    let read = cell.and_then(|_| plain(&shown));
    read.map(|value| Cell { value, unit, span: span.clone() }).ok_or_else(|| Fault {
        file,
        message: format!("found `{shown}`, expected a number"),
        span,
        help: "a row has a number for each column of the point".to_owned(),
    })
}
