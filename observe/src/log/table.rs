//! Rows of cells into runs, whatever file they stand in.

use stiffarm_kernels::Motion;

use super::column::{Role, Signal};
use super::holes::{Hole, fill};
use super::{Clock, Damaged, Lacking, Log, Names, Run, TorqueSide};
use crate::io::cell::Decimals;
use crate::io::columns::{self, Found, split};
use crate::io::{Fault, Mistakes, ReadError, Unit, did_you_mean, nearest};

/// No joint value, torque, current or time of an arm is larger in SI: what is, is a damaged cell. (Stamps
/// since 1970 are below 1e10.)
const LARGEST: f64 = 1e12;

/// The names of a log's columns, for messages.
const OURS: &str = "t, q1 …, qd1, qdd1, tau1, i1, q_cmd1, qd_cmd1, tau_cmd1, temp1, fx … mz, payload, \
                    run, contact";

/// What a file says before its rows.
pub(super) struct Header {
    /// Of the columns.
    pub names: Vec<String>,
    /// The line on which they stand, if the file has lines.
    pub line: Option<u64>,
    /// What its rows are called: `line`.
    pub row: &'static str,
    /// Where its torques are measured, if it says so.
    pub side: Option<TorqueSide>,
    /// What begins the decimals of its texts.
    pub decimals: Decimals,
}

/// A cell of a row.
#[derive(Clone, Copy)]
pub(super) enum Cell<'c> {
    /// As a text has it.
    Text(&'c [u8]),
    /// As a file of numbers has it.
    #[cfg_attr(
        not(any(feature = "mcap", feature = "parquet", feature = "rosbag2")),
        expect(dead_code, reason = "files of numbers are features")
    )]
    Number(f64),
}

/// A file whose rows come one by one.
pub(super) struct Table {
    columns: Columns,
    log: Log,
    /// Of each cell what is known of rows that lack it.
    lacking: Vec<Option<Lacking>>,
    row: &'static str,
    decimals: Decimals,
    open: Option<Open>,
    sample: Sample,
}

/// What one column is.
struct Head {
    role: Role,
    /// SI value = factor · value + offset.
    factor: f64,
    offset: f64,
    /// Of a joint's column, which among those of the run.
    slot: usize,
}

/// The columns of a file.
struct Columns {
    /// Of each cell what it is; `None` of one that nothing reads.
    heads: Vec<Option<Head>>,
    unknown: Vec<String>,
    signals: Vec<Signal>,
    joints: usize,
}

/// A run as its rows come in.
#[derive(Default)]
struct Open {
    name: String,
    payload: String,
    t: Vec<f64>,
    /// Of each signal each joint, one behind the other.
    values: Vec<Vec<f64>>,
    contact: Vec<bool>,
    repeated: usize,
}

/// One row.
#[derive(Default)]
struct Sample {
    t: f64,
    /// As in a run.
    values: Vec<f64>,
    run: String,
    payload: String,
    contact: bool,
    /// Cells that hold no number, which the row can do without.
    lacks: Vec<usize>,
}

impl Table {
    /// Of a file with this header; `motions` are those of the arm's joints.
    pub(super) fn new(
        file: &str,
        header: &Header,
        motions: &[Motion],
        names: &Names,
    ) -> Result<Table, ReadError> {
        let columns = Columns::of(file, header, motions, names)?;
        let log = Log {
            files: vec![file.to_owned()],
            samples: 0,
            runs: Vec::new(),
            side: header.side,
            damaged: Vec::new(),
            lacking: Vec::new(),
            unknown: columns.unknown.clone(),
        };
        let lacking = vec![None; columns.heads.len()];
        let (row, decimals) = (header.row, header.decimals);
        Ok(Table { columns, log, lacking, row, decimals, open: None, sample: Sample::default() })
    }

    /// Whether a column's cells are read.
    #[cfg(feature = "parquet")]
    pub(super) fn reads(&self, column: usize) -> bool {
        self.columns.heads[column].is_some()
    }

    /// The next row, which is the one so many in its file, from 1.
    pub(super) fn push<'c>(
        &mut self,
        row: u64,
        cells: impl ExactSizeIterator<Item = Cell<'c>> + Clone,
    ) {
        match self.columns.read(cells.clone(), &mut self.decimals, &mut self.sample) {
            Err(reason) => self.damaged(row, reason),
            Ok(()) => {
                self.log.samples += 1;
                self.lacks(row, cells);
                if !self.open.as_ref().is_some_and(|open| open.takes(&self.sample)) {
                    self.close();
                }
                let open = self.open.get_or_insert_with(|| Open::new(&self.sample));
                open.push(&self.sample);
            }
        }
    }

    /// Notes the cells that a row lacks.
    fn lacks<'c>(&mut self, line: u64, cells: impl Iterator<Item = Cell<'c>> + Clone) {
        for cell in self.sample.lacks.drain(..) {
            let first = || {
                let mut found = String::new();
                cells.clone().nth(cell).into_iter().for_each(|cell| cell.text_into(&mut found));
                let name = self.columns.heads[cell].as_ref().map_or_else(String::new, Head::name);
                let file = self.log.files.concat();
                Lacking { file, name, rows: 0, row: self.row, line, found }
            };
            self.lacking[cell].get_or_insert_with(first).rows += 1;
        }
    }

    /// A row that cannot be read, and why.
    pub(super) fn damaged(&mut self, line: u64, reason: String) {
        let file = self.log.files.concat();
        self.log.damaged.push(Damaged { file, row: self.row, line, reason });
    }

    /// The log of all rows.
    pub(super) fn end(mut self) -> Result<Log, ReadError> {
        self.close();
        let Table { columns, mut log, lacking, .. } = self;
        log.lacking.extend(lacking.into_iter().flatten());
        if log.runs.is_empty() {
            let expected = format!("rows of {} numbers below the header", columns.heads.len());
            let first = log.damaged.first();
            let why = first.map(|d| format!("{} {}: {}", d.row, d.line, d.reason));
            let fault = Fault::new("no row that can be read", expected, why.unwrap_or_default());
            return Err(fault.of(&log.files.concat()));
        }
        Ok(log)
    }

    /// Ends the run that is open.
    fn close(&mut self) {
        let signals = (&self.columns.signals[..], self.columns.joints);
        let run = self.open.take().map(|open| open.close(&self.log.files[0], signals));
        self.log.runs.extend(run);
    }
}

impl Head {
    fn name(&self) -> String {
        self.role.name()
    }

    /// `None` of a name of ours that is no column of a log; `written` is the unit in the header.
    ///
    /// # Errors
    /// A joint that the arm has not, or a unit of another quantity.
    fn new(
        (ours, theirs): &Found,
        written: Option<&str>,
        motions: &[Motion],
    ) -> Option<Result<Head, Fault>> {
        let role = Role::of(ours)?;
        if let Role::Joint(_, joint) = role
            && joint >= motions.len()
        {
            let (found, last) = (format!("`{}`", role.name()), motions.len());
            let expected = format!("joints 1 to {last}");
            return Some(Err(Fault::new(found, expected, "the arm has no other")));
        }
        let unit = role.dimension(motions).zip(theirs.unit.as_deref().or(written));
        let unit = unit.map(|(dimension, unit)| dimension.unit(unit, Unit::named)).transpose();
        let law = |unit: Option<Unit>| {
            let [factor, offset] = unit.map_or([1.0, 0.0], |unit| [unit.factor, unit.offset]);
            let offset = factor * theirs.offset + offset;
            Head { role, factor: factor * theirs.factor, offset, slot: 0 }
        };
        Some(unit.map(law))
    }
}

impl Columns {
    fn of(
        file: &str,
        header: &Header,
        motions: &[Motion],
        names: &Names,
    ) -> Result<Columns, ReadError> {
        let mut mistakes = Mistakes::default();
        let said = columns::Header {
            line: header.line,
            names: &header.names,
            bare: &|name| split(name).0,
            map: names.map(),
            known: &|name| Role::of(name).map(Role::name),
            ours: OURS,
        };
        let meaning = |k: usize| names.role(&header.names[k]).map(Role::name);
        let assigned = said.assign(&meaning, &mut mistakes);
        let mut heads: Vec<Option<Head>> = Vec::with_capacity(header.names.len());
        for (k, found) in assigned.into_iter().enumerate() {
            heads.push(found.and_then(|found| {
                // An index in brackets (`position[0]`) is no unit.
                let written = split(&header.names[k]).1;
                let written = written.filter(|unit| unit.parse::<usize>().is_err());
                let head = Head::new(&found, written, motions)?;
                let wrong = |fault: Fault| fault.within(header.line, Some(said.column(k)));
                head.map_err(|fault| mistakes.add(wrong(fault))).ok()
            }));
        }
        let nothing = (0..heads.len()).filter(|k| heads[*k].is_none() && !said.ignores(*k));
        let unknown = nothing.map(|k| header.names[k].clone()).collect();
        let (signals, joints) = (Vec::new(), motions.len());
        let mut columns = Columns { heads, unknown, signals, joints };
        if mistakes.is_empty() {
            let complete = columns.complete(names.is_of_motion());
            mistakes.extend(complete.err().map(|fault: Fault| fault.within(header.line, None)));
        }
        mistakes.check(file)?;
        for head in columns.heads.iter_mut().flatten() {
            if let Role::Joint(signal, joint) = head.role {
                let before = columns.signals.iter().position(|s| *s == signal).unwrap_or(0);
                head.slot = before * joints + joint;
            }
        }
        Ok(columns)
    }

    /// Every signal has all joints, and there are those that are needed.
    fn complete(&mut self, motion: bool) -> Result<(), Fault> {
        let joints = self.joints;
        let roles: Vec<Role> = self.heads.iter().flatten().map(|head| head.role).collect();
        let missing = |missing: String, beside: String| {
            let near = nearest(&missing, self.unknown.iter().map(String::as_str));
            let help = format!("the arm has {joints} joints{}", did_you_mean(near));
            let (found, expected) =
                (format!("no column `{missing}`"), format!("it beside `{beside}`"));
            Err(Fault::new(found, expected, help))
        };
        if !roles.contains(&Role::Time) {
            return missing("t".to_owned(), "q1".to_owned());
        }
        for signal in Signal::ALL {
            let has = |joint| roles.contains(&Role::Joint(signal, joint));
            let first = (0..joints).find(|joint| has(*joint));
            match (first, (0..joints).find(|joint| !has(*joint))) {
                (Some(_), None) => self.signals.push(signal),
                (Some(first), Some(lacks)) => {
                    let name = |joint| Role::Joint(signal, joint).name();
                    return missing(name(lacks), name(first));
                }
                (None, _) if signal == Signal::Q && !motion => {
                    return missing("q1".to_owned(), "t".to_owned());
                }
                (None, _) => {}
            }
        }
        if motion {
            let told = [Signal::Q, Signal::QCmd].iter().any(|signal| self.signals.contains(signal));
            return if told { Ok(()) } else { missing("q_cmd1".to_owned(), "t".to_owned()) };
        }
        let needed = [Signal::Torque, Signal::Current, Signal::QCmd];
        if !needed.iter().any(|signal| self.signals.contains(signal)) {
            let expected = "beside them tau1 … or i1 … (what drives the joints) or q_cmd1 … (where they \
                            were to be)";
            return Err(Fault::new("joint values alone", expected, ""));
        }
        Ok(())
    }

    /// The numbers of a row, in SI, into a sample; what damages it.
    fn read<'c>(
        &self,
        cells: impl ExactSizeIterator<Item = Cell<'c>>,
        decimals: &mut Decimals,
        sample: &mut Sample,
    ) -> Result<(), String> {
        if cells.len() != self.heads.len() {
            return Err(format!("found {} cells, expected {}", cells.len(), self.heads.len()));
        }
        sample.values.clear();
        sample.values.resize(self.signals.len() * self.joints, 0.0);
        sample.contact = false;
        sample.lacks.clear();
        for (k, (cell, head)) in cells.zip(&self.heads).enumerate() {
            let Some(head) = head else { continue };
            if let Role::Run | Role::Payload = head.role {
                let word =
                    if head.role == Role::Run { &mut sample.run } else { &mut sample.payload };
                cell.text_into(word);
                continue;
            }
            let number = cell.number(decimals).map(|x| head.factor * x + head.offset);
            let number = number.filter(|x| x.abs() < LARGEST);
            let number = match (number, head.role) {
                (Some(number), _) => number,
                (None, Role::Joint(signal, _)) if self.can_lack(signal, sample, head.slot) => {
                    sample.lacks.push(k);
                    f64::NAN
                }
                (None, role) => {
                    let mut found = String::new();
                    cell.text_into(&mut found);
                    return Err(format!("found `{found}` for {}, expected a number", role.name()));
                }
            };
            match head.role {
                Role::Time => sample.t = number,
                Role::Joint(..) => sample.values[head.slot] = number,
                // A wrench on the tool is kept out of the fits as contact is.
                _ => sample.contact |= number != 0.0,
            }
        }
        Ok(())
    }
}

impl Columns {
    /// Whether a row does without a joint's cell: nothing else is made of it. One that lacks what drives all joints says
    /// nothing.
    fn can_lack(&self, signal: Signal, sample: &Sample, slot: usize) -> bool {
        let first = slot / self.joints * self.joints;
        let lacks = |slot: usize| sample.values[slot].is_nan();
        match signal {
            Signal::Q | Signal::Qd | Signal::QCmd => false,
            Signal::Torque | Signal::Current => {
                let others = (first..first + self.joints).filter(|other| *other != slot);
                self.joints > 1 && !others.into_iter().all(lacks)
            }
            Signal::Qdd | Signal::QdCmd | Signal::TorqueCmd | Signal::Temperature => true,
        }
    }
}

impl Cell<'_> {
    fn number(self, decimals: &mut Decimals) -> Option<f64> {
        match self {
            Cell::Text(bytes) => decimals.look(core::str::from_utf8(bytes).ok()?.trim()),
            Cell::Number(number) => Some(number),
        }
    }

    fn text_into(self, word: &mut String) {
        word.clear();
        match self {
            Cell::Text(bytes) => word.push_str(String::from_utf8_lossy(bytes).trim()),
            Cell::Number(number) => word.push_str(&number.to_string()),
        }
    }
}

impl Open {
    fn new(first: &Sample) -> Open {
        Open {
            name: first.run.clone(),
            payload: first.payload.clone(),
            values: vec![Vec::new(); first.values.len()],
            ..Open::default()
        }
    }

    /// Whether a sample goes on with this run: of the same name and payload, and not before it.
    fn takes(&self, sample: &Sample) -> bool {
        (&self.name, &self.payload) == (&sample.run, &sample.payload)
            && self.t.last().is_none_or(|last| sample.t >= *last)
    }

    fn push(&mut self, sample: &Sample) {
        if self.t.last() == Some(&sample.t) {
            self.repeated += 1;
            return;
        }
        self.t.push(sample.t);
        self.contact.push(sample.contact);
        self.values.iter_mut().zip(&sample.values).for_each(|(to, value)| to.push(*value));
    }

    /// With the signals that it has, of so many joints each.
    fn close(mut self, file: &str, (signals, joints): (&[Signal], usize)) -> Run {
        let clock = Clock::of(&self.t, self.repeated);
        let mut holes = Vec::new();
        for (k, values) in self.values.iter_mut().enumerate() {
            let (signal, joint) = (signals[k / joints], k % joints);
            let long = fill(&self.t, values, clock.period);
            if matches!(signal, Signal::Torque | Signal::Current) {
                holes.extend(long.into_iter().map(|samples| Hole { signal, joint, samples }));
            }
        }
        let each = signals.iter().zip(self.values.chunks_mut(joints.max(1)));
        Run {
            name: if self.name.is_empty() { file.to_owned() } else { self.name },
            clock,
            t: self.t,
            signals: each
                .map(|(s, values)| (*s, values.iter_mut().map(core::mem::take).collect()))
                .collect(),
            payload: (!self.payload.is_empty()).then_some(self.payload),
            contact: self.contact,
            holes,
        }
    }
}
