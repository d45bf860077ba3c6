//! Which column is what, in which unit.

use std::collections::HashSet;

use super::ImportError;
use super::map::{Convention, Map, Theirs};
use super::names::{self, Meaning};
use super::sheet::Table;
use crate::measurement::{Dimension, Role, SIM_PREFIX, Unit, nearest};

/// One column, as it is to be read.
#[derive(Clone, Debug)]
pub(super) struct Column {
    /// Among the cells of a row.
    pub index: usize,
    /// As its header has it.
    pub header: String,
    /// As the map or the table says; `None` where neither does.
    pub unit: Option<String>,
    /// Ours = factor · theirs + offset, in the unit.
    pub factor: f64,
    pub offset: f64,
}

/// All of them.
#[derive(Clone, Debug, Default)]
pub(super) struct Columns {
    /// Columns of the measurement file by their names there, and theirs.
    pub ours: Vec<(String, Column)>,
    /// The numbers of an orientation that is to be turned, and which of it each is.
    pub orientation: Vec<(Convention, usize, Column)>,
    pub load: Option<Column>,
    /// What is kept as it stands.
    pub kept: Vec<Column>,
}

impl Columns {
    /// # Errors
    /// [`ImportError`]: a column that the map names and the table has not, or one that stands twice.
    pub(super) fn of(table: &Table, map: &Map) -> Result<Columns, ImportError> {
        let mut columns = Columns::default();
        let mut free: Vec<Option<Column>> =
            (0..table.header.cells.len()).map(|index| Some(Column::new(table, index))).collect();
        let mut given = HashSet::new();
        for (ours, theirs) in &map.columns {
            let meaning = named(ours).ok_or_else(|| unknown(map, ours))?;
            let found = position(table, theirs).and_then(|index| free[index].take());
            let mut column = found.ok_or_else(|| no_column(table, map, ours, theirs))?;
            column.unit = theirs.unit.clone().or(column.unit);
            (column.factor, column.offset) = (theirs.factor, theirs.offset);
            given.insert(meaning.key());
            columns.take(&table.file, meaning, column)?;
        }
        let meant: Vec<(Column, Option<Meaning>)> = free
            .into_iter()
            .flatten()
            .filter(|column| !column.header.is_empty())
            .map(|column| (column.clone(), names::meaning(names::split(&column.header).0)))
            .collect();
        // A program that has a joint 0 counts all of them from there.
        let from_zero = meant.iter().any(|(_, m)| *m == Some(Meaning::FromZero(0)));
        for (column, meaning) in meant {
            let meaning = meaning.map(|m| if from_zero { m.after_zero() } else { m });
            match meaning.filter(|m| !given.contains(&m.key())) {
                Some(meaning) => columns.take(&table.file, meaning, column)?,
                None => columns.kept.push(column),
            }
        }
        Ok(columns)
    }

    fn take(&mut self, file: &str, meaning: Meaning, column: Column) -> Result<(), ImportError> {
        let twice = |first: &Column, ours: &str| {
            Err(ImportError::Twice {
                file: file.to_owned(),
                first: first.header.clone(),
                second: column.header.clone(),
                ours: ours.to_owned(),
            })
        };
        match meaning {
            Meaning::Ours(name) => match self.ours.iter().find(|(n, _)| *n == name) {
                Some((_, first)) => twice(first, &name),
                None => {
                    self.ours.push((name, column));
                    Ok(())
                }
            },
            Meaning::FromZero(index) => {
                self.take(file, Meaning::Ours(format!("q{}", index + 1)), column)
            }
            Meaning::Orientation(convention, k) => {
                let same = |(c, n, _): &&(Convention, usize, Column)| (*c, *n) == (convention, k);
                match self.orientation.iter().find(same) {
                    Some((_, _, first)) => twice(first, "one number of the orientation"),
                    None => {
                        self.orientation.push((convention, k, column));
                        Ok(())
                    }
                }
            }
            Meaning::Load => match &self.load {
                Some(first) => twice(first, "the load on the tool"),
                None => {
                    self.load = Some(column);
                    Ok(())
                }
            },
        }
    }
}

impl Column {
    fn new(table: &Table, index: usize) -> Column {
        let header = table.header.cells[index].clone();
        let below = table.units.get(index).and_then(|text| names::unit(text)).map(str::to_owned);
        let written = names::split(&header).1;
        let within = written.map(|text| names::unit(text).unwrap_or(text).to_owned());
        Column { index, unit: within.or(below), header, factor: 1.0, offset: 0.0 }
    }
}

impl Meaning {
    /// The same for columns that mean the same.
    fn key(&self) -> String {
        match self {
            Meaning::Ours(name) => name.clone(),
            Meaning::FromZero(index) => format!("q{}", index + 1),
            Meaning::Orientation(convention, k) => format!("{convention:?} {k}"),
            Meaning::Load => "load".to_owned(),
        }
    }

    /// A joint's reading where joints count from 0.
    fn after_zero(self) -> Meaning {
        let number = match &self {
            Meaning::Ours(name) => name.strip_prefix('q').and_then(|n| n.parse::<usize>().ok()),
            _ => None,
        };
        number.map_or(self, |n| Meaning::Ours(format!("q{}", n + 1)))
    }
}

/// What a name of ours stands for in a map.
fn named(ours: &str) -> Option<Meaning> {
    match names::meaning(ours)? {
        // Here only the measurement file's own names count, not what others call them.
        Meaning::Ours(name) if name != ours => None,
        meaning => Some(meaning),
    }
}

/// The quantity of a column of ours; a joint's is an angle unless its unit is a length.
pub(super) fn dimension(ours: &str, unit: Option<&str>) -> Option<Dimension> {
    let name = ours.strip_prefix(SIM_PREFIX).unwrap_or(ours);
    if name.starts_with('q') {
        let found = unit.and_then(Unit::named).map(|unit| unit.dimension);
        return Some(found.filter(|d| *d == Dimension::Length).unwrap_or(Dimension::Angle));
    }
    // Of what is not a joint's the reader of measurements knows the quantity, whatever the arm.
    Role::of(name, &names::ANY).ok()?.dimension(&names::ANY)
}

fn position(table: &Table, theirs: &Theirs) -> Option<usize> {
    let cells = &table.header.cells;
    let whole = cells.iter().position(|cell| *cell == theirs.column);
    whole.or_else(|| cells.iter().position(|cell| names::split(cell).0 == theirs.column))
}

fn no_column(table: &Table, map: &Map, ours: &str, theirs: &Theirs) -> ImportError {
    let known = table.header.cells.iter().map(String::as_str);
    ImportError::NoColumn {
        map: map.file.clone(),
        file: table.file.clone(),
        column: theirs.column.clone(),
        ours: ours.to_owned(),
        suggestion: nearest(&theirs.column, known).map(str::to_owned),
    }
}

fn unknown(map: &Map, ours: &str) -> ImportError {
    let message = format!(
        "found `{ours}` among the columns, expected a name of ours: q1 …, s1 …, x y z, rx ry rz, \
         dx … drz, distance, from, from_x …, sim_x …, sigma, sigma_x …, fx … mz, temperature, time, \
         pose, marker, session, payload, mass, or one number of an orientation: a b c, \
         roll pitch yaw, qw qx qy qz"
    );
    ImportError::Map { map: map.file.clone(), message }
}
