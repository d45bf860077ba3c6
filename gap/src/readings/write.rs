//! The rows of a table as those of a measurement file.

use core::f64::consts::TAU;

use nalgebra::Vector3;

use super::columns::{Column, Columns, dimension};
use super::map::{Convention, Map};
use super::sheet::{Row, Table};
use super::turn::Turn;
use super::{Imported, clock, names};
use crate::io::{self, Dimension, Fault, Mistake, Mistakes, ReadError, Unit, did_you_mean};
use crate::measurement::{MOST_RADIANS, WRENCH_NAMES, nearest_name};

/// Weight of a kilogram where the map says nothing, base axes, m/s².
const GRAVITY: [f64; 3] = [0.0, 0.0, -9.806_65];

/// A tool that is farther away than any arm reaches is in millimetres.
const MOST_METRES: f64 = 20.0;

/// What is written of a row in one column.
type Cell<'a> = Box<dyn Fn(&Row<'_>) -> Result<String, Mistake> + 'a>;

/// One column of what is written.
struct Output<'a> {
    header: String,
    cell: Cell<'a>,
}

pub(super) fn write(
    table: &Table<'_>,
    columns: &Columns,
    turn: Option<Turn>,
    map: &Map,
) -> Result<Imported, ReadError> {
    let mut said = table.said.clone();
    let turned = turn.as_ref().map_or(&[][..], |t| &t.columns);
    let is_turned = |c: &Column| turned.iter().any(|t| t.index == c.index);
    let mut outputs = Vec::new();
    let mut ours: Vec<&(String, Column)> =
        columns.ours.iter().filter(|(_, c)| !is_turned(c)).collect();
    ours.sort_by_key(|(name, c)| (order(name), c.index));
    if !ours.iter().any(|(name, _)| order(name).0 == 0) {
        let expected = "a column of each joint's reading: q1 …, J1 …, A1 …";
        let fault = Fault::new("no joints", expected, "name its columns in the map");
        return Err(fault.at(table.line, None).of(table.file));
    }
    let in_degrees = looks_like(table, &ours, Dimension::Angle, MOST_RADIANS);
    let in_millimetres = looks_like(table, &ours, Dimension::Length, MOST_METRES);
    // How well lengths are known is told in their unit, if there is one.
    let length = |(name, column): &&&(String, Column)| {
        !name.starts_with('q')
            && dimension(name, None) == Some(Dimension::Length)
            && column.unit.is_some()
    };
    let lengths = ours.iter().find(length).and_then(|(_, column)| column.unit.clone());
    for (name, column) in ours {
        let kind = dimension(name, column.unit.as_deref());
        let own = column.unit.as_ref();
        let unit = match (kind, own.or_else(|| lengths.as_ref().filter(|_| name == "sigma"))) {
            (None, _) => None,
            (Some(kind), Some(found)) => Some(known(table, column, found, kind)?.name),
            (Some(Dimension::Angle), None) if in_degrees => Some("deg"),
            (Some(Dimension::Length), None) if in_millimetres => Some("mm"),
            (Some(kind), None) => Some(kind.si().name),
        };
        let header = unit.map_or(name.clone(), |unit| format!("{name}[{unit}]"));
        said.push(format!("`{}` is {header}{}", column.header, column.law()));
        let cell: Cell<'_> = match kind {
            None => Box::new(|row| Ok(table.text(row, column.index).into_owned())),
            Some(Dimension::Time) => Box::new(|row| {
                let clock = clock::seconds(&table.text(row, column.index));
                Ok(written(clock.map_or_else(|| column.number(table, row), |s| Ok(Some(s)))?))
            }),
            Some(_) => Box::new(|row| Ok(written(column.number(table, row)?))),
        };
        outputs.push(Output { header, cell });
    }
    if in_degrees {
        said.push(
            "angles without a unit are taken for degrees: one would be more than two turns"
                .to_owned(),
        );
    }
    if in_millimetres {
        said.push(
            "lengths without a unit are taken for millimetres: one is more than 20 m".to_owned(),
        );
    }
    if let Some(turn) = &turn {
        said.push(orientation(table, turn, &mut outputs)?);
    }
    if let Some(load) = &columns.load {
        said.push(match names_loads(table, load) {
            true => payload(table, load, &mut outputs),
            false => weight(table, load, columns, map, &mut outputs)?,
        });
    }
    for column in &columns.kept {
        let bare = names::split(&column.header).0.replace(['[', ']'], " ");
        let clash = names::meaning(&bare).is_some();
        let name = if clash { format!("raw_{}", bare.trim()) } else { bare.trim().to_owned() };
        let unit = column.unit.as_deref().and_then(Unit::named);
        let header = unit.map_or(name.clone(), |unit| format!("{name}[{}]", unit.name));
        let near = nearest_name(&bare, &names::ANY).filter(|_| !clash);
        let meant = did_you_mean(near.as_deref());
        said.push(format!(
            "`{}` is kept as `{header}`: nothing is known of it{meant}",
            column.header
        ));
        let cell: Cell<'_> = Box::new(|row| Ok(table.text(row, column.index).into_owned()));
        outputs.push(Output { header, cell });
    }
    let mut writer = csv::Writer::from_writer(Vec::new());
    let (mut mistakes, mut rows) = (Mistakes::default(), 0);
    // Into memory nothing fails.
    let _ = writer.write_record(outputs.iter().map(|o| &o.header));
    let read = table.each(|row| {
        if row.cells.iter().all(|cell| cell.is_empty()) {
            return;
        }
        rows += 1;
        for output in &outputs {
            match (output.cell)(row) {
                Ok(cell) => {
                    let _ = writer.write_field(cell);
                }
                Err(mistake) => mistakes.add(mistake),
            }
        }
        let _ = writer.write_record(None::<&[u8]>);
    });
    mistakes.extend(read.err());
    mistakes.check(table.file)?;
    said.push(format!("{rows} row{}", if rows == 1 { "" } else { "s" }));
    let csv = String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default();
    Ok(Imported { csv, said })
}

/// Rotation vectors in the place of the convention's numbers.
fn orientation<'a>(
    table: &'a Table<'_>,
    turn: &'a Turn,
    outputs: &mut Vec<Output<'a>>,
) -> Result<String, ReadError> {
    let Turn { convention, columns } = turn;
    let mut factors = Vec::new();
    for column in columns {
        factors.push(match (&column.unit, convention) {
            (Some(found), of) if *of != Convention::Quaternion => {
                known(table, column, found, Dimension::Angle)?
            }
            // Who writes three angles writes degrees, unless all of them could be radians.
            (None, of) if *of != Convention::Quaternion && beyond(table, columns, TAU) => {
                Unit { factor: 1_f64.to_radians(), name: "deg", ..Dimension::Angle.si() }
            }
            _ => Dimension::Angle.si(),
        });
    }
    let headers: Vec<String> = columns.iter().map(|c| format!("`{}`", c.header)).collect();
    let unit = match convention {
        Convention::Quaternion => String::new(),
        _ => format!(", in {}", factors[0].name),
    };
    for axis in 0..3 {
        let factors = factors.clone();
        let cell = move |row: &Row<'_>| {
            let each = columns.iter().zip(&factors).map(|(column, unit)| {
                Ok::<_, Mistake>(column.number(table, row)?.map(|number| unit.factor * number))
            });
            let numbers: Option<Vec<f64>> = each.collect::<Result<_, _>>()?;
            Ok(written(numbers.and_then(|of| Some(convention.rotation(&of)?[axis]))))
        };
        let header = ["rx[rad]", "ry[rad]", "rz[rad]"][axis].to_owned();
        outputs.push(Output { header, cell: Box::new(cell) });
    }
    let order = convention.words();
    Ok(format!("{} are rx, ry, rz: {order}{unit}", headers.join(", ")))
}

/// Whether a column has names of loads and no number.
fn names_loads(table: &Table<'_>, load: &Column) -> bool {
    let seen = table.seen[load.index];
    load.unit.is_none() && seen.has_words && !seen.has_numbers
}

/// What hangs on the tool, by the robot file's names.
fn payload<'a>(table: &'a Table<'_>, load: &'a Column, outputs: &mut Vec<Output<'a>>) -> String {
    let cell = |row: &Row<'_>| Ok(table.text(row, load.index).into_owned());
    outputs.push(Output { header: "payload".to_owned(), cell: Box::new(cell) });
    format!("`{}` is payload: the names of [[payload]] in the robot file", load.header)
}

/// The weight of a mass on the tool.
fn weight<'a>(
    table: &'a Table<'_>,
    mass: &'a Column,
    columns: &Columns,
    map: &Map,
    outputs: &mut Vec<Output<'a>>,
) -> Result<String, ReadError> {
    let force = columns.ours.iter().find(|(n, _)| WRENCH_NAMES[..3].contains(&n.as_str()));
    if let Some((name, _)) = force {
        let found = format!("both `{}` and `{name}`", mass.header);
        let expected = "one load: a mass, or a force";
        let fault = Fault::new(found, expected, "say which in the map");
        return Err(fault.at(table.line, None).of(table.file));
    }
    let unit = mass.unit.as_ref().map(|found| known(table, mass, found, Dimension::Mass));
    let kilograms = unit.transpose()?.map_or(1.0, |unit| unit.factor);
    let gravity = Vector3::from(map.gravity.unwrap_or(GRAVITY)) * kilograms;
    for axis in 0..3 {
        let cell = move |row: &Row<'_>| {
            Ok(written(mass.number(table, row)?.map(|m| m * gravity[axis] + 0.0)))
        };
        let header = format!("{}[N]", WRENCH_NAMES[axis]);
        outputs.push(Output { header, cell: Box::new(cell) });
    }
    Ok(format!("`{}` is a mass at the tool origin: fx, fy, fz are its weight", mass.header))
}

/// Whether a number of these columns is larger than `most`.
fn beyond(table: &Table<'_>, columns: &[Column], most: f64) -> bool {
    columns.iter().any(|column| table.seen[column.index].most > most)
}

/// Whether the columns of a dimension without a unit hold a number that its SI unit rules out.
fn looks_like(table: &Table<'_>, ours: &[&(String, Column)], of: Dimension, most: f64) -> bool {
    let bare =
        ours.iter().filter(|(name, c)| c.unit.is_none() && dimension(name, None) == Some(of));
    let bare: Vec<Column> = bare.map(|(_, c)| c.clone()).collect();
    beyond(table, &bare, most)
}

fn known(
    table: &Table<'_>,
    column: &Column,
    found: &str,
    kind: Dimension,
) -> Result<Unit, ReadError> {
    let here = io::Column { number: column.index + 1, header: column.header.clone() };
    let unit = kind.unit(found, Unit::spelled);
    unit.map_err(|fault| fault.at(table.line, Some(here)).of(table.file))
}

/// The cell of a number; empty without one.
fn written(number: Option<f64>) -> String {
    number.map_or_else(String::new, |number| number.to_string())
}

impl Column {
    /// The number of a row in the column's unit; `None` of a cell that holds none.
    fn number(&self, table: &Table<'_>, row: &Row<'_>) -> Result<Option<f64>, Mistake> {
        let found = table.number(row, self.index)?;
        Ok(found.map(|number| self.factor * number + self.offset))
    }
}

/// Joints, loads, the rest, what was measured.
fn order(name: &str) -> (usize, usize) {
    let number = |rest: &str| rest.parse().ok();
    let numbered = |letter: char| name.strip_prefix(letter).and_then(number);
    match (numbered('q'), numbered('s'), WRENCH_NAMES.iter().position(|n| *n == name)) {
        (Some(n), ..) => (0, n),
        (_, Some(n), _) => (1, n),
        (.., Some(k)) => (2, k),
        _ => (3, 0),
    }
}
