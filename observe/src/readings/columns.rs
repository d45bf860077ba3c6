//! Which column is what, in which unit.

use super::map::Map;
use super::names::{self, Meaning};
use super::sheet::Table;
use crate::io::cell::is_none;
use crate::io::columns::Header;
use crate::io::{Convention, Dimension, Mistakes, ReadError, Unit};
use crate::measurement::{Role, SIM_PREFIX};

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
    pub date: Option<Column>,
    /// Where a row has several points: their names, and the columns of their coordinates.
    pub points: Vec<(String, [Column; 3])>,
    /// What is kept as it stands.
    pub kept: Vec<Column>,
}

/// The names of a measurement file and of orientations, for messages.
const OURS: &str = "q1 …, s1 …, x y z, rx ry rz, dx … drz, distance, from, from_x …, point, plane, along, nx ny nz, \
                    zero, tilt_x tilt_y, u v, cx … crz, cqw …, camera, board, sim_x …, sigma, sigma_x …, fx … mz, \
                    temperature, date, time, pose, marker, session, payload, mass, or one \
                    number of an orientation: a b c, roll pitch yaw, qw qx qy qz, r11 … r33";

impl Columns {
    /// # Errors
    /// [`ReadError`]: a column that the map names and the table has not, or one that stands twice.
    pub(super) fn of(table: &Table<'_>, map: &Map) -> Result<Columns, ReadError> {
        let meant: Vec<Option<Meaning>> =
            table.names.iter().map(|name| names::meaning(names::split(name).0)).collect();
        // A program that has a joint 0 counts all of them from there.
        let from_zero = meant.contains(&Some(Meaning::FromZero(0)));
        let meaning = |k: usize| {
            let meaning = meant[k].clone()?;
            let meaning = if from_zero { meaning.after_zero() } else { meaning };
            Some(meaning.name())
        };
        let header = Header {
            line: Some(table.line),
            names: &table.names,
            bare: &|name| names::split(name).0,
            map,
            known: &|ours| named(ours).map(|meaning| meaning.name()),
            ours: OURS,
        };
        let mut mistakes = Mistakes::default();
        let assigned = header.assign(&meaning, &mut mistakes);
        mistakes.check(table.file)?;
        let mut columns = Columns::default();
        for (index, found) in assigned.into_iter().enumerate() {
            let mut column = Column::new(table, index);
            let meaning = found.and_then(|(ours, theirs)| {
                column.unit = theirs.unit.or(column.unit.take());
                (column.factor, column.offset) = (theirs.factor, theirs.offset);
                names::meaning(&ours)
            });
            match meaning {
                Some(Meaning::Orientation(of, k)) => columns.orientation.push((of, k, column)),
                Some(Meaning::Load) => columns.load = Some(column),
                Some(Meaning::Date) => columns.date = Some(column),
                Some(ours) => columns.ours.push((ours.name(), column)),
                None if column.header.is_empty() || header.ignores(index) => {}
                None => columns.kept.push(column),
            }
        }
        columns.find_points();
        // A socket without a distance is no wire's end: the ball sits in it.
        let has = |name: &str| columns.ours.iter().any(|(ours, _)| ours == name);
        if !has("distance") && !has("point") && !map.set.contains_key("point") {
            let is_socket = |c: &Column| names::split(&c.header).0.eq_ignore_ascii_case("socket");
            let socket = columns.ours.iter_mut().find(|(ours, c)| ours == "from" && is_socket(c));
            socket.into_iter().for_each(|(ours, _)| "point".clone_into(ours));
        }
        // A day alone has its time with it.
        if let Some(date) = columns.date.take_if(|_| !columns.ours.iter().any(|(n, _)| n == "time"))
        {
            columns.ours.push(("time".to_owned(), date));
        }
        Ok(columns)
    }

    /// The points of a table that has more than one in a row, and no other position.
    fn find_points(&mut self) {
        let has = |name: &str| self.ours.iter().any(|(ours, _)| ours == name);
        if ["x", "y", "z", "marker"].into_iter().any(has) {
            return;
        }
        let mut found: Vec<(String, [Option<Column>; 3])> = Vec::new();
        for column in &self.kept {
            let Some((name, axis)) = names::of_point(names::split(&column.header).0) else {
                continue;
            };
            let known = found.iter().position(|(known, _)| known == name);
            let at = known.unwrap_or_else(|| {
                found.push((name.to_owned(), [None, None, None]));
                found.len() - 1
            });
            found[at].1[axis].get_or_insert_with(|| column.clone());
        }
        let whole = |(name, axes): (String, [Option<Column>; 3])| {
            let [Some(x), Some(y), Some(z)] = axes else { return None };
            Some((name, [x, y, z]))
        };
        let points: Vec<_> = found.into_iter().filter_map(whole).collect();
        if points.len() > 1 {
            let is_of_point =
                |c: &Column| points.iter().flat_map(|(_, axes)| axes).any(|a| a.index == c.index);
            self.kept.retain(|column| !is_of_point(column));
            self.points = points;
        }
    }
}

impl Column {
    pub(super) fn new(table: &Table<'_>, index: usize) -> Column {
        let header = table.names[index].clone();
        let plain = |text: &str| Unit::spelled(text).map_or(text, |unit| unit.name).to_owned();
        let within = names::split(&header).1.map(plain);
        let below = table.units.get(index).filter(|text| !is_none(text)).map(|text| plain(text));
        Column { index, unit: within.or(below), header, factor: 1.0, offset: 0.0 }
    }

    /// What was done to its numbers, in words.
    pub(super) fn law(&self) -> String {
        match (self.factor, self.offset) {
            (1.0, 0.0) => String::new(),
            (f, 0.0) => format!(" = {f} · it"),
            (f, o) => format!(" = {f} · it + {o}"),
        }
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
