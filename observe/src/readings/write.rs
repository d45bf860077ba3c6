//! The rows of a table as those of a measurement file.

use core::cell::Cell as Held;
use core::f64::consts::TAU;
use std::io::Write;

use nalgebra::Vector3;

use super::clock::{Clock, DAY, days};
use super::columns::{Column, Columns, dimension};
use super::map::Map;
use super::sheet::{Row, Table};
use super::turn::Turn;
use super::{Stopped, counted, names};
use crate::io::cell::is_none;
use crate::io::{Convention, Dimension, Fault, Mistake, Mistakes, ReadError, Unit, did_you_mean};
use crate::measurement::{MOST_RADIANS, POSE_NAMES, Role, WRENCH_NAMES, nearest_name};

/// Weight of a kilogram where the map says nothing, base axes, m/s².
const GRAVITY: [f64; 3] = [0.0, 0.0, -9.806_65];

/// A tool that is farther away than any arm reaches is in millimetres.
const MOST_METRES: f64 = 20.0;

/// Days since 1900 of this century, as spreadsheets count them.
const CENTURY: [f64; 2] = [36_526.0, 73_050.0];

/// Nobody measures more often at rest, s.
const FASTEST: f64 = 0.1;

/// What is written of a row in one column; of a row of several points, of the point with this number.
type Cell<'a> = Box<dyn Fn(&Row<'_>, usize) -> Result<String, Mistake> + 'a>;

/// One column of what is written.
struct Output<'a> {
    header: String,
    cell: Cell<'a>,
}

/// Writes the rows, and says what was done.
///
/// # Errors
/// [`Stopped`]: mistakes of the rows, or a sink that takes no more.
pub(super) fn write(
    table: &Table<'_>,
    columns: &Columns,
    turn: Option<&Turn>,
    map: &Map,
    sink: &mut dyn Write,
) -> Result<Vec<String>, Stopped> {
    let (outputs, mut said) = outputs(table, columns, turn, map)?;
    let mut writer = csv::Writer::from_writer(sink);
    let (mut mistakes, mut rows) = (Mistakes::default(), 0);
    let mut wrote = writer.write_record(outputs.iter().map(|o| &o.header));
    let read = table.each(|row| {
        for point in 0..columns.points.len().max(1) {
            // A beam that was cut leaves the cells of its point empty.
            let axes = columns.points.get(point).map(|(_, axes)| axes);
            if axes.is_some_and(|axes| axes.iter().all(|c| is_none(&table.text(row, c.index)))) {
                continue;
            }
            rows += 1;
            for output in &outputs {
                match (output.cell)(row, point) {
                    Ok(cell) if wrote.is_ok() => wrote = writer.write_field(cell),
                    Ok(_) => {}
                    Err(mistake) => mistakes.add(mistake),
                }
            }
            if wrote.is_ok() {
                wrote = writer.write_record(None::<&[u8]>);
            }
        }
    });
    mistakes.extend(read.err());
    mistakes.check(table.file)?;
    wrote.map_err(std::io::Error::from)?;
    writer.flush()?;
    said.push(counted(rows));
    Ok(said)
}

/// What is written of each row, and what was done for it.
fn outputs<'a>(
    table: &'a Table<'_>,
    columns: &'a Columns,
    turn: Option<&'a Turn>,
    map: &Map,
) -> Result<(Vec<Output<'a>>, Vec<String>), ReadError> {
    let mut said = table.said.clone();
    let turned = turn.map_or(&[][..], |t| &t.columns);
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
    let points: Vec<Column> = columns.points.iter().flat_map(|(_, axes)| axes).cloned().collect();
    let bare: Vec<Column> = points.iter().filter(|c| c.unit.is_none()).cloned().collect();
    let in_millimetres = looks_like(table, &ours, Dimension::Length, MOST_METRES)
        || beyond(table, &bare, MOST_METRES);
    let date = columns.date.as_ref();
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
            (Some(Dimension::Time), None) if in_days(table, column)? => {
                let so =
                    "are taken for a spreadsheet's days: as seconds rows would follow too fast";
                said.push(format!("the numbers of `{}` {so}", column.header));
                Some("d")
            }
            (Some(Dimension::Length), None) if in_millimetres => Some("mm"),
            (Some(kind), None) => Some(kind.si().name),
        };
        let header = unit.map_or(name.clone(), |unit| format!("{name}[{unit}]"));
        said.push(format!("`{}` is {header}{}", column.header, column.law()));
        let cell: Cell<'_> = match kind {
            None => Box::new(|row, _| Ok(table.text(row, column.index).into_owned())),
            Some(Dimension::Time) => time(table, column, date),
            Some(_) => Box::new(|row, _| Ok(written(column.number(table, row)?))),
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
    if let Some(date) = date {
        said.push(format!("`{}` is the day of the time", date.header));
    }
    if let Some((_, axes)) = columns.points.first() {
        for axis in 0..3 {
            let unit = match &axes[axis].unit {
                Some(found) => known(table, &axes[axis], found, Dimension::Length)?.name,
                None if in_millimetres => "mm",
                None => "m",
            };
            let factor = Unit::named(unit).map_or(1.0, |unit| unit.factor);
            let mut factors = Vec::new();
            for (_, axes) in &columns.points {
                let found = axes[axis].unit.as_deref().unwrap_or(unit);
                let own = known(table, &axes[axis], found, Dimension::Length)?;
                factors.push(if own.name == unit { 1.0 } else { own.factor / factor });
            }
            let cell = move |row: &Row<'_>, point: usize| {
                let number = columns.points[point].1[axis].number(table, row)?;
                Ok(written(number.map(|number| factors[point] * number)))
            };
            let header = format!("{}[{unit}]", POSE_NAMES[axis]);
            outputs.push(Output { header, cell: Box::new(cell) });
        }
        let marker = |_: &Row<'_>, point: usize| Ok(columns.points[point].0.clone());
        outputs.push(Output { header: "marker".to_owned(), cell: Box::new(marker) });
        let named: Vec<&str> = columns.points.iter().map(|(name, _)| name.as_str()).collect();
        said.push(format!(
            "each row has {} points, which are rows of their own with the markers {}",
            named.len(),
            named.join(", ")
        ));
    }
    if let Some(turn) = turn {
        said.push(orientation(table, turn, &mut outputs)?);
    } else {
        said.extend(in_degrees_about(columns));
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
        let kept = format!("`{}` is kept as `{header}`: nothing", column.header);
        let acts = |unit: &Unit| unit.dimension.acts() || unit.dimension == Dimension::Length;
        said.push(match unit.filter(acts) {
            None => format!("{kept} is known of it{meant}"),
            Some(unit) => format!(
                "{kept} uses it, and it is {}: if it acts on the arm, name it in a map, else `ignore` \
                 it{meant}",
                unit.dimension
            ),
        });
        let cell: Cell<'_> = Box::new(|row, _| Ok(table.text(row, column.index).into_owned()));
        outputs.push(Output { header, cell });
    }
    for (header, cell) in &map.set {
        let cell = set(table, columns, header, &cell.0).map_err(|fault| fault.of(table.file))?;
        said.push(format!("{header} is `{cell}` in every row"));
        let cell = move |_: &Row<'_>, _: usize| Ok(cell.clone());
        outputs.push(Output { header: header.clone(), cell: Box::new(cell) });
    }
    said.extend((!map.ignore.is_empty()).then(|| format!("{} not kept", map.ignore.join(", "))));
    Ok((outputs, said))
}

/// What stands in every row of a column that is set.
fn set(table: &Table<'_>, columns: &Columns, header: &str, cell: &str) -> Result<String, Fault> {
    let name = names::split(header).0;
    let is_ours = Role::of(name, &names::ANY).is_ok_and(|role| role != Role::Extra);
    if !is_ours && name.strip_prefix('q').is_none_or(|n| n.parse::<usize>().is_err()) {
        let meant = did_you_mean(nearest_name(name, &names::ANY).as_deref());
        let found = format!("`{header}` that is set");
        return Err(Fault::new(found, format!("a column of a measurement file{meant}"), ""));
    }
    if columns.ours.iter().any(|(ours, _)| ours == name) {
        let found = format!("`{header}` that is set, and is in the table");
        return Err(Fault::new(found, "one of them", "`ignore` the table's in a map"));
    }
    let stem = std::path::Path::new(table.file).file_stem().unwrap_or_default();
    Ok(cell.replace("{file}", &stem.to_string_lossy()))
}

/// The cell of a time: of a number as it stands, of a time of day in seconds, with its `date` if that stands
/// by itself; at midnight the next day begins.
fn time<'a>(table: &'a Table<'_>, column: &'a Column, date: Option<&'a Column>) -> Cell<'a> {
    let (last, begun) = (Held::new(f64::NEG_INFINITY), Held::new(0.0));
    Box::new(move |row, _| {
        let clock = Clock::of(&table.text(row, column.index));
        let Some(date) = date else {
            let Some(Clock { seconds, dated }) = clock else {
                return Ok(written(column.number(table, row)?));
            };
            let seconds = column.factor * seconds + column.offset;
            if !dated && seconds < last.get() - DAY / 2.0 {
                begun.set(begun.get() + DAY);
            }
            last.set(seconds);
            return Ok(written(Some(seconds + begun.get())));
        };
        let day = match days(&table.text(row, date.index)) {
            Some(days) => Some(DAY * days),
            // A workbook's are seconds already, a spreadsheet's text has days.
            None => date.number(table, row)?.map(|n| if n <= CENTURY[1] { DAY * n } else { n }),
        };
        let of_day = match clock {
            Some(clock) => Some(column.factor * clock.seconds + column.offset),
            None => column.number(table, row)?,
        };
        Ok(written(day.zip(of_day).map(|(day, of_day)| day + of_day)))
    })
}

/// Whether numbers without a unit that count days of this century would follow each other too fast as
/// seconds.
fn in_days(table: &Table<'_>, column: &Column) -> Result<bool, ReadError> {
    let seen = table.seen[column.index];
    if seen.least < CENTURY[0] || seen.most > CENTURY[1] || seen.has_words {
        return Ok(false);
    }
    let mut rows = 0.0;
    table.each(|_| rows += 1.0).map_err(|mistake| mistake.of(table.file))?;
    Ok(seen.most > seen.least && seen.most - seen.least < FASTEST * rows)
}

/// A doubt where three angles in degrees are taken for a rotation vector, which programs write in radians.
fn in_degrees_about(columns: &Columns) -> Option<String> {
    let angle = |name: &str| columns.ours.iter().find(|(ours, _)| ours == name).map(|(_, c)| c);
    let axes = [angle("rx")?, angle("ry")?, angle("rz")?];
    if axes.iter().all(|column| column.unit.as_deref() != Some("deg")) {
        return None;
    }
    let headers = axes.map(|column| format!("`{}`", column.header)).join(", ");
    Some(format!(
        "{headers} are taken for a rotation vector (axis times angle), which is seldom in degrees: if they \
         are turns about axes, say `orientation = \"zyx\"` or the like in a map"
    ))
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
        factors.push(match (&column.unit, convention.has_angles()) {
            (Some(found), true) => known(table, column, found, Dimension::Angle)?,
            // Who writes three angles writes degrees, unless all of them could be radians.
            (None, true) if beyond(table, columns, TAU) => {
                Unit { factor: 1_f64.to_radians(), name: "deg", ..Dimension::Angle.si() }
            }
            _ => Dimension::Angle.si(),
        });
    }
    let headers: Vec<String> = columns.iter().map(|c| format!("`{}`", c.header)).collect();
    let unit = match convention.has_angles() {
        false => String::new(),
        true => format!(", in {}", factors[0].name),
    };
    for axis in 0..3 {
        let factors = factors.clone();
        let cell = move |row: &Row<'_>, _: usize| {
            let each = columns.iter().zip(&factors).map(|(column, unit)| {
                Ok::<_, Mistake>(column.number(table, row)?.map(|number| unit.factor * number))
            });
            let numbers: Option<Vec<f64>> = each.collect::<Result<_, _>>()?;
            // A program that has lost its target writes zeros.
            let Some(numbers) = numbers
                .filter(|n| *convention != Convention::Quaternion || n.iter().any(|x| *x != 0.0))
            else {
                return Ok(String::new());
            };
            let rotation = convention.rotation(&numbers).ok_or_else(|| {
                let fault = Fault::new("numbers of no rotation", convention.formula(&[]), "");
                fault.at(row.line, Some(table.column(columns[0].index)))
            })?;
            Ok(written(Some(rotation[axis])))
        };
        let header = ["rx[rad]", "ry[rad]", "rz[rad]"][axis].to_owned();
        outputs.push(Output { header, cell: Box::new(cell) });
    }
    let names: Vec<&str> = columns.iter().map(|c| names::split(&c.header).0).collect();
    Ok(format!("{} are rx, ry, rz: {}{unit}", headers.join(", "), convention.formula(&names)))
}

/// Whether a column has names of loads and no number.
fn names_loads(table: &Table<'_>, load: &Column) -> bool {
    let seen = table.seen[load.index];
    load.unit.is_none() && seen.has_words && !seen.has_numbers
}

/// What hangs on the tool, by the robot file's names.
fn payload<'a>(table: &'a Table<'_>, load: &'a Column, outputs: &mut Vec<Output<'a>>) -> String {
    let cell = |row: &Row<'_>, _: usize| Ok(table.text(row, load.index).into_owned());
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
        let cell = move |row: &Row<'_>, _: usize| {
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
    let here = table.column(column.index);
    let unit = kind.unit(found, Unit::spelled);
    unit.map_err(|fault| fault.at(table.line, Some(here)).of(table.file))
}

/// The cell of a number; empty without one.
fn written(number: Option<f64>) -> String {
    number.map_or_else(String::new, |number| number.to_string())
}

impl Column {
    /// The number of a row in the column's unit; `None` of a cell that holds none.
    pub(super) fn number(&self, table: &Table<'_>, row: &Row<'_>) -> Result<Option<f64>, Mistake> {
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
