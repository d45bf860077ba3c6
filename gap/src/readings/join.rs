//! Two tables side by side: a tracker's and a controller's, by the order of their rows, by time, or by a
//! column that both have.

use std::borrow::Cow;
use std::collections::HashMap;

use super::clock::Clock;
use super::columns::{Column, dimension};
use super::counted;
use super::names::{self, Meaning};
use super::sheet::{Row, Seen, Table, is_none};
use crate::io::{Fault, Mistake, Mistakes, ReadError, Unit};

/// Which rows belong together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum By {
    /// Row by row.
    Row,
    /// By their columns of time: what the other table has between two of its times is interpolated.
    Time,
    /// Those in which this column, which both have, says the same.
    Column(String),
}

impl From<String> for By {
    fn from(word: String) -> By {
        match word.as_str() {
            "row" => By::Row,
            "time" => By::Time,
            _ => By::Column(word),
        }
    }
}

/// What a table gets from another one.
#[derive(Clone, Debug)]
pub(super) struct Join<'t> {
    file: &'t str,
    pub columns: Vec<Beside>,
    /// Of each row the cells of these columns.
    rows: Vec<Vec<String>>,
    key: Key,
}

/// A column of the other table.
#[derive(Clone, Debug)]
pub(super) struct Beside {
    pub name: String,
    pub unit: String,
    pub seen: Seen,
    /// Whether it has a value between two rows.
    between: bool,
}

/// How the row that belongs to one is found.
#[derive(Clone, Debug)]
enum Key {
    Row,
    /// The column of ours, as seconds, and the times of the other's rows, s, increasing.
    Time(Column, Vec<f64>),
    /// The column of ours, and which row of the other's has which cell.
    Column(usize, HashMap<String, usize>),
}

/// What belongs to a row of ours.
pub(super) enum Met {
    Row(usize),
    /// A part of the way from this row to the next.
    Behind(usize, f64),
}

/// `ours` with the columns of `other` that it has not itself.
///
/// # Errors
/// [`ReadError`]: rows that do not belong together.
pub(super) fn join<'t>(
    ours: Table<'t>,
    other: &Table<'t>,
    by: &By,
) -> Result<Table<'t>, ReadError> {
    let meaning = |name: &String| names::meaning(names::split(name).0);
    let known: Vec<Option<Meaning>> = ours.names.iter().map(meaning).collect();
    let (mut mistakes, mut said) = (Mistakes::default(), Vec::new());
    let keys =
        match by {
            By::Row => None,
            By::Time => Some([&ours, other].map(|table| {
                let is = |name: &String| meaning(name) == Some(Meaning::Ours("time".to_owned()));
                at(table, "time", is)
            })),
            By::Column(name) => Some([&ours, other].map(|table| {
                at(table, name, |found| found == name || names::split(found).0 == name)
            })),
        };
    let keys = match keys {
        Some([mine, theirs]) => Some((mine?, theirs?)),
        None => None,
    };
    let mut taken: Vec<usize> = Vec::new();
    for (k, name) in other.names.iter().enumerate() {
        let again =
            ours.names.contains(name) || meaning(name).is_some_and(|m| known.contains(&Some(m)));
        if name.is_empty() || keys.is_some_and(|(_, theirs)| theirs == k) {
            continue;
        }
        if again {
            said.push(format!("`{name}` of {} is left out: {} has it", other.file, ours.file));
        } else {
            taken.push(k);
        }
    }
    let timed = keys.filter(|_| *by == By::Time);
    let timed = timed.map(|(mine, theirs)| (timing(&ours, mine), timing(other, theirs)));
    let (mut rows, mut times, mut cells) = (Vec::new(), Vec::new(), HashMap::new());
    let read = other.each(|row| {
        if row.cells.iter().all(|cell| cell.is_empty()) {
            return;
        }
        match (keys, &timed) {
            (Some((_, theirs)), Some((_, time))) => match seconds(other, row, time) {
                Ok(time) if times.last().is_none_or(|last| *last <= time) => times.push(time),
                Ok(_) => {
                    let fault =
                        Fault::new("a time before that of the row above", "a later one", "");
                    mistakes.add(fault.at(row.line, Some(other.column(theirs))));
                }
                Err(mistake) => mistakes.add(mistake),
            },
            (Some((_, theirs)), None) => {
                let key = other.text(row, theirs).into_owned();
                if cells.insert(key.clone(), rows.len()).is_some() {
                    let fault = Fault::new(format!("`{key}` again"), "it in one row", "");
                    mistakes.add(fault.at(row.line, Some(other.column(theirs))));
                }
            }
            (None, _) => {}
        }
        rows.push(taken.iter().map(|k| other.text(row, *k).into_owned()).collect());
    });
    mistakes.extend(read.err());
    mistakes.check(other.file)?;
    let beside = |k: &usize| {
        let (name, unit) = (other.names[*k].clone(), other.units.get(*k).cloned());
        let quantity = |m: Meaning| dimension(&m.name(), None).is_some();
        Beside {
            between: meaning(&name).is_some_and(quantity),
            unit: unit.unwrap_or_default(),
            seen: other.seen[*k],
            name,
        }
    };
    let key = match (keys, timed) {
        (_, Some((mine, _))) => Key::Time(mine, times),
        (Some((mine, _)), None) => Key::Column(mine, cells),
        (None, None) => Key::Row,
    };
    let join = Join { file: other.file, columns: taken.iter().map(beside).collect(), rows, key };
    said.extend(join.met(&ours)?);
    Ok(ours.joined(join, said))
}

/// The column of a table by which it is joined.
fn at(table: &Table<'_>, name: &str, is: impl Fn(&String) -> bool) -> Result<usize, ReadError> {
    table.names.iter().position(is).ok_or_else(|| {
        let fault = Fault::new(format!("no column `{name}`"), "it in both tables", "");
        fault.at(table.line, None).of(table.file)
    })
}

/// A column of times as seconds.
fn timing(table: &Table<'_>, index: usize) -> Column {
    let column = Column::new(table, index);
    let unit = column.unit.as_deref().and_then(Unit::named);
    Column { factor: unit.map_or(1.0, |unit| unit.factor), ..column }
}

/// The time of a row, s.
fn seconds(table: &Table<'_>, row: &Row<'_>, time: &Column) -> Result<f64, Mistake> {
    if let Some(clock) = Clock::of(&table.text(row, time.index)) {
        return Ok(clock.seconds);
    }
    let here = || table.column(time.index);
    let none = || Fault::new("no time", "one", "").at(row.line, Some(here()));
    time.number(table, row)?.ok_or_else(none)
}

impl Join<'_> {
    /// What is to be said of the rows that have met.
    fn met(&self, ours: &Table<'_>) -> Result<Vec<String>, ReadError> {
        let (mut rows, mut met, mut mistakes) = (0, 0, Mistakes::default());
        let read = ours.each(|row| {
            if row.cells.iter().all(|cell| cell.is_empty()) {
                return;
            }
            match self.meets(ours, rows, row) {
                Ok(found) => met += usize::from(found.is_some()),
                Err(mistake) => mistakes.add(mistake),
            }
            rows += 1;
        });
        mistakes.extend(read.err());
        mistakes.check(ours.file)?;
        let all = self.rows.len();
        if matches!(self.key, Key::Row) && rows != all {
            let help = "join by a column that both have, or by time";
            let expected = format!("{all} as in {}", self.file);
            return Err(Fault::new(counted(rows), expected, help).of(ours.file));
        }
        if met == 0 {
            let fault =
                Fault::new(format!("no row that belongs to one of {}", self.file), "some", "");
            return Err(fault.of(ours.file));
        }
        let mut said =
            vec![format!("{} of {} met by one of {}", counted(met), ours.file, self.file)];
        if met < rows {
            let left = counted(rows - met);
            said.push(format!("left out: {left} of {}, which meets none", ours.file));
        }
        Ok(said)
    }

    /// What belongs to a row of ours, the one so many from the first.
    pub(super) fn meets(
        &self,
        ours: &Table<'_>,
        number: usize,
        row: &Row<'_>,
    ) -> Result<Option<Met>, Mistake> {
        Ok(match &self.key {
            Key::Row => (number < self.rows.len()).then_some(Met::Row(number)),
            Key::Column(mine, cells) => cells.get(&*ours.text(row, *mine)).map(|k| Met::Row(*k)),
            Key::Time(mine, times) => {
                let time = seconds(ours, row, mine)?;
                let next = times.partition_point(|other| *other < time);
                match (next.checked_sub(1), times.get(next)) {
                    (_, Some(exact)) if *exact == time => Some(Met::Row(next)),
                    (Some(before), Some(behind)) => {
                        let part = (time - times[before]) / (behind - times[before]);
                        Some(Met::Behind(before, part))
                    }
                    // What lies before the first or behind the last row is in none.
                    _ => None,
                }
            }
        })
    }

    /// The cells of it.
    pub(super) fn cells(&self, met: &Met) -> Vec<Cow<'_, str>> {
        let (before, part) = match met {
            Met::Row(row) => return self.rows[*row].iter().map(Cow::from).collect(),
            Met::Behind(before, part) => (*before, *part),
        };
        let near = &self.rows[if part < 0.5 { before } else { before + 1 }];
        let each = self.columns.iter().zip(near).enumerate().map(|(k, (column, near))| {
            let value = |row: usize| {
                let cell = &self.rows[row][k];
                cell.parse::<f64>().ok().filter(|_| !is_none(cell))
            };
            let both = value(before).zip(value(before + 1)).filter(|_| column.between);
            let between = both.map(|(a, b)| a + part * (b - a));
            between.map_or(Cow::Borrowed(&**near), |value| Cow::Owned(value.to_string()))
        });
        each.collect()
    }
}
