//! The rows of a table as those of a measurement file.

use nalgebra::Vector3;

use super::columns::{Column, Columns, dimension};
use super::map::{Convention, Map};
use super::sheet::{Cells, Table};
use super::turn::Turn;
use super::{ImportError, Imported, names};
use crate::measurement::{Dimension, MOST_RADIANS, Unit, WRENCH_NAMES, nearest_name};

/// Weight of a kilogram where the map says nothing, base axes, m/s².
const GRAVITY: [f64; 3] = [0.0, 0.0, -9.806_65];

/// A tool that is farther away than any arm reaches is in millimetres.
const MOST_METRES: f64 = 20.0;

/// What is written of a row in one column.
type Cell<'a> = Box<dyn Fn(&Cells) -> Result<String, ImportError> + 'a>;

/// One column of what is written.
struct Output<'a> {
    header: String,
    cell: Cell<'a>,
}

pub(super) fn write(
    table: &Table,
    columns: &Columns,
    turn: Option<Turn>,
    map: &Map,
) -> Result<Imported, ImportError> {
    let mut said = table.said.clone();
    let turned = turn.as_ref().map_or(&[][..], |t| &t.columns);
    let is_turned = |c: &Column| turned.iter().any(|t| t.index == c.index);
    let mut outputs = Vec::new();
    let mut ours: Vec<&(String, Column)> =
        columns.ours.iter().filter(|(_, c)| !is_turned(c)).collect();
    ours.sort_by_key(|(name, c)| (order(name), c.index));
    if !ours.iter().any(|(name, _)| order(name).0 == 0) {
        let expected = "a column of each joint's reading: q1 …, J1 …, A1 …";
        return Err(ImportError::Missing { file: table.file.clone(), what: "joints", expected });
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
            (Some(kind), Some(found)) => Some(known(table, column, found, kind)?),
            (Some(Dimension::Angle), None) if in_degrees => Some("deg"),
            (Some(Dimension::Length), None) if in_millimetres => Some("mm"),
            (Some(kind), None) => Some(kind.si().name),
        };
        let header = unit.map_or(name.clone(), |unit| format!("{name}[{unit}]"));
        said.push(format!("`{}` is {header}{}", column.header, column.law()));
        let cell: Cell<'_> = match kind {
            None => Box::new(|row: &Cells| Ok(column.text(row).to_owned())),
            Some(_) => Box::new(|row: &Cells| {
                Ok(column.number(table, row)?.map_or_else(String::new, |x| x.to_string()))
            }),
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
            true => payload(load, &mut outputs),
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
        let meant = near.map_or_else(String::new, |near| format!(" (did you mean `{near}`?)"));
        said.push(format!(
            "`{}` is kept as `{header}`: nothing is known of it{meant}",
            column.header
        ));
        outputs.push(Output { header, cell: Box::new(|row| Ok(column.text(row).to_owned())) });
    }
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut put = |cells: Vec<String>| {
        // Into memory nothing fails.
        let _ = writer.write_record(cells);
    };
    put(outputs.iter().map(|o| o.header.clone()).collect());
    for row in &table.rows {
        put(outputs.iter().map(|o| (o.cell)(row)).collect::<Result<_, _>>()?);
    }
    let rows = table.rows.len();
    said.push(format!("{rows} row{}", if rows == 1 { "" } else { "s" }));
    let csv = String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default();
    Ok(Imported { csv, said })
}

/// Rotation vectors in the place of the convention's numbers.
fn orientation<'a>(
    table: &'a Table,
    turn: &'a Turn,
    outputs: &mut Vec<Output<'a>>,
) -> Result<String, ImportError> {
    let Turn { convention, columns } = turn;
    let mut factors = Vec::new();
    for column in columns {
        let text = match (&column.unit, convention) {
            (_, Convention::Quaternion) => "rad",
            (Some(found), _) => known(table, column, found, Dimension::Angle)?,
            // Who writes three angles writes degrees, unless all of them could be radians.
            (None, _) if beyond(table, columns, core::f64::consts::TAU) => "deg",
            (None, _) => "rad",
        };
        factors.push((text, Unit::named(text).map_or(1.0, |unit| unit.factor)));
    }
    let headers: Vec<String> = columns.iter().map(|c| format!("`{}`", c.header)).collect();
    let unit = match convention {
        Convention::Quaternion => String::new(),
        _ => format!(", in {}", factors[0].0),
    };
    for axis in 0..3 {
        let factors = factors.clone();
        let cell = move |row: &Cells| {
            let mut numbers = Vec::new();
            for (column, (_, factor)) in columns.iter().zip(&factors) {
                match column.number(table, row)? {
                    Some(x) => numbers.push(factor * x),
                    None => return Ok(String::new()),
                }
            }
            Ok(convention.rotation(&numbers).map_or_else(String::new, |v| v[axis].to_string()))
        };
        let header = ["rx[rad]", "ry[rad]", "rz[rad]"][axis].to_owned();
        outputs.push(Output { header, cell: Box::new(cell) });
    }
    let order = convention.words();
    Ok(format!("{} are rx, ry, rz: {order}{unit}", headers.join(", ")))
}

/// Whether a column has names of loads and no number.
fn names_loads(table: &Table, load: &Column) -> bool {
    let texts = || table.rows.iter().map(|row| load.text(row)).filter(|text| !is_none(text));
    load.unit.is_none() && texts().count() > 0 && texts().all(|text| text.parse::<f64>().is_err())
}

/// What hangs on the tool, by the robot file's names.
fn payload<'a>(load: &'a Column, outputs: &mut Vec<Output<'a>>) -> String {
    let cell = |row: &Cells| Ok(load.text(row).to_owned());
    outputs.push(Output { header: "payload".to_owned(), cell: Box::new(cell) });
    format!("`{}` is payload: the names of [[payload]] in the robot file", load.header)
}

/// The weight of a mass on the tool.
fn weight<'a>(
    table: &'a Table,
    mass: &'a Column,
    columns: &Columns,
    map: &Map,
    outputs: &mut Vec<Output<'a>>,
) -> Result<String, ImportError> {
    let force = columns.ours.iter().find(|(n, _)| WRENCH_NAMES[..3].contains(&n.as_str()));
    if let Some((name, _)) = force {
        return Err(ImportError::Twice {
            file: table.file.clone(),
            first: mass.header.clone(),
            second: name.clone(),
            ours: "the load: a mass, or a force".to_owned(),
        });
    }
    let kilograms = match mass.unit.as_deref() {
        None | Some("kg") => 1.0,
        Some("g") => 1e-3,
        Some("lb") => 0.453_592_37,
        Some(other) => {
            return Err(ImportError::Unit {
                file: table.file.clone(),
                column: mass.header.clone(),
                unit: other.to_owned(),
                known: "kg, g, lb".to_owned(),
            });
        }
    };
    let gravity = Vector3::from(map.gravity.unwrap_or(GRAVITY)) * kilograms;
    for axis in 0..3 {
        let cell = move |row: &Cells| {
            let weight = mass.number(table, row)?.map(|m| m * gravity[axis] + 0.0);
            Ok(weight.map_or_else(String::new, |w| w.to_string()))
        };
        let header = format!("{}[N]", WRENCH_NAMES[axis]);
        outputs.push(Output { header, cell: Box::new(cell) });
    }
    Ok(format!("`{}` is a mass at the tool origin: fx, fy, fz are its weight", mass.header))
}

/// Whether a number of these columns is larger than `most`.
fn beyond(table: &Table, columns: &[Column], most: f64) -> bool {
    let number = |row: &Cells, c: &Column| c.text(row).parse::<f64>().ok();
    table.rows.iter().any(|r| columns.iter().any(|c| number(r, c).is_some_and(|x| x.abs() > most)))
}

/// Whether the columns of a dimension without a unit hold a number that its SI unit rules out.
fn looks_like(table: &Table, ours: &[&(String, Column)], of: Dimension, most: f64) -> bool {
    let bare =
        ours.iter().filter(|(name, c)| c.unit.is_none() && dimension(name, None) == Some(of));
    let bare: Vec<Column> = bare.map(|(_, c)| c.clone()).collect();
    beyond(table, &bare, most)
}

fn known(
    table: &Table,
    column: &Column,
    found: &str,
    kind: Dimension,
) -> Result<&'static str, ImportError> {
    let unit = names::unit(found).filter(|u| Unit::named(u).is_some_and(|u| u.dimension == kind));
    unit.ok_or_else(|| ImportError::Unit {
        file: table.file.clone(),
        column: column.header.clone(),
        unit: found.to_owned(),
        known: kind.units(),
    })
}

/// Whether a cell says that it holds nothing.
fn is_none(text: &str) -> bool {
    ["", "-", "--", "na", "n/a", "nan"].contains(&text.to_lowercase().as_str())
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

impl Column {
    fn text<'a>(&self, row: &'a Cells) -> &'a str {
        row.cells.get(self.index).map_or("", String::as_str)
    }

    /// The number of a row in the column's unit; `None` of a cell that holds none.
    fn number(&self, table: &Table, row: &Cells) -> Result<Option<f64>, ImportError> {
        let text = self.text(row);
        if is_none(text) {
            return Ok(None);
        }
        match text.parse::<f64>() {
            // What needs no law keeps its digits.
            Ok(x) if x.is_finite() => Ok(Some(self.factor * x + self.offset)),
            _ => Err(ImportError::NotANumber {
                file: table.file.clone(),
                line: row.line,
                column: self.header.clone(),
                found: text.to_owned(),
            }),
        }
    }

    fn law(&self) -> String {
        match (self.factor, self.offset) {
            (1.0, 0.0) => String::new(),
            (f, 0.0) => format!(" = {f} · it"),
            (f, o) => format!(" = {f} · it + {o}"),
        }
    }
}
