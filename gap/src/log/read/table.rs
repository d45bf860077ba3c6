//! The rows of a file into runs.

use std::collections::BTreeMap;

use csv::{ByteRecord, ReaderBuilder};
use stiffarm_kernels::Motion;

use super::column::{Role, Signal, split};
use super::unit::Scale;
use super::{Clock, Damaged, Log, LogError, Names, Run, TorqueSide};
use crate::measurement::nearest;

/// No joint value, torque, current or time of an arm is larger in SI: what is, is a damaged cell. (Stamps
/// since 1970 are below 1e10.)
const LARGEST: f64 = 1e12;

/// What may separate cells; of equally many the first.
const SEPARATORS: [u8; 4] = [b',', b';', b'\t', b' '];

/// What one column is.
struct Head {
    role: Role,
    scale: Scale,
}

/// The columns of a file.
struct Columns {
    /// Of each cell what it is; `None` of one that nothing reads.
    heads: Vec<Option<Head>>,
    unknown: Vec<String>,
    signals: Vec<Signal>,
}

/// A run as its rows come in.
#[derive(Default)]
struct Open {
    name: String,
    payload: String,
    t: Vec<f64>,
    signals: BTreeMap<Signal, Vec<Vec<f64>>>,
    contact: Vec<bool>,
    repeated: usize,
}

/// One row.
#[derive(Default)]
struct Sample {
    t: f64,
    /// Signal, joint, value.
    values: Vec<(Signal, usize, f64)>,
    run: String,
    payload: String,
    contact: bool,
}

pub(super) fn read(
    file: &str,
    bytes: &[u8],
    motions: &[Motion],
    names: &Names,
) -> Result<Log, LogError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let (side, first) = comments(file, bytes)?;
    let header_line = bytes.split(|b| *b == b'\n').nth(first).unwrap_or_default();
    let separator = separator(header_line);
    let mut rows = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .delimiter(separator)
        .comment(Some(b'#'))
        .from_reader(bytes);
    let mut record = ByteRecord::new();
    let mut next = |record: &mut ByteRecord| rows.read_byte_record(record).unwrap_or(false);
    if !next(&mut record) {
        return Err(LogError::NoHeader { file: file.to_owned() });
    }
    let line = first as u64 + 1;
    let header: Vec<String> =
        record.iter().map(|cell| String::from_utf8_lossy(cell).trim().to_owned()).collect();
    let columns = Columns::of(file, line, &header, motions, names)?;
    let mut log = Log {
        files: vec![file.to_owned()],
        samples: 0,
        runs: Vec::new(),
        side,
        damaged: Vec::new(),
        unknown: columns.unknown.clone(),
    };
    let mut open: Option<Open> = None;
    while next(&mut record) {
        let line = record.position().map_or(0, csv::Position::line);
        match columns.sample(&record) {
            Err(reason) => log.damaged.push(Damaged { file: file.to_owned(), line, reason }),
            Ok(sample) => {
                log.samples += 1;
                let continues = open.as_ref().is_some_and(|run| run.takes(&sample));
                if !continues {
                    log.runs.extend(open.take().map(|run| run.close(file)));
                    open = Some(Open::new(&sample, &columns.signals, motions.len()));
                }
                if let Some(run) = &mut open {
                    run.push(sample);
                }
            }
        }
    }
    log.runs.extend(open.map(|run| run.close(file)));
    if log.runs.is_empty() {
        let first = log.damaged.into_iter().next();
        return Err(LogError::NoRows { file: file.to_owned(), cells: header.len(), first });
    }
    Ok(log)
}

/// What comments say of the torque side, and the index of the first line that is none.
fn comments(file: &str, bytes: &[u8]) -> Result<(Option<TorqueSide>, usize), LogError> {
    let (mut side, mut header) = (None, 0);
    let mut before = true;
    for (index, line) in bytes.split(|b| *b == b'\n').enumerate() {
        match line.strip_prefix(b"#") {
            Some(comment) => {
                let text = String::from_utf8_lossy(comment);
                if let Some((name, value)) = text.split_once('=')
                    && name.trim() == "torque_side"
                {
                    let word: String =
                        value.trim().chars().take_while(|c| c.is_alphanumeric()).collect();
                    let known = TorqueSide::named(&word).ok_or_else(|| LogError::Side {
                        file: file.to_owned(),
                        line: index as u64 + 1,
                        found: word,
                    })?;
                    side = Some(known);
                }
            }
            None if before && !line.trim_ascii().is_empty() => (before, header) = (false, index),
            // Comments may stand on top alone: a log of a million rows is not searched for them.
            None if !before => break,
            None => {}
        }
    }
    Ok((side, header))
}

fn separator(header: &[u8]) -> u8 {
    let count = |s: &u8| header.iter().filter(|b| *b == s).count();
    SEPARATORS.into_iter().rev().max_by_key(count).unwrap_or(b',')
}

impl Columns {
    fn of(
        file: &str,
        line: u64,
        header: &[String],
        motions: &[Motion],
        names: &Names,
    ) -> Result<Columns, LogError> {
        let mut heads: Vec<Option<Head>> = Vec::with_capacity(header.len());
        let (mut unknown, mut used) = (Vec::new(), BTreeMap::new());
        for (index, text) in header.iter().enumerate() {
            let found = names.role(text, &mut used)?;
            let Some((role, said)) = found else {
                unknown.push(text.clone());
                heads.push(None);
                continue;
            };
            let same = |head: &Option<Head>| head.as_ref().is_some_and(|h| h.role == role);
            if let Some(first) = heads.iter().position(same) {
                return Err(LogError::Twice {
                    file: file.to_owned(),
                    line,
                    first: first + 1,
                    second: index + 1,
                    name: role.name(),
                });
            }
            if let Role::Joint(_, joint) = role
                && joint >= motions.len()
            {
                return Err(LogError::Beyond {
                    file: file.to_owned(),
                    line,
                    found: text.clone(),
                    joints: motions.len(),
                });
            }
            // An index in brackets (`position[0]`) is no unit.
            let written = split(text).1.filter(|unit| unit.parse::<usize>().is_err());
            let unit = said.and_then(|theirs| theirs.unit.as_deref()).or(written);
            let mut scale = Scale::SI;
            if let (Some(quantity), Some(unit)) = (role.quantity(motions), unit) {
                scale = quantity.scale(unit).ok_or_else(|| LogError::Unit {
                    file: file.to_owned(),
                    line,
                    column: index + 1,
                    name: role.name(),
                    unit: unit.to_owned(),
                    known: quantity.units(),
                })?;
            }
            if let Some(theirs) = said {
                scale = Scale {
                    factor: scale.factor * theirs.factor,
                    offset: scale.factor * theirs.offset + scale.offset,
                };
            }
            heads.push(Some(Head { role, scale }));
        }
        if let Some((ours, theirs)) = names.unused(&used) {
            return Err(LogError::NoColumn {
                map: names.map_file().to_owned(),
                file: file.to_owned(),
                column: theirs.column.clone(),
                ours: ours.to_owned(),
            });
        }
        let mut columns = Columns { heads, unknown, signals: Vec::new() };
        columns.complete(file, line, motions.len())?;
        Ok(columns)
    }

    /// Every signal has all joints, and there are those that are needed.
    fn complete(&mut self, file: &str, line: u64, joints: usize) -> Result<(), LogError> {
        let roles: Vec<Role> = self.heads.iter().flatten().map(|head| head.role).collect();
        let missing = |missing: String, beside: String| {
            let suggestion = nearest(&missing, self.unknown.iter().map(String::as_str));
            let suggestion = suggestion.map(str::to_owned);
            let file = file.to_owned();
            Err(LogError::Missing { file, line, missing, beside, joints, suggestion })
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
                (None, _) if signal == Signal::Q => {
                    return missing("q1".to_owned(), "t".to_owned());
                }
                (None, _) => {}
            }
        }
        let needed = [Signal::Torque, Signal::Current, Signal::QCmd];
        if !needed.iter().any(|signal| self.signals.contains(signal)) {
            return Err(LogError::NothingLogged { file: file.to_owned(), line });
        }
        Ok(())
    }

    /// The numbers of a row, in SI; what damages it.
    fn sample(&self, record: &ByteRecord) -> Result<Sample, String> {
        if record.len() != self.heads.len() {
            return Err(format!("found {} cells, expected {}", record.len(), self.heads.len()));
        }
        let mut sample = Sample::default();
        sample.values.reserve(self.heads.len());
        for (cell, head) in record.iter().zip(&self.heads) {
            let Some(head) = head else { continue };
            let text = || String::from_utf8_lossy(cell).trim().to_owned();
            if matches!(head.role, Role::Run | Role::Payload) {
                match head.role {
                    Role::Run => sample.run = text(),
                    _ => sample.payload = text(),
                }
                continue;
            }
            let number = core::str::from_utf8(cell).ok().and_then(|c| c.trim().parse::<f64>().ok());
            let number = number.map(|x| head.scale.to_si(x)).filter(|x| x.abs() < LARGEST);
            let number = number.ok_or_else(|| {
                format!("found `{}` for {}, expected a number", text(), head.role.name())
            })?;
            match head.role {
                Role::Time => sample.t = number,
                Role::Joint(signal, joint) => sample.values.push((signal, joint, number)),
                Role::Contact => sample.contact = number != 0.0,
                // A wrench on the tool is kept out of the fits as contact is.
                _ => sample.contact |= number != 0.0,
            }
        }
        Ok(sample)
    }
}

impl Open {
    fn new(first: &Sample, signals: &[Signal], joints: usize) -> Open {
        Open {
            name: first.run.clone(),
            payload: first.payload.clone(),
            signals: signals.iter().map(|signal| (*signal, vec![Vec::new(); joints])).collect(),
            ..Open::default()
        }
    }

    /// Whether a sample goes on with this run: of the same name and payload, and not before it.
    fn takes(&self, sample: &Sample) -> bool {
        (&self.name, &self.payload) == (&sample.run, &sample.payload)
            && self.t.last().is_none_or(|last| sample.t >= *last)
    }

    fn push(&mut self, sample: Sample) {
        if self.t.last() == Some(&sample.t) {
            self.repeated += 1;
            return;
        }
        self.t.push(sample.t);
        self.contact.push(sample.contact);
        for (signal, joint, value) in sample.values {
            if let Some(joints) = self.signals.get_mut(&signal) {
                joints[joint].push(value);
            }
        }
    }

    fn close(self, file: &str) -> Run {
        Run {
            name: if self.name.is_empty() { file.to_owned() } else { self.name },
            clock: Clock::of(&self.t, self.repeated),
            t: self.t,
            signals: self.signals,
            payload: (!self.payload.is_empty()).then_some(self.payload),
            contact: self.contact,
        }
    }
}
