//! The robot that a command is about: built-in by its id, or a file.

use std::path::Path;

use nalgebra::Isometry3;
use serde::Deserialize as _;
use stiffarm_codegen::robot::{Dimension as Cell, Effect, Frame, Motion, Robot, Symbol};
use stiffarm_gap::diagnose::{Cover, Trust};
use stiffarm_gap::effects::Known;
use stiffarm_gap::io::{Dimension, nearest};
use stiffarm_kernels::generic::Arm;
use stiffarm_robots::{ARMS, SYMBOLIC};

use super::quantity;
use crate::host::Host;
use crate::import::imported;
use crate::terminal::failure::{Failure, Remark};

/// Which robot.
#[derive(Clone, clap::Args)]
pub struct RobotArgs {
    /// A robot file (TOML), a URDF of one serial chain, the id of a built-in robot, or a diagnosis (JSON):
    /// the robot with what it found
    robot: String,
    /// A number for a symbolic parameter, in SI or with a unit: L1=0.6, L1=24in
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
}

/// A robot that was read.
#[derive(Clone)]
pub struct Source {
    /// As it was named on the command line.
    pub given: String,
    /// The model: parameters replaced by their numbers, effects taken into the table as far as it
    /// holds them.
    pub robot: Robot,
    /// The effects that are left.
    pub known: Vec<Known>,
    /// The effects that act in motion; some act at rest, too.
    pub motion: Vec<Effect>,
    /// The model without any effect taken into the table, or of motion.
    pub(super) file: Robot,
    /// The file's text.
    pub text: String,
    /// Whether it is one of the collection.
    pub built_in: bool,
    /// Of a diagnosis, where its data have been.
    pub covers: Option<Cover>,
    /// Of a diagnosis, how well its numbers are known elsewhere.
    pub trust: Option<Trust>,
}

impl RobotArgs {
    /// The robot of that file or id, whose parameters have numbers.
    pub fn named(robot: &str) -> RobotArgs {
        RobotArgs { robot: robot.to_owned(), set: Vec::new() }
    }

    /// The same with numbers for its symbolic parameters, each NAME=VALUE.
    #[must_use]
    pub fn set(self, set: Vec<String>) -> RobotArgs {
        RobotArgs { set, ..self }
    }

    /// Reads the robot and gives every symbolic parameter its number.
    ///
    /// # Errors
    /// [`Failure`]: no such robot, the file's mistakes, parameters without numbers.
    pub fn load(&self, host: &Host) -> Result<Source, Failure> {
        let source = read(&self.robot, host)?;
        let symbols = source.robot.symbols();
        let given = self.parameters(&source.robot.name, &symbols)?;
        let value = |name: &str| given.iter().rev().find(|(n, _)| n == name).map(|(_, v)| *v);
        match source.robot.with_parameters(value) {
            Ok(robot) => Source { file: robot.clone(), robot, ..source }.understood(),
            Err(missing) => Err(Failure::with_help(
                format!("{}: found no number for {}", source.robot.name, missing.join(", ")),
                format!("give each one with --set NAME=VALUE: {}", listing(&symbols)),
            )),
        }
    }

    fn parameters(&self, robot: &str, symbols: &[Symbol]) -> Result<Vec<(String, f64)>, Failure> {
        let each = self.set.iter().map(|text| {
            let (name, value) = text.split_once('=').ok_or_else(|| {
                Failure::new(format!("--set: found `{text}`, expected NAME=VALUE"))
            })?;
            let symbol = symbols.iter().find(|s| s.name == name.trim());
            let symbol = symbol.ok_or_else(|| unknown(robot, name.trim(), symbols))?;
            let number = quantity::read(value, dimension(symbol.dimension));
            let number = number.ok_or_else(|| {
                let unit = symbol.dimension.unit();
                let expected = if unit.is_empty() { "a number" } else { "a number in " };
                Failure::new(format!("--set {name}: found `{value}`, expected {expected}{unit}"))
            })?;
            Ok((symbol.name.clone(), number))
        });
        each.collect()
    }
}

impl Source {
    fn new(given: &str, robot: Robot, text: String, built_in: bool) -> Source {
        let (given, file) = (given.to_owned(), robot.clone());
        Source {
            given,
            robot,
            known: Vec::new(),
            motion: Vec::new(),
            file,
            text,
            built_in,
            covers: None,
            trust: None,
        }
    }

    /// The table as the textbook has it; what the file says beyond it is [`Source::known`].
    ///
    /// # Errors
    /// [`Failure`] if something in it has no number.
    pub fn arm(&self) -> Result<Arm, Failure> {
        Ok(stiffarm_gap::robot::arm(&self.robot)?)
    }

    /// The same for a command that stands at the arm's base.
    ///
    /// # Errors
    /// As [`Source::arm`].
    pub fn arm_at_its_base(&self) -> Result<Arm, Failure> {
        Ok(Arm { base: Isometry3::identity(), ..self.arm()? })
    }

    /// The same robot in its base's own axes.
    #[must_use]
    pub fn at_its_base(mut self) -> Source {
        self.robot.base = Frame::default();
        self.file.base = Frame::default();
        self
    }

    /// Columns of joint values as a controller shows them: `q1[deg]`, `q3[mm]`.
    pub fn heads(&self) -> impl Iterator<Item = String> {
        let unit = |reading| if reading == Dimension::Angle { "deg" } else { "mm" };
        let readings = self.readings().into_iter().enumerate();
        readings.map(move |(j, reading)| format!("q{}[{}]", j + 1, unit(reading)))
    }

    /// What the joint values are, base to tip.
    pub fn readings(&self) -> Vec<Dimension> {
        let of = |motion| match motion {
            Motion::Revolute => Dimension::Angle,
            Motion::Prismatic => Dimension::Length,
        };
        self.robot.joints.iter().map(|joint| of(joint.motion)).collect()
    }
}

/// Reads a robot; its symbolic parameters stay symbolic.
///
/// # Errors
/// [`Failure`]: no such robot, or the file's mistakes.
pub fn open(given: &str, host: &Host) -> Result<Source, Failure> {
    read(given, host)?.understood()
}

fn read(given: &str, host: &Host) -> Result<Source, Failure> {
    let ends = [".toml", ".json", ".urdf"].iter().any(|end| given.ends_with(end));
    let looks_like_a_path = given.contains(['/', '\\']) || ends;
    if !looks_like_a_path {
        if let Some(toml) = stiffarm_robots::toml(given) {
            let robot = parse(toml, given, &host.quiet(true))?;
            return Ok(Source::new(given, robot, toml.to_owned(), true));
        }
        if !host.owns(Path::new(given)) && !Path::new(given).exists() {
            return Err(no_such_robot(given));
        }
    }
    let text = text(Path::new(given), host)?;
    if given.ends_with(".json") {
        return diagnosis(given, &text, host);
    }
    if text.trim_start_matches('\u{feff}').trim_start().starts_with('<') {
        let imported = imported(given, &text, (None, None), false).inspect_err(|_| {
            let part = "imports a part of a URDF";
            host.note(&format!("`stiffarm import {given} --tip LINK --toml arm.toml` {part}"));
        });
        let (toml, remarks) = imported?;
        remarks.iter().for_each(|remark| host.note(remark));
        return Ok(Source::new(given, parse(&toml, given, host)?, toml, false));
    }
    let robot = parse(&text, given, host)?;
    Ok(Source::new(given, robot, text, false))
}

/// The robot file that a diagnosis in JSON holds, and what is known of its data.
fn diagnosis(given: &str, json: &str, host: &Host) -> Result<Source, Failure> {
    let read: Result<serde_json::Value, _> = serde_json::from_str(json);
    let read = read.map_err(|error| Failure::new(format!("{given}: this is no JSON: {error}")))?;
    let corrected = read["corrected"].as_str().ok_or_else(|| {
        Failure::with_help(
            format!("{given}: found no `corrected`, expected a diagnosis"),
            "`stiffarm diagnose ROBOT DATA --json OUT.json` writes one",
        )
    })?;
    let robot = parse(corrected, given, host)?;
    Ok(Source {
        covers: Cover::deserialize(&read["covers"]).ok(),
        trust: Trust::deserialize(&read["trust"]).ok(),
        ..Source::new(given, robot, corrected.to_owned(), false)
    })
}

fn parse(text: &str, path: &str, host: &Host) -> Result<Robot, Failure> {
    let remark = |located, doubt| Remark::located(located, text, doubt);
    match Robot::from_toml(text, path) {
        Ok((robot, warnings)) => {
            warnings.iter().for_each(|warning| host.warn(&remark(warning, true)));
            Ok(robot)
        }
        Err(error) => {
            let remarks = error.errors.iter().map(|located| remark(located, false));
            Err(Failure::File(remarks.collect()))
        }
    }
}

/// The text of a file.
///
/// # Errors
/// [`Failure`]: it cannot be read, or is not UTF-8.
pub fn text(path: &Path, host: &Host) -> Result<String, Failure> {
    let bytes = host.read(path)?;
    String::from_utf8(bytes).map_err(|error| {
        let (valid, bytes) = (error.utf8_error().valid_up_to(), error.as_bytes());
        let line = bytes[..valid].iter().filter(|b| **b == b'\n').count() + 1;
        let column = String::from_utf8_lossy(&bytes[..valid]).lines().last().map_or(0, |last| {
            if bytes[..valid].ends_with(b"\n") { 0 } else { last.chars().count() }
        });
        Failure::with_help(
            format!(
                "{}: line {line}, column {}: found byte 0x{:02x}, expected UTF-8 text",
                path.display(),
                column + 1,
                bytes[valid]
            ),
            "save the file as UTF-8",
        )
    })
}

fn no_such_robot(given: &str) -> Failure {
    let ids = ARMS.iter().map(|arm| arm.id).chain(SYMBOLIC.iter().map(|arm| arm.id));
    let near = nearest(given, ids);
    let meant = near.map_or_else(String::new, |id| format!("did you mean `{id}`? "));
    Failure::with_help(
        format!("found no robot `{given}`, expected a robot file or the id of a built-in robot"),
        format!("{meant}`stiffarm robots` lists the built-in ones"),
    )
}

fn unknown(robot: &str, name: &str, symbols: &[Symbol]) -> Failure {
    let message = format!("--set: {robot} has no symbolic parameter `{name}`");
    if symbols.is_empty() {
        return Failure::with_help(message, "every entry of its table is a number already");
    }
    let near = nearest(name, symbols.iter().map(|s| s.name.as_str()));
    let meant = near.map_or_else(String::new, |n| format!("did you mean `{n}`? "));
    Failure::with_help(message, format!("{meant}it has {}", listing(symbols)))
}

/// `L1 (m), E (Pa)`.
fn listing(symbols: &[Symbol]) -> String {
    let each = symbols.iter().map(|s| match s.dimension.unit() {
        "" => s.name.clone(),
        unit => format!("{} ({unit})", s.name),
    });
    each.collect::<Vec<_>>().join(", ")
}

/// The dimension whose units may stand behind a parameter's number.
fn dimension(cell: Cell) -> Option<Dimension> {
    match cell {
        Cell::Length => Some(Dimension::Length),
        Cell::Angle => Some(Dimension::Angle),
        _ => None,
    }
}
