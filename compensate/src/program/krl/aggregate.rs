//! KRL's aggregates: `{X 1.0,Y 2.0}`.

use std::collections::HashMap;
use std::ops::Range;

use super::super::cursor::Cursor;
use super::super::edit::Cell;
use super::super::point::{Configuration, Place, Point, Values};
use super::super::{DEGREE, Fault, MILLIMETRE, fault};
use crate::io::Convention;

const POSE: [&str; 6] = ["x", "y", "z", "a", "b", "c"];
const AXES: [&str; 6] = ["a1", "a2", "a3", "a4", "a5", "a6"];

const WRONG_TURN: &str = "its T is no whole number below 64";

/// A component's value.
pub(super) enum Value {
    Number(Cell),
    /// `'B110010'`.
    Binary(Cell),
    /// An enumeration's word, or anything else, as it stands.
    Other(String),
}

/// `{X 1,Y 2}`.
pub(super) struct Aggregate {
    pub(super) parts: HashMap<String, Value>,
    pub(super) span: Range<usize>,
}

impl Aggregate {
    /// `{TYPE: name value, …}`.
    pub(super) fn read(file: usize, at: &mut Cursor<'_>) -> Result<Aggregate, Fault> {
        let start = at.span().start;
        at.mark(b'{');
        let mut typed = at.clone();
        if typed.word().is_some() && typed.mark(b':') {
            *at = typed;
        }
        let mut parts = HashMap::new();
        while !at.is_mark(b'}') {
            let help = "an aggregate is {X 1.0,Y 2.0}: names, each with its value";
            let Some(name) = at.word() else {
                return Err(fault(file, at, "the name of a component", help));
            };
            at.index();
            let unit = if matches!(name.as_str(), "x" | "y" | "z") { MILLIMETRE } else { DEGREE };
            let mut value = at.until(b",}");
            if value.is_at_end() {
                return Err(fault(file, at, &format!("a value of {}", name.to_uppercase()), help));
            }
            let (whole, start) = (value.rest().to_lowercase(), value.span().start);
            let number = value.number(unit).filter(|_| value.is_at_end());
            let value = match (number, binary(&whole)) {
                (Some(number), _) => Value::Number(number),
                (None, Some(bits)) => {
                    Value::Binary(Cell { value: bits, unit: 1.0, span: start..start + whole.len() })
                }
                (None, None) => Value::Other(whole),
            };
            parts.insert(name, value);
            at.mark(b',');
        }
        let end = at.span().end;
        at.mark(b'}');
        Ok(Aggregate { parts, span: start..end })
    }

    /// The point that it is; else why it is none.
    pub(super) fn point(&self, name: &str, file: usize) -> Result<Point, &'static str> {
        if let Some(axes) = self.numbers(&AXES) {
            return Ok(Point::new(name, file, Values::Joints(axes)));
        }
        let has = |names: &[&str]| names.iter().any(|name| self.parts.contains_key(*name));
        let Some(cells) = self.numbers(&POSE) else {
            return Err(match has(&AXES) || !has(&POSE) {
                true => "it does not give each of A1 … A6 as a number",
                false => "it does not give each of X, Y, Z, A, B, C as a number",
            });
        };
        let mut point = Point::new(name, file, Values::Pose(cells));
        let (turn, binary) = match self.parts.get("t") {
            None => return Ok(point),
            Some(Value::Number(turn)) => (turn, false),
            Some(Value::Binary(turn)) => (turn, true),
            Some(Value::Other(_)) => return Err(WRONG_TURN),
        };
        if !(0.0..64.0).contains(&turn.value) {
            return Err(WRONG_TURN);
        }
        point.configuration = Configuration::Signs { turn: turn.clone(), binary };
        Ok(point)
    }

    /// The place of a frame, if it is one.
    pub(super) fn place(&self) -> Option<Place> {
        Place::of(Convention::ABC, &self.numbers(&POSE)?)
    }

    /// The components of these names, if all are numbers.
    fn numbers(&self, names: &[&str]) -> Option<Vec<Cell>> {
        let number = |name: &&str| match self.parts.get(*name) {
            Some(Value::Number(cell)) => Some(cell.clone()),
            _ => None,
        };
        names.iter().map(number).collect()
    }
}

/// The number of `'b110010'`.
fn binary(text: &str) -> Option<f64> {
    let digits = text.strip_prefix("'b")?.strip_suffix('\'')?;
    let is_binary = digits.bytes().all(|byte| matches!(byte, b'0' | b'1'));
    is_binary.then(|| u32::from_str_radix(digits, 2).ok().map(f64::from)).flatten()
}
