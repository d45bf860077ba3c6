//! Reads a tree of values into the model by the schema: unknown, missing and misplaced keys, and every value at its
//! place.

use super::cells::{Expected, Language, Reader};
use super::checks;
use super::effect;
use super::field::{Absent, Bound, Field, Slot};
use super::fields::{BEAM, FRAME, JOINT, MARKER, PAYLOAD, ROBOT, ROWS};
use super::node::{Node, Table};
use super::section;
use crate::number::Number;
use crate::robot::frames::{Wanted, ask};
use crate::robot::lexeme::{Kind, show};
use crate::robot::problem::{Place, Problem, Report};
use crate::robot::suggest::{advice, closest};
use crate::robot::{Beam, Convention, Frame, Joint, Motion, Robot, Value};

/// The words of a convention.
pub(crate) const CONVENTIONS: [(&str, Convention); 2] =
    [("standard", Convention::Standard), ("modified", Convention::Modified)];
/// The words of a joint's motion.
pub(crate) const MOTIONS: [(&str, Motion); 2] =
    [("revolute", Motion::Revolute), ("prismatic", Motion::Prismatic)];
/// Where the torques of a log are measured.
pub(crate) const SIDES: [(&str, &str); 5] = [
    ("motor", "motor"),
    ("link", "link"),
    ("current", "current"),
    ("commanded", "commanded"),
    ("external", "external"),
];
/// How the entries of a tensor of inertia stand.
pub(crate) const TENSOR: &str = "[xx, xy, xz, yy, yz, zz]";

/// A table that was read: where it and its values stand.
pub(crate) struct Record<L> {
    /// The table.
    pub at: L,
    /// Its values, and whether each could be read.
    cells: Vec<(&'static str, L, bool)>,
}

impl<L> Record<L> {
    /// Where a value stands, if the table has it.
    pub fn at(&self, key: &str) -> Option<&L> {
        self.cells.iter().find(|cell| cell.0 == key).map(|(_, at, _)| at)
    }

    /// The same of a value that could be read.
    pub fn whole(&self, key: &str) -> Option<&L> {
        self.cells.iter().find(|cell| cell.0 == key && cell.2).map(|(_, at, _)| at)
    }
}

/// Reads a robot. It is only to be used if the report has no errors: what could not be read has a neutral value.
pub(crate) fn read<L: Place>(root: &Node<L>, language: Language, report: &mut Report<L>) -> Robot {
    let mut reader = Reader::new(language, report);
    let mut robot = Robot::default();
    let record = reader.table(ROBOT, "a robot file", root, &mut robot);
    checks::parameters(&mut reader);
    checks::size(&mut reader);
    if let Some(table) = root.table().filter(|_| robot.dof() > 0) {
        let outputs = table.get("outputs").map(|node| outputs(node, &mut reader));
        ask(&mut robot, &outputs.unwrap_or_default(), reader.report);
        let name = record.and_then(|record| record.whole("carries").cloned());
        let name = name.and_then(|at| Some((reader.word(table.get("carries")?)?, at)));
        carry(&mut robot, name.as_ref(), reader.report);
    }
    robot
}

/// Hangs a payload on the tool, where nothing is wrong with the rest.
pub(crate) fn carry<L: Place>(
    robot: &mut Robot,
    name: Option<&(String, L)>,
    report: &mut Report<L>,
) {
    let Some((name, at)) = name.filter(|_| report.errors.is_empty()) else { return };
    if let Err(no) = robot.carry(name) {
        report.error(Problem::new(at.clone(), no.message).help(no.help));
    }
}

/// Names of outputs, one or more, each with the frame at which it is asked for.
pub(crate) fn outputs<L: Place>(node: &Node<L>, reader: &mut Reader<'_, L>) -> Vec<(Wanted, L)> {
    let Some(names) = node.list() else {
        reader.expected(node, "an array of outputs");
        return Vec::new();
    };
    if names.is_empty() {
        let help = "leave `outputs` out for all of them";
        reader.refuse(&node.at, "an array of no outputs", help);
    }
    let mut asked = |name: &Node<L>| match Wanted::read(&reader.word(name)?) {
        Ok(asked) => Some((asked, name.at.clone())),
        Err(no) => {
            reader.refuse(&name.at, no.message, no.help);
            None
        }
    };
    names.iter().filter_map(&mut asked).collect()
}

impl<L: Place> Reader<'_, L> {
    /// Reads a table; `None` (and an error) if the value is none.
    pub fn table<T>(
        &mut self,
        fields: &[Field<T>],
        what: &str,
        node: &Node<L>,
        into: &mut T,
    ) -> Option<Record<L>> {
        let table = self.open(&super::field::keys(fields), what, node)?;
        let mut record = Record { at: node.at.clone(), cells: Vec::new() };
        for field in fields {
            match (table.0.get(field.name), field.absent) {
                (Some(value), _) if !said_absent(field, value) => {
                    let whole = self.fill(field, value, into);
                    record.cells.push((field.name, value.at.clone(), whole));
                }
                (None, Absent::Mistake(help)) => self.missing(field.name, what, node, help, &table),
                _ => {}
            }
        }
        Some(record)
    }

    /// Opens a table: its unknown keys are reported, and those which they were probably meant to be are told.
    pub fn open<'n>(
        &mut self,
        keys: &[&'static str],
        what: &str,
        node: &'n Node<L>,
    ) -> Option<(&'n Table<L>, Vec<&'static str>)> {
        let Some(table) = node.table() else {
            self.expected(node, &format!("the table {what}"));
            return None;
        };
        let mut meant = Vec::new();
        for pair in table.pairs.iter().filter(|pair| !keys.contains(&pair.key.as_str())) {
            meant.extend(closest(&pair.key, keys.iter().copied()));
            let message = match self.language {
                Language::File => format!("unknown key `{}` in {what}", pair.key),
                Language::Macro => format!("unknown key `{}`", pair.key),
            };
            self.refuse(&pair.at, message, advice(&pair.key, keys));
        }
        Some((table, meant))
    }

    /// Reports a key that is missing, unless another was meant to be it.
    pub fn missing(
        &mut self,
        key: &'static str,
        what: &str,
        node: &Node<L>,
        help: &str,
        (table, meant): &(&Table<L>, Vec<&'static str>),
    ) {
        if meant.contains(&key) || table.meant.iter().any(|known| known == key) {
            return;
        }
        match (self.language, key) {
            (_, "joint") if what == "a robot file" => {
                self.refuse(&node.at, "a robot has at least one joint", help);
            }
            (Language::File, _) => {
                self.refuse(&node.at, format!("`{key}` is missing in {what}"), help);
            }
            (Language::Macro, _) => self.refuse(&node.at, format!("`{key}` is missing here"), ""),
        }
    }

    /// Reads the value of a field into its place; whether it could be read.
    pub(super) fn fill<T>(&mut self, field: &Field<T>, node: &Node<L>, into: &mut T) -> bool {
        let expected = field
            .dimension(self.motion)
            .map(|dimension| Expected { dimension, number: field.number });
        let number = |value: &Option<Value>| value.as_ref().and_then(Value::number);
        let slot = (field.slot)(into);
        // What a cell measures depends on a motion that may not be known: it is then left unread.
        let Some(cell) = expected else { return self.fill_other(slot, node) };
        match slot {
            Slot::Angle(to) => put(to, self.angle(node, cell)),
            Slot::Value(to) => {
                let read = self.value(node, cell);
                self.bounded(field.bound, number(&read), node);
                put(to, read)
            }
            Slot::Maybe(to) => {
                *to = self.value(node, cell);
                self.bounded(field.bound, number(to), node);
                to.is_some()
            }
            Slot::Vector(to) => put(to, self.values(node, "[x, y, z]", cell)),
            Slot::MaybeVector(to) => set(to, self.values(node, "[x, y, z]", cell)),
            Slot::Tensor(to) => set(to, self.values(node, TENSOR, cell)),
            Slot::Rotation(to) => put(to, self.rotation(node, cell)),
            Slot::Limits(to, _) => set(to, self.limits(node, cell)),
            other => self.fill_other(other, node),
        }
    }

    /// The same of what holds no number.
    fn fill_other(&mut self, slot: Slot<'_>, node: &Node<L>) -> bool {
        match slot {
            Slot::Text(to) => put(to, self.text(node)),
            Slot::MaybeText(to) => set(to, self.text(node)),
            Slot::Convention(to) => put(to, self.choice(node, &CONVENTIONS)),
            Slot::Motion(to) => {
                self.motion = self.choice(node, &MOTIONS);
                put(to, self.motion)
            }
            Slot::Side(to) => set(to, self.choice(node, &SIDES)),
            Slot::Row(to) => put(to, self.row(node)),
            Slot::Section(to) => put(to, section::read(self, node)),
            Slot::Beam(to) => {
                let mut beam = Beam::default();
                let record = self.table(BEAM, "[joint.beam]", node, &mut beam);
                *to = record.map(|record| {
                    checks::beam(&record, self);
                    beam
                });
                to.is_some()
            }
            Slot::Frame(to, fields, what) => {
                let mut frame = Frame::default();
                let record = self.table(fields, what, node, &mut frame);
                put(to, record.map(|_| frame))
            }
            Slot::Joints(to) => self.joints(node, to),
            Slot::Frames(to) => {
                let records = self.tables(FRAME, "frame", node, to);
                checks::names("frame", to.iter().map(|frame| frame.name.as_str()), &records, self);
                let named = to.iter().zip(&records);
                named.for_each(|(frame, record)| checks::module(&frame.name, record, self));
                true
            }
            Slot::Markers(to) => {
                let records = self.tables(MARKER, "marker", node, to);
                checks::names("marker", to.iter().map(|m| m.name.as_str()), &records, self);
                true
            }
            Slot::Payloads(to) => {
                let records = self.tables(PAYLOAD, "payload", node, to);
                checks::names("payload", to.iter().map(|p| p.name.as_str()), &records, self);
                for (payload, record) in to.iter().zip(&records) {
                    checks::inertia(payload.inertia.as_ref(), record, "the tool's", self);
                }
                true
            }
            Slot::Effects(to) => {
                *to = self
                    .each(node, "effect")
                    .iter()
                    .filter_map(|n| effect::read(self, n))
                    .collect();
                true
            }
            // Read when all else has been, and numbers of joints whose motion is not known.
            _ => !node.is_broken(),
        }
    }

    /// The tables of a list of tables; an error if it is something else.
    fn each<'n>(&mut self, node: &'n Node<L>, name: &str) -> &'n [Node<L>] {
        if let Some(tables) = node.list() {
            return tables;
        }
        if let Some(found) = node.kind {
            let message = format!("{found} stands where [[{name}]] tables are expected");
            let help = format!("write [[{name}]] with two brackets, once for each");
            self.refuse(&node.at, message, help);
        }
        &[]
    }

    /// Reads each of a list of tables; one whose value is none is left out.
    fn tables<T: Default>(
        &mut self,
        fields: &[Field<T>],
        name: &str,
        node: &Node<L>,
        to: &mut Vec<T>,
    ) -> Vec<Record<L>> {
        let mut records = Vec::new();
        for table in self.each(node, name) {
            let mut one = T::default();
            self.motion = None;
            if let Some(record) = self.table(fields, &format!("[[{name}]]"), table, &mut one) {
                to.push(one);
                records.push(record);
            }
        }
        records
    }

    fn joints(&mut self, node: &Node<L>, to: &mut Vec<Joint>) -> bool {
        let records = self.tables(JOINT, "joint", node, to);
        if node.list().is_some_and(<[_]>::is_empty) {
            self.refuse(&node.at, "a robot has at least one joint", ROWS);
        }
        checks::count(&records, self);
        checks::names("joint", to.iter().map(|joint| joint.name.as_str()), &records, self);
        for (index, (joint, record)) in to.iter_mut().zip(&records).enumerate() {
            if record.whole("name").is_none() {
                joint.name = format!("joint {}", index + 1);
            }
            checks::joint(joint, record, self);
        }
        self.labels = to.iter().map(|joint| joint.name.clone()).collect();
        true
    }

    /// A joint by its number from 1 or by its name, as a row.
    fn row(&mut self, node: &Node<L>) -> Option<usize> {
        let told = match (&node.words, node.kind) {
            (Some(words), None | Some("a number")) => match words.as_slice() {
                [word] if matches!(word.kind, Kind::Number(_)) => Ok(show(words).parse().ok()),
                words => Err(show(words)),
            },
            _ => Err(self.word(node)?),
        };
        let labels: Vec<&str> = self.labels.iter().map(String::as_str).collect();
        let (found, shown, help) = match told {
            Ok(number) => {
                let row = number.and_then(|k: usize| k.checked_sub(1));
                let help = format!("its joints are 1 to {}, or their names", labels.len());
                let shown = number.map_or_else(|| "this".to_owned(), |k| format!("joint {k}"));
                (row.filter(|row| *row < labels.len()), shown, help)
            }
            Err(label) => {
                let row = labels.iter().position(|known| *known == label);
                (row, format!("`{label}`"), advice(&label, &labels))
            }
        };
        if found.is_none() {
            self.refuse(&node.at, format!("{shown} is no joint of this arm"), help);
        }
        found
    }

    fn bounded(&mut self, bound: Bound, number: Option<Number>, node: &Node<L>) {
        let Some(n) = number else { return };
        match bound {
            Bound::Above(what, help) if n.is_negative() || n.is_zero() => {
                self.refuse(&node.at, format!("{what} is {n}: it must be above zero"), help);
            }
            Bound::NotBelow(what) if n.is_negative() => {
                self.refuse(&node.at, format!("{what} is {n}: it must not be below zero"), "");
            }
            _ => {}
        }
    }
}

/// Whether the word stands in a field that says that it is absent.
fn said_absent<T, L>(field: &Field<T>, node: &Node<L>) -> bool {
    let word = node.words.as_deref().and_then(|words| match words {
        [word] => word.name(),
        _ => None,
    });
    field.word.is_some() && word == field.word
}

/// Puts what was read in its place; whether it could be read.
fn put<T>(to: &mut T, read: Option<T>) -> bool {
    read.map(|read| *to = read).is_some()
}

fn set<T>(to: &mut Option<T>, read: Option<T>) -> bool {
    *to = read;
    to.is_some()
}
