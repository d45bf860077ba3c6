//! The robot file: TOML, read with the place of every value so that each mistake can be pointed at.

mod beam;
mod effect;
mod fields;
mod joint;
mod reader;
#[cfg(test)]
mod tests;
mod write;

use core::ops::Range;

use ::toml::Spanned;
use ::toml::de::{DeTable, DeValue, Error};

use super::beyond::EffectError;
use super::diagnostic::{FileError, Located, Warning};
use super::draft::{Cell, Draft, DraftFrame, DraftMarker, DraftNamedFrame, DraftPayload};
use super::model::{Convention, Robot};
use super::problem::{Problem, Report};
use super::validate::validate;
use fields::Fields;
use reader::Reader;

const KEYS: &[&str] = &[
    "name",
    "convention",
    "gravity",
    "torque_side",
    "joint",
    "base",
    "tool",
    "frame",
    "marker",
    "effect",
    "payload",
    "carries",
    "outputs",
];

impl Robot {
    /// Reads a robot file. `path` is only used in messages.
    ///
    /// # Errors
    /// Every mistake in the file, in the order in which they stand.
    pub fn from_toml(text: &str, path: &str) -> Result<(Robot, Vec<Warning>), FileError> {
        let (table, errors) = DeTable::parse_recoverable(text);
        let mut reader = Reader::new(text);
        let robot = if syntax(text, errors, &mut reader.report) {
            let draft = draft(&mut reader, &table);
            Some(validate(&draft, &mut reader.report))
        } else {
            None
        };
        let report = reader.report;
        match robot {
            Some(robot) if report.errors.is_empty() => {
                Ok((robot, Located::all(path, text, report.warnings)))
            }
            _ => Err(FileError::new(path, text, report)),
        }
    }

    /// The same for kernels: its effects are understood ([`Robot::with_effects`]).
    ///
    /// # Errors
    /// Every mistake in the file, else every effect of which no kernel can be made.
    pub fn for_kernels(text: &str, path: &str) -> Result<(Robot, Vec<Warning>), FileError> {
        let (robot, warnings) = Robot::from_toml(text, path)?;
        let robot = robot.with_effects().map_err(|wrong| {
            let problem =
                |e: EffectError| Problem { at: e.at.span, message: e.message, help: e.help };
            let errors = wrong.into_iter().map(problem).collect();
            FileError::new(path, text, Report { errors, ..Report::new() })
        })?;
        Ok((robot, warnings))
    }
}

/// Reports what is no TOML; whether the rest can still be read. A value without its quotes and a
/// key that stands twice leave the rest intact; behind the first other mistake all is guesswork.
fn syntax(text: &str, errors: Vec<Error>, report: &mut Report<Range<usize>>) -> bool {
    let mut broken: Option<Problem<Range<usize>>> = None;
    for error in errors {
        let at = error.span().unwrap_or(0..0);
        let found = text.get(at.clone()).unwrap_or_default();
        let message = error.message();
        if message.starts_with("string values must be quoted") {
            let problem = Problem::new(at.clone(), format!("`{found}` stands without quotes"));
            report.error(problem.help(format!("write \"{found}\"")));
        } else if message.starts_with("duplicate key") {
            report.error(Problem::new(at, format!("`{found}` stands here for the second time")));
        } else if broken.as_ref().is_none_or(|first| at.start < first.at.start) {
            broken = Some(Problem::new(at, format!("this is no TOML: {message}")));
        }
    }
    let readable = broken.is_none();
    if let Some(first) = &broken {
        report.errors.retain(|soft| soft.at.start < first.at.start);
    }
    report.errors.extend(broken);
    readable
}

fn draft(reader: &mut Reader<'_>, root: &Spanned<DeTable<'_>>) -> Draft<Range<usize>> {
    let fields = Fields::open(reader, root.get_ref(), root.span(), "a robot file", KEYS);
    let joints = fields.get("joint").map(|value| joint::read_all(reader, value));
    if joints.is_none() && !fields.misspelt("joint") {
        let problem = Problem::new(fields.at(), "a robot has at least one joint");
        reader.report.error(problem.help("write one [[joint]] table per row, base to tip"));
    }
    Draft {
        name: fields.required(reader, "name", "write name = \"…\"").map(|v| reader.string(v)),
        convention: fields
            .required(reader, "convention", "write convention = \"standard\" or \"modified\"")
            .map(|v| reader.choice(v, &CONVENTIONS)),
        gravity: fields.get("gravity").map(|v| reader.values(v, super::Dimension::Acceleration)),
        torque_side: fields.get("torque_side").map(|v| reader.choice(v, &TORQUE_SIDES)),
        joints: joints.unwrap_or_default(),
        base: frame(reader, &fields, "base", "[base]"),
        tool: frame(reader, &fields, "tool", "[tool]"),
        frames: fields.get("frame").map(|v| named_frames(reader, v)).unwrap_or_default(),
        markers: fields.get("marker").map(|v| markers(reader, v)).unwrap_or_default(),
        effects: fields.get("effect").map(|v| effect::read_all(reader, v)).unwrap_or_default(),
        payloads: fields.get("payload").map(|v| payloads(reader, v)).unwrap_or_default(),
        carries: fields.get("carries").map(|v| reader.string(v)),
        outputs: fields.get("outputs").map(|v| reader.outputs(v)).unwrap_or_default(),
    }
}

const CONVENTIONS: [(&str, Convention); 2] =
    [("standard", Convention::Standard), ("modified", Convention::Modified)];

/// Where the torques of a log are measured.
const TORQUE_SIDES: [(&str, &str); 5] = [
    ("motor", "motor"),
    ("link", "link"),
    ("current", "current"),
    ("commanded", "commanded"),
    ("external", "external"),
];

fn frame(
    reader: &mut Reader<'_>,
    robot: &Fields<'_, '_>,
    name: &str,
    what: &'static str,
) -> DraftFrame<Range<usize>> {
    let value = robot.get(name);
    let keys = &["translation", "rotation"];
    let Some(fields) = value.and_then(|value| Fields::of(reader, value, what, keys)) else {
        return DraftFrame::default();
    };
    let lengths = fields.get("translation");
    // The world is no part of the arm: where it stands is known when the code is made.
    let translation = lengths.map(|v| match name {
        "base" => reader.known_lengths(v, "where the base stands cannot stay symbolic"),
        _ => reader.values(v, super::Dimension::Length),
    });
    DraftFrame { translation, rotation: fields.get("rotation").map(|v| reader.rotation(v)) }
}

fn named_frames(
    reader: &mut Reader<'_>,
    value: &Spanned<DeValue<'_>>,
) -> Vec<DraftNamedFrame<Range<usize>>> {
    let mut found = Vec::new();
    for value in reader.tables(value, "frame") {
        let keys = &["name", "joint", "translation", "rotation"];
        let Some(fields) = Fields::of(reader, value, "[[frame]]", keys) else { continue };
        let name = fields.required(reader, "name", "write name = \"…\"").map(|v| reader.string(v));
        let help = "write joint = 3, or the name of the joint on whose link the frame is";
        let joint = fields.required(reader, "joint", help).map(|v| reader.joint(v));
        let lengths = fields.get("translation");
        let translation = lengths.map(|v| reader.known_lengths(v, "write its place"));
        let rotation = fields.get("rotation").map(|v| reader.rotation(v));
        found.push(DraftNamedFrame {
            name: name.unwrap_or_else(|| Cell::broken(fields.at())),
            joint: joint.unwrap_or_else(|| Cell::broken(fields.at())),
            frame: DraftFrame { translation, rotation },
        });
    }
    found
}

fn markers(
    reader: &mut Reader<'_>,
    value: &Spanned<DeValue<'_>>,
) -> Vec<DraftMarker<Range<usize>>> {
    let mut found = Vec::new();
    for value in reader.tables(value, "marker") {
        let keys = &["name", "translation"];
        let Some(fields) = Fields::of(reader, value, "[[marker]]", keys) else { continue };
        let translation = fields.get("translation").map(|v| {
            reader.known_lengths(v, "leave `translation` out where a marker's place is unknown")
        });
        let name = fields.required(reader, "name", "write name = \"…\"").map(|v| reader.string(v));
        if let Some(name) = name {
            found.push(DraftMarker { name, translation });
        }
    }
    found
}

fn payloads(
    reader: &mut Reader<'_>,
    value: &Spanned<DeValue<'_>>,
) -> Vec<DraftPayload<Range<usize>>> {
    let mut found = Vec::new();
    for value in reader.tables(value, "payload") {
        let keys = &["name", "mass", "com", "inertia"];
        let Some(fields) = Fields::of(reader, value, "[[payload]]", keys) else { continue };
        let name = fields.required(reader, "name", "write name = \"…\"").map(|v| reader.string(v));
        let reason = "a payload is weighed, not chosen: write numbers";
        let mass = fields.required(reader, "mass", "write mass = 5.0");
        let mass = mass.map(|v| reader.number(v, super::Dimension::Mass, reason));
        let com = fields.get("com").map(|v| reader.known_lengths(v, "write its place"));
        found.push(DraftPayload {
            name: name.unwrap_or_else(|| Cell::broken(fields.at())),
            mass: mass.unwrap_or_else(|| Cell::broken(fields.at())),
            com,
            inertia: fields.get("inertia").map(|v| (v.span(), reader.known_inertia(v, reason))),
        });
    }
    found
}
