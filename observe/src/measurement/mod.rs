//! The measurement file (CSV): read to the letter, or refused with every mistake at its place.
//!
//! A header row, then one row per measurement; `#` begins a comment line. A column is `name` or
//! `name[unit]`; the order is free. A file measures *either* poses (`x y z`, and all or none of `rx
//! ry rz`) *or* some coordinates of positions (a touch probe's `x` alone) *or* displacements (any
//! subset of `dx dy dz drx dry drz`) *or* what other instruments read ([`observe`](crate::instrument)): distances
//! from a fixed point (`distance`: a ball bar, a wire), a `point` that stays where it is, a `plane`, a
//! component `along` `nx ny nz`; of these each row may have its own. `rx ry rz` are a rotation vector, or three turns if a comment above the header says so:
//! `# orientation = zyx` ([`Convention`]). Nothing is guessed: an angle without a unit is in radians, and a column that is not known is
//! kept as it is and reported.
//!
//! Rows of one `session` are one sitting of the instrument, and stand together: its frame is its own,
//! and nothing that happens in time reaches from one into another.

mod cells;
mod group;
mod header;
mod kind;
mod payload;
mod role;
mod seen;
mod stack;
mod stands;
mod told;
mod write;

use std::collections::{BTreeMap, HashMap};
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use nalgebra::Vector6;

pub use payload::{Body, Hung, Payloads};
pub use stands::Sight;

pub use role::{
    BOARD_NAMES, DISPLACEMENT_NAMES, DISTANCE_NAMES, FROM_NAMES, Layout, Marker, NORMAL_NAMES,
    PIXEL_NAMES, POSE_NAMES, READING_NAMES, SIGMA_PREFIX, SIM_PREFIX, TILT_NAMES, WRENCH_NAMES,
};

use crate::instrument::{Aim, Pair, Seen, View};
use crate::io::cell::number;
use crate::io::table::{Records, Separator, commented};
#[doc(hidden)]
pub use crate::io::{
    Column, Dimension, Fault, MOST_BYTES, MOST_MISTAKES, Mistake, ReadError, Unit, bytes,
};
use crate::io::{Convention, Mistakes};

pub use group::Near;
pub(crate) use role::{Role, nearest_name};
pub use stands::{Base, Stands, number_of};
pub use write::csv;

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
    /// Whether a camera tells what it sees: where it or what it sees is beside the arm nobody knows, and the base
    /// frame is fitted along.
    pub by_camera: bool,
    /// Whether it tells of a board: where the board or the camera is on the tool nobody knows either, and the tool
    /// frame is fitted along, too.
    pub by_board: bool,
    /// Points whose distance is known.
    pub pairs: Vec<Pair>,
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

/// Most rows that are read: with all that is worked out about them they take some two gigabytes.
pub const MOST_ROWS: usize = 2_000_000;

/// A file of which more than one row in so many has holes is refused: a campaign loses a reading now
/// and then (a beam that was cut), not every tenth.
pub const ONE_IN: usize = 10;

/// Wrists turn ±700° at the most: a joint that reads more than two turns is not read in radians.
pub const MOST_RADIANS: f64 = 4.0 * core::f64::consts::PI;

/// A header, for messages.
const HEADER: &str = "`q1[deg],q2[deg],dz[mm]`";

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
    /// Some coordinates of the tool's position in the base frame: a touch probe's.
    Coordinates {
        /// Which of `x y z` are there; not all three.
        components: [bool; 3],
    },
    /// How far the measured point is from a fixed one: a ball bar's.
    Distance,
    /// What other instruments read of the measured point, each row its own ([`Row::aim`]).
    Bench {
        /// How many lengths a row reads at most: three of a point, else one or none.
        lengths: usize,
        /// Whether some rows read two angles.
        angles: bool,
    },
}

impl Kind {
    /// Whether it is the difference of two states, loaded minus unloaded.
    pub fn is_difference(self) -> bool {
        matches!(self, Kind::Displacement { .. })
    }

    /// Whether all three coordinates of a position are measured.
    pub fn is_pose(self) -> bool {
        matches!(self, Kind::Pose { .. })
    }

    /// The names of the six components.
    pub fn names(self) -> [&'static str; 6] {
        match self {
            Kind::Pose { .. } | Kind::Coordinates { .. } => POSE_NAMES,
            Kind::Displacement { .. } => DISPLACEMENT_NAMES,
            Kind::Distance => DISTANCE_NAMES,
            Kind::Bench { lengths: 3, .. } => core::array::from_fn(|k| match k {
                0..3 => POSE_NAMES[k],
                _ => READING_NAMES[k],
            }),
            Kind::Bench { .. } => READING_NAMES,
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
            Kind::Coordinates { components: [x, y, z] } => [x, y, z, false, false, false],
            Kind::Distance => [true, false, false, false, false, false],
            Kind::Bench { lengths, angles: a } => {
                [lengths > 0, lengths > 1, lengths > 1, a, a, false]
            }
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
    /// column where there is one; else rows whose readings agree to 1e-4 rad (m), to 5e-3 where the
    /// joints are all that is read, wherever they stand.
    pub group: usize,
    /// Name of the measured point.
    pub marker: Option<String>,
    /// Where the measured point is in the tool frame, m; `None` is unknown. Zero without a marker.
    pub offset: Option<[f64; 3]>,
    /// What the `session` column calls the sitting of the instrument; all one without a column.
    pub session: Option<String>,
    /// What the `payload` column hangs on the tool; its weight is part of the wrench.
    pub payload: Option<Box<Hung>>,
    /// The camera by which it is seen.
    pub camera: Option<Box<Sight>>,
    /// What is read of the measured point by an instrument that is no tracker.
    pub aim: Option<Box<Aim>>,
    /// Position and rotation vector, or displacement, m and rad; 0 where it is not measured. One number
    /// is the first of them; a point that is in one place reads 0.
    pub measured: Vector6<f64>,
    /// The instrument's own standard deviation of each of these, m and rad, 0 where the file has no
    /// column for it; `None` if it has none at all.
    pub sigma: Option<Box<Vector6<f64>>>,
    /// The same by the user's own simulator; 0 where [`Measurements::sim_given`] is false.
    pub sim: Option<Box<Vector6<f64>>>,
}

impl Row {
    /// Whether constants of the instrument that it reads are unknown.
    pub fn reads_unknown(&self) -> bool {
        self.aim.as_ref().is_some_and(|aim| !aim.free.is_empty())
    }

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
            session: None,
            payload: None,
            camera: None,
            aim: None,
            measured: Vector6::zeros(),
            sigma: None,
            sim: None,
        }
    }

    /// What reads it in a file of that kind, if it is no tracker.
    pub fn view(&self, kind: Kind) -> Option<View> {
        let is_bench = matches!(kind, Kind::Distance | Kind::Bench { .. });
        self.aim.as_deref().filter(|_| is_bench).map(|aim| aim.view)
    }

    /// Which of the six components are measured in this row of a file of that kind.
    pub fn components(&self, kind: Kind) -> [bool; 6] {
        match (kind, &self.aim) {
            (Kind::Bench { .. }, Some(aim)) => aim.seen.components(),
            _ => kind.components(),
        }
    }

    /// Whether lengths (from the `first` component, 0, on) or angles (3) are measured in this row.
    pub fn reads(&self, kind: Kind, first: usize) -> bool {
        self.components(kind)[first..first + 3].contains(&true)
    }

    /// Whether its joints are all that is read: a point that only lies in its socket, or on its plate.
    pub fn reads_joints_alone(&self) -> bool {
        let lies = |aim: &Aim| matches!(aim.seen, Seen::Point | Seen::Plane);
        self.aim.as_deref().is_some_and(lies) && self.measured == Vector6::zeros()
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
    /// The cells as numbers, one per row, as written and not converted; the line and the text of the first that is
    /// no finite number. Texts are not held.
    pub values: Result<Vec<f64>, (u64, String)>,
    /// A known name that it may have been meant to be; nothing is assumed.
    pub suggestion: Option<String>,
}

impl Measurements {
    /// The same file with some of its rows alone, each with its number.
    pub fn of_rows(&self, rows: Vec<(usize, Row)>) -> Measurements {
        let chosen = |values: &Vec<f64>| rows.iter().map(|(number, _)| values[*number]).collect();
        let extra = self.extra.iter().map(|column| ExtraColumn {
            column: column.column.clone(),
            name: column.name.clone(),
            unit: column.unit.clone(),
            values: column.values.as_ref().map(chosen).map_err(Clone::clone),
            suggestion: column.suggestion.clone(),
        });
        Measurements {
            file: self.file.clone(),
            extra: extra.collect(),
            pairs: self.pairs.clone(),
            unused: self.unused.clone(),
            skipped: self.skipped.clone(),
            rows: rows.into_iter().map(|(_, row)| row).collect(),
            ..*self
        }
    }

    /// Rows that no file holds, each of the pose that its `group` says.
    pub fn new(file: &str, kind: Kind, rows: Vec<Row>) -> Measurements {
        Measurements {
            file: file.to_owned(),
            poses: rows.iter().map(|row| row.group + 1).max().unwrap_or(0),
            rows,
            kind,
            sim_given: [false; 6],
            by_camera: false,
            by_board: false,
            pairs: Vec::new(),
            extra: Vec::new(),
            unused: Vec::new(),
            skipped: Vec::new(),
            measured_in: [None; 6],
            wrench_in: [None; 6],
        }
    }

    /// The rows of each session, in the order of measuring; at least one where there are rows.
    pub fn sessions(&self) -> impl Iterator<Item = &[Row]> {
        self.rows.chunk_by(|a, b| a.session == b.session)
    }

    /// The rows of each picture: those of a camera and board at one posture under one load.
    pub fn pictures(&self) -> Vec<Vec<usize>> {
        let mut pictures: BTreeMap<_, Vec<usize>> = BTreeMap::new();
        for (number, row) in self.rows.iter().enumerate() {
            let load = row.wrench.map(|force| (force + 0.0).to_bits()).data.0;
            let names = row.camera.as_ref().map(|sight| (&sight.camera, &sight.board));
            let picture = (&row.session, row.group, load, names);
            pictures.entry(picture).or_default().push(number);
        }
        pictures.into_values().collect()
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
        match File::open(path) {
            Ok(source) => Measurements::from_source(&file, BufReader::new(source), layout),
            Err(error) => {
                let found = format!("no file that can be read ({error})");
                Err(Fault::new(found, "a measurement file (CSV)", "").of(&file))
            }
        }
    }

    /// Reads a measurement file from its source, of which the record at hand alone is held.
    ///
    /// # Errors
    /// As [`Measurements::from_bytes`].
    pub fn from_source(
        file: &str,
        source: impl BufRead,
        layout: &Layout,
    ) -> Result<Measurements, ReadError> {
        Measurements::of_source(file, source, layout, false)
    }

    /// Reads the bytes of a measurement file; `file` is what messages call it.
    ///
    /// # Errors
    /// [`ReadError`]: all its mistakes, up to [`MOST_MISTAKES`].
    pub fn from_bytes(
        file: &str,
        bytes: &[u8],
        layout: &Layout,
    ) -> Result<Measurements, ReadError> {
        Measurements::of_source(file, bytes, layout, false)
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
        Measurements::of_source(file, bytes, layout, true)
    }

    fn of_source(
        file: &str,
        source: impl BufRead,
        layout: &Layout,
        planned: bool,
    ) -> Result<Measurements, ReadError> {
        let mut mistakes = Mistakes::default();
        let read = read_into(&mut mistakes, file, source, layout, planned);
        let read = read.map_err(|mistake| mistakes.add(mistake)).ok().flatten();
        mistakes.check(file)?;
        read.ok_or_else(|| Fault::new("nothing", "measurements", "").of(file))
    }

    /// What is measured, as reports have it: `x y z`, or the things of a bench.
    pub fn subject(&self) -> String {
        let Kind::Bench { .. } = self.kind else { return self.kind.measured().join(" ") };
        let is_there = |seen: &Seen| {
            self.rows.iter().filter_map(|row| row.aim.as_deref()).any(|aim| aim.seen == *seen)
        };
        let each = Seen::ALL.into_iter().filter(is_there).map(|seen| format!("{}s", seen.thing()));
        each.collect::<Vec<_>>().join(", ")
    }

    /// Number of measured components of one row.
    pub fn components(&self) -> usize {
        self.kind.components().into_iter().filter(|c| *c).count()
    }
}

/// `None` only if there is a mistake; what nothing can be read after is an error.
fn read_into(
    mistakes: &mut Mistakes,
    file: &str,
    source: impl BufRead,
    layout: &Layout,
    planned: bool,
) -> Result<Option<Measurements>, Mistake> {
    let mut records = Records::new(source, Some(Separator::Byte(b',')))?;
    let Some(top) = records.read()? else {
        let help = format!("begin with one such as {HEADER}");
        return Err(Fault::new("nothing", "a header row", help).at(1, None));
    };
    let (line, names) = (top.line, top.texts()?);
    if let Some(fault) = no_header(&names) {
        return Err(fault.at(line, None));
    }
    let names: Vec<String> = names.into_iter().map(str::to_owned).collect();
    let heads = header::read(line, &names, layout, mistakes);
    let kind = kind::of(&heads, line, layout, mistakes);
    let has_turns = matches!(kind, Some((Kind::Pose { orientation: true }, _)));
    let orientation = orientation(&records.above, has_turns)?;
    let mut extra = extra(&heads);
    let (mut rows, mut skipped, mut count) = (Vec::new(), Vec::new(), 0);
    while let Some(record) = records.read()? {
        count += 1;
        if count > MOST_ROWS {
            let found = format!("more than {MOST_ROWS} rows");
            let fault = Fault::new(found, "no more", "thin the file out, or split it");
            return Err(fault.at(record.line, None));
        }
        let cells = record.texts()?;
        match cells::row(
            record.line,
            &cells,
            &heads,
            layout,
            (planned, orientation, kind.map(|k| k.0)),
        ) {
            Ok(row) => {
                rows.push(row);
                extra.iter_mut().for_each(|extra| extra.take(record.line, &cells));
            }
            Err(found) if found.iter().all(|m| m.fault.is_hole) => skipped.push(found),
            Err(found) => mistakes.extend(found),
        }
    }
    sessions_stand_together(mistakes, &rows, &heads);
    if count == 0 {
        let expected = "at least one measurement below the header";
        mistakes.add(Fault::new("no rows", expected, "add the measurements").at(line, None));
    }
    if skipped.len() * ONE_IN > count {
        skipped.drain(..).for_each(|found| mistakes.extend(found));
    }
    let Some((kind, sim_given)) = kind.filter(|_| mistakes.is_empty()) else { return Ok(None) };
    // To compare very many names takes long: those of a file that is wrong are not.
    extra.iter_mut().for_each(|one| one.suggestion = nearest_name(&one.name, layout));
    group::assign(&mut rows);
    let measured = kind.components();
    let unused = |h: &&header::Head| match h.role {
        Some(Role::Sim(_, k) | Role::Sigma(Some((_, k)))) => !measured[k],
        Some(Role::Sigma(None)) => {
            measured[..3] == [false; 3] && !matches!(kind, Kind::Bench { .. })
        }
        _ => false,
    };
    let unit_of = |role| heads.iter().find(|h| h.role == Some(role)).and_then(|h| h.unit);
    let has = |is: fn(&Role) -> bool| heads.iter().any(|head| head.role.as_ref().is_some_and(is));
    let family = kind::family(kind);
    let mut data = Measurements {
        measured_in: core::array::from_fn(|k| unit_of(Role::Measured(family, k))),
        wrench_in: core::array::from_fn(|k| unit_of(Role::Wrench(k))),
        unused: heads.iter().filter(unused).map(|h| h.column.clone()).collect(),
        extra,
        skipped: skipped.into_iter().flatten().collect(),
        sim_given,
        by_camera: has(|role| matches!(role, Role::BoardPose(_) | Role::Pixel(_))),
        by_board: has(|role| matches!(role, Role::BoardPose(_))),
        ..Measurements::new(file, kind, rows)
    };
    if let Err(mistake) = layout.bench.set_up(&mut data) {
        mistakes.add(mistake);
    }
    Ok(Some(data))
}

/// How a comment above the header says that `rx ry rz` are written: `# orientation = zyx`.
fn orientation(above: &[(u64, String)], has_turns: bool) -> Result<Convention, Mistake> {
    let mut told = Convention::RotationVector;
    for (line, name) in commented(above, "orientation") {
        told = Convention::named(name).map_err(|fault| fault.at(line, None))?;
        let found = format!("`orientation = {name}`");
        let fault = match (has_turns, told.has_angles()) {
            (true, true) => continue,
            (true, false) => Fault::new(
                found,
                "an orientation of three angles",
                "`stiffarm measurements` makes them of other numbers",
            ),
            (false, _) => Fault::new(found, "columns rx, ry, rz below it", "add them"),
        };
        return Err(fault.at(line, None));
    }
    Ok(told)
}

fn sessions_stand_together(mistakes: &mut Mistakes, rows: &[Row], heads: &[header::Head]) {
    let column = heads.iter().find(|head| head.role == Some(Role::Session));
    let Some(column) = column.map(|head| &head.column) else { return };
    let mut ended: HashMap<&str, u64> = HashMap::new();
    for session in rows.chunk_by(|a, b| a.session == b.session) {
        let ([first, .., last] | [first @ last]) = session else { continue };
        let Some(name) = first.session.as_deref() else { continue };
        if let Some(ended) = ended.insert(name, last.line) {
            let help = "bring the rows of a session together, in the order of measuring, or give what \
                        was measured later another name";
            let expected = format!("another: its rows end in line {ended}");
            let fault = Fault::new(format!("session `{name}` again"), expected, help);
            mistakes.add(fault.at(first.line, Some(column.clone())));
        }
    }
}

/// A first row that is no header at all.
fn no_header(names: &[&str]) -> Option<Fault> {
    if let Some(found) = cells::only_numbers(names) {
        let help = format!("name the columns in the first row, such as {HEADER}");
        return Some(Fault::new(format!("the number `{found}`"), "a header row", help));
    }
    let separators = [(';', "semicolons"), ('\t', "tabs"), ('|', "bars")];
    let [lone] = names else { return None };
    let (_, separator) = separators.into_iter().find(|(c, _)| lone.contains(*c))?;
    let found = format!("columns separated by {separator}");
    Some(Fault::new(found, "commas", "export with commas, or let `stiffarm measurements` read it"))
}

/// The columns without a meaning, still without cells and suggestions.
fn extra(heads: &[header::Head]) -> Vec<ExtraColumn> {
    let unknown = heads.iter().filter(|h| h.role == Some(Role::Extra));
    let column = |head: &header::Head| ExtraColumn {
        column: head.column.clone(),
        name: head.name.clone(),
        unit: head.unit_text.clone(),
        values: Ok(Vec::new()),
        suggestion: None,
    };
    unknown.map(column).collect()
}

impl ExtraColumn {
    fn take(&mut self, line: u64, cells: &[&str]) {
        let Ok(values) = &mut self.values else { return };
        let cell = cells[self.column.number - 1];
        match number(cell, String::new) {
            Ok(value) => values.push(value),
            Err(_) => self.values = Err((line, cell.to_owned())),
        }
    }
}
