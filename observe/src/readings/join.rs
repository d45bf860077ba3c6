//! Two tables side by side: a tracker's and a controller's, by the order of their rows, by time, or by a
//! column that both have.

use std::borrow::Cow;
use std::collections::HashMap;

use super::clock::Clock;
use super::columns::{Column, dimension};
use super::counted;
use super::names::{self, Meaning};
use super::sheet::{Row, Seen, Table};
use crate::io::cell::is_none;
use crate::io::{Fault, Mistake, Mistakes, ReadError, Unit};

/// Which rows belong together.
#[derive(Clone, Debug, PartialEq)]
pub enum By {
    /// Row by row.
    Row,
    /// By their columns of time: what the other table has between two of its times is interpolated. So many seconds are added
    /// to the times of the other first.
    Time(f64),
    /// Those in which this column, which both have, says the same.
    Column(String),
}

impl From<String> for By {
    fn from(word: String) -> By {
        let shift = word.strip_prefix("time").filter(|shift| shift.starts_with(['+', '-']));
        let shift = shift.and_then(|shift| shift.trim_end_matches('s').trim().parse().ok());
        match (word.as_str(), shift) {
            ("row", _) => By::Row,
            ("time", _) => By::Time(0.0),
            (_, Some(shift)) => By::Time(shift),
            (_, None) => By::Column(word),
        }
    }
}

/// What a table gets from another one.
#[derive(Clone, Debug)]
pub(super) struct Join<'t> {
    file: &'t str,
    pub columns: Vec<Beside>,
    /// How many rows the other table has.
    count: usize,
    /// The cells of these columns.
    kept: Kept,
    key: Key,
}

/// Cells of the rows that belong to one of ours, one behind the other: a controller's log is long, and few rows of it meet
/// one of a tracker.
#[derive(Clone, Debug, Default)]
struct Kept {
    /// The numbers of the rows, rising, and where each begins.
    rows: Vec<(usize, usize)>,
    /// Where each cell of each row ends, from the beginning of the row.
    ends: Vec<u32>,
    text: String,
}

impl Kept {
    fn push<'c>(&mut self, row: usize, cells: impl Iterator<Item = Cow<'c, str>>) {
        let begin = self.text.len();
        self.rows.push((row, begin));
        for cell in cells {
            self.text.push_str(&cell);
            self.ends.push((self.text.len() - begin) as u32);
        }
    }

    /// The cells of a row that is kept.
    fn row(&self, row: usize) -> Vec<&str> {
        let at = self.rows.partition_point(|(kept, _)| *kept < row);
        let Some((_, begin)) = self.rows.get(at) else { return Vec::new() };
        let width = self.ends.len() / self.rows.len();
        let mut from = *begin;
        let cell = |end: &u32| {
            let to = begin + *end as usize;
            &self.text[core::mem::replace(&mut from, to)..to]
        };
        self.ends[at * width..(at + 1) * width].iter().map(cell).collect()
    }
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
pub(super) fn join<'t>(
    ours: Table<'t>,
    other: &Table<'t>,
    by: &By,
) -> Result<Table<'t>, ReadError> {
    let meaning = |name: &String| names::meaning(names::split(name).0);
    let known: Vec<Option<Meaning>> = ours.names.iter().map(meaning).collect();
    let (mut mistakes, mut said) = (Mistakes::default(), Vec::new());
    let is_time = |name: &String| meaning(name) == Some(Meaning::Ours("time".to_owned()));
    let keys = match by {
        By::Row => None,
        By::Time(_) => Some((at(&ours, "time", is_time)?, at(other, "time", is_time)?)),
        By::Column(name) => {
            let is = |found: &String| found == name || names::split(found).0 == name;
            Some((at(&ours, name, is)?, at(other, name, is)?))
        }
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
    let shift = if let By::Time(shift) = by { Some(*shift) } else { None };
    let timed = keys
        .zip(shift)
        .map(|((mine, theirs), shift)| (timing(&ours, mine, 0.0), timing(other, theirs, shift)));
    let (mut count, mut times, mut cells) = (0, Vec::new(), HashMap::new());
    let read = other.each(|row| {
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
                if cells.insert(key.clone(), count).is_some() {
                    let fault = Fault::new(format!("`{key}` again"), "it in one row", "");
                    mistakes.add(fault.at(row.line, Some(other.column(theirs))));
                }
            }
            (None, _) => {}
        }
        count += 1;
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
    let (columns, kept) = (taken.iter().map(beside).collect(), Kept::default());
    let mut join = Join { file: other.file, columns, count, kept, key };
    let (met, wanted) = join.met(&ours)?;
    said.extend(met);
    let (mut kept, mut number) = (Kept::default(), 0);
    let read = other.each(|row| {
        if wanted.get(number) == Some(&true) {
            kept.push(number, taken.iter().map(|k| other.text(row, *k)));
        }
        number += 1;
    });
    read.map_err(|mistake| mistake.of(other.file))?;
    join.kept = kept;
    Ok(ours.joined(join, said))
}

/// The column of a table by which it is joined.
fn at(table: &Table<'_>, name: &str, is: impl Fn(&String) -> bool) -> Result<usize, ReadError> {
    table.names.iter().position(is).ok_or_else(|| {
        let fault = Fault::new(format!("no column `{name}`"), "it in both tables", "");
        fault.at(table.line, None).of(table.file)
    })
}

/// A column of times as seconds, so many of them later.
fn timing(table: &Table<'_>, index: usize, shift: f64) -> Column {
    let column = Column::new(table, index);
    let unit = column.unit.as_deref().and_then(Unit::named);
    Column { factor: unit.map_or(1.0, |unit| unit.factor), offset: shift, ..column }
}

fn seconds(table: &Table<'_>, row: &Row<'_>, time: &Column) -> Result<f64, Mistake> {
    if let Some(clock) = Clock::of(&table.text(row, time.index)) {
        return Ok(clock.seconds + time.offset);
    }
    let here = || table.column(time.index);
    let none = || Fault::new("no time", "one", "").at(row.line, Some(here()));
    time.number(table, row)?.ok_or_else(none)
}

impl Join<'_> {
    /// What is to be said of the rows that have met, and which of the other's belong to one of ours.
    fn met(&self, ours: &Table<'_>) -> Result<(Vec<String>, Vec<bool>), ReadError> {
        let (mut rows, mut met, mut mistakes) = (0, 0, Mistakes::default());
        let mut wanted = vec![false; self.count];
        let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
        let read = ours.each(|row| {
            if let Key::Time(mine, _) = &self.key
                && let Ok(time) = seconds(ours, row, mine)
            {
                ends = [ends[0].min(time), ends[1].max(time)];
            }
            match self.meets(ours, rows, row) {
                Ok(found) => {
                    met += usize::from(found.is_some());
                    match found {
                        Some(Met::Row(row)) => wanted[row] = true,
                        Some(Met::Behind(row, _)) => wanted[row..row + 2].fill(true),
                        None => {}
                    }
                }
                Err(mistake) => mistakes.add(mistake),
            }
            rows += 1;
        });
        mistakes.extend(read.err());
        mistakes.check(ours.file)?;
        let all = self.count;
        if matches!(self.key, Key::Row) && rows != all {
            let help = "join by a column that both have, or by time";
            let expected = format!("{all} as in {}", self.file);
            return Err(Fault::new(counted(rows), expected, help).of(ours.file));
        }
        let times = self.times(ours.file, ends);
        if met == 0 {
            let found = format!("no row that belongs to one of {}", self.file);
            let help = times.map_or_else(String::new, |times| times + ": is one of both ahead?");
            return Err(Fault::new(found, "some", help).of(ours.file));
        }
        let mut said =
            vec![format!("{} of {} met by one of {}", counted(met), ours.file, self.file)];
        if met < rows {
            let left = counted(rows - met);
            said.push(format!("left out: {left} of {}, which meets none", ours.file));
        }
        said.extend(times.map(|times| {
            format!(
                "both clocks are taken to agree: {times}; if the first is so many seconds ahead, they are added by \
                 `--by time+0.5`"
            )
        }));
        Ok((said, wanted))
    }

    /// From when to when the rows of both tables are, in words.
    fn times(&self, file: &str, [first, last]: [f64; 2]) -> Option<String> {
        let Key::Time(_, times) = &self.key else { return None };
        let (begin, end) = (times.first()?, times.last()?);
        Some(format!(
            "{file} has the times {first:.3} to {last:.3} s, {} those from {begin:.3} to {end:.3} s",
            self.file
        ))
    }

    /// What belongs to a row of ours, the one so many from the first.
    pub(super) fn meets(
        &self,
        ours: &Table<'_>,
        number: usize,
        row: &Row<'_>,
    ) -> Result<Option<Met>, Mistake> {
        Ok(match &self.key {
            Key::Row => (number < self.count).then_some(Met::Row(number)),
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

    pub(super) fn cells(&self, met: &Met) -> Vec<Cow<'_, str>> {
        let (before, part) = match met {
            Met::Row(row) => return self.kept.row(*row).into_iter().map(Cow::from).collect(),
            Met::Behind(before, part) => (*before, *part),
        };
        let [first, second] = [before, before + 1].map(|row| self.kept.row(row));
        let each = self.columns.iter().zip(first.into_iter().zip(second)).map(|(column, cells)| {
            let value = |cell: &str| cell.parse::<f64>().ok().filter(|_| !is_none(cell));
            let both = value(cells.0).zip(value(cells.1)).filter(|_| column.between);
            let between = both.map(|(a, b)| a + part * (b - a));
            let near = if part < 0.5 { cells.0 } else { cells.1 };
            between.map_or(Cow::Borrowed(near), |value| Cow::Owned(value.to_string()))
        });
        each.collect()
    }
}
