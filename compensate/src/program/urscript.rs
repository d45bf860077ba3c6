//! URScript, Universal Robots' language.
//!
//! Points are `p[x,y,z,rx,ry,rz]` and `[q1,…,q6]` as targets of motions, and variables with such values to which a
//! motion goes, also through `get_inverse_kin(pose, qnear)` and `pose_trans(frame, pose)`. The tool is that of the last
//! `set_tcp(p[…])` above; what `pose_trans` does not place stands in the robot's base.

use std::collections::HashMap;

use super::cursor::Cursor;
use super::edit::{Cell, si};
use super::lexer::{self, Token};
use super::point::{Place, Point, Values};
use super::{File, Found, Language};
use crate::io::Convention;

const MOTIONS: [&str; 5] = ["movej", "movel", "movep", "movec", "servoj"];

/// Calls around a target: one inverse and a few frames.
const MOST_CALLS: usize = 8;

const NESTED: &str = "it is computed by too many functions";

/// A pose or joint values that are written as numbers, or not.
enum Literal {
    Point(Values),
    /// Computed, or of another length.
    Other,
}

struct Reader<'f> {
    found: &'f mut Found,
    file: usize,
    tool: Place,
    /// The values of variables, and whether a motion goes to them is not known yet.
    variables: HashMap<String, Vec<Point>>,
    /// Calls around the target that is read.
    calls: usize,
}

pub(super) fn read(files: &[File], found: &mut Found) {
    let unsaid = Place::unsaid();
    let mut reader = Reader { found, file: 0, tool: unsaid, variables: HashMap::new(), calls: 0 };
    let tokens = |file: &File| lexer::unbroken(&file.text, &Language::UrScript.style());
    let tokens: Vec<Vec<Token>> = files.iter().map(tokens).collect();
    let texts = || files.iter().zip(&tokens).enumerate();
    for (file, (File { text, .. }, tokens)) in texts() {
        reader.file = file;
        reader.assignments(Cursor::new(text, tokens));
    }
    for (file, (File { text, .. }, tokens)) in texts() {
        reader.file = file;
        reader.motions(Cursor::new(text, tokens));
    }
    for (name, points) in reader.variables {
        for point in points {
            match reader.found.uses.of(&name) {
                Some(_) => reader.found.points.push(point),
                None => {
                    let because = "no motion goes to it by its name".to_owned();
                    reader.found.left.push(point.leave(because));
                }
            }
        }
    }
    reader.found.points.sort_by_key(|point| (point.file, point.span.start));
}

impl Reader<'_> {
    /// `name = p[…]`, and poses of frames.
    fn assignments(&mut self, mut at: Cursor<'_>) {
        while let Some(token) = at.peek() {
            let name = at.shown(token.span.clone());
            if at.word().is_none() {
                // A parameter of a call is no variable.
                if !(at.is_mark(b'(') && at.brackets()) {
                    at.next();
                }
                continue;
            }
            // A comparison is no assignment.
            let mut value = at.clone();
            if !value.mark(b'=') || value.is_mark(b'=') {
                continue;
            }
            if let Some(Literal::Point(values)) = literal(&mut value) {
                if let Values::Pose(cells) = &values {
                    let frame = pose(cells).map(|place| (name.to_lowercase(), place));
                    self.found.frames.extend(frame.clone());
                    self.found.tools.extend(frame);
                }
                let point = Point::new(&name, self.file, values);
                self.variables.entry(name).or_default().push(point);
            }
        }
    }

    fn motions(&mut self, mut at: Cursor<'_>) {
        while let Some(token) = at.peek() {
            let start = token.span.start;
            let Some(word) = at.word() else {
                at.next();
                continue;
            };
            if at.is_mark(b'=') {
                // An assigned value is in the variables.
                let mut value = at.clone();
                value.mark(b'=');
                if literal(&mut value).is_some() {
                    at = value;
                }
                continue;
            }
            if word == "p" && at.is_mark(b'[') {
                let from = at.span();
                at.brackets();
                let end = at.span().start.max(from.end);
                self.leave("p[…]", start..end, "it is no target of a motion");
                continue;
            }
            if !at.is_mark(b'(') || !(word == "set_tcp" || MOTIONS.contains(&word.as_str())) {
                continue;
            }
            at.mark(b'(');
            let mut inside = at.until(b")");
            let count = if word == "movec" { 2 } else { 1 };
            for _ in 0..count {
                let mut argument = inside.until(b",");
                inside.mark(b',');
                match word == "set_tcp" {
                    true => self.tool = place(&mut argument),
                    false => self.target(&word, argument, &Place::none(), None),
                }
            }
        }
    }

    /// A target: a literal, a variable, or one of them in a call.
    fn target(&mut self, motion: &str, mut at: Cursor<'_>, frame: &Place, near: Option<Vec<f64>>) {
        let mut named = at.clone();
        let is_key =
            |word: Option<String>| matches!(word.as_deref(), Some("q" | "pose" | "pose_to"));
        if is_key(named.word()) && named.mark(b'=') {
            at = named;
        }
        let span = at.span();
        if let Some(found) = literal(&mut at) {
            return match found {
                Literal::Point(values) if at.is_at_end() => {
                    let mut point = Point::new(motion, self.file, values);
                    (point.frame, point.tool) = (frame.clone(), self.tool.clone());
                    (point.rank, point.is_fixed) = (Some(self.found.uses.next()), true);
                    point.near = near;
                    self.found.points.push(point);
                }
                _ => self.leave(motion, span, "its value is not written as numbers alone"),
            };
        }
        let mut inside = at.clone();
        let Some(word) = inside.word() else { return };
        if inside.is_at_end() {
            return self.found.uses.add(&word, frame.clone(), self.tool.clone(), near);
        }
        if !inside.mark(b'(') {
            return;
        }
        let mut arguments = inside.until(b")");
        let mut first = arguments.until(b",");
        arguments.mark(b',');
        let second = arguments.until(b",");
        match word.as_str() {
            _ if self.calls >= MOST_CALLS => self.leave(motion, span, NESTED),
            "get_inverse_kin" => {
                let near = self.joints(second);
                self.calls += 1;
                self.target(motion, first, frame, near);
                self.calls -= 1;
            }
            "pose_trans" => {
                let placed = match (frame, place(&mut first)) {
                    (Place::Is(outer), Place::Is(inner)) => Place::Is(outer * inner),
                    (outer, inner) if *outer == Place::none() => inner,
                    _ => Place::Named(first.rest()),
                };
                self.calls += 1;
                self.target(motion, second, &placed, near);
                self.calls -= 1;
            }
            _ => self.leave(motion, span, "it is computed by a function"),
        }
    }

    /// Joint values by a variable's name or as they stand.
    fn joints(&self, mut at: Cursor<'_>) -> Option<Vec<f64>> {
        let mut named = at.clone();
        if named.word().as_deref() == Some("qnear") && named.mark(b'=') {
            at = named;
        }
        let of = |values: &Values| match values {
            Values::Joints(cells) => Some(si(cells)),
            Values::Pose(_) => None,
        };
        if let Some(Literal::Point(values)) = literal(&mut at.clone()) {
            return of(&values);
        }
        let name = at.peek().map(|token| at.shown(token.span.clone()))?;
        of(&self.variables.get(&name)?.first()?.values)
    }

    fn leave(&mut self, name: &str, span: core::ops::Range<usize>, because: &str) {
        self.found.leave(name, self.file, span, because);
    }
}

/// `p[…]` or `[…]` of six.
fn literal(at: &mut Cursor<'_>) -> Option<Literal> {
    let mut inside = at.clone();
    let is_pose = inside.word().is_some_and(|word| word == "p") && inside.is_mark(b'[');
    if !is_pose {
        inside = at.clone();
    }
    if !inside.mark(b'[') {
        return None;
    }
    let mut cells = Vec::new();
    let mut list = inside.until(b"]");
    inside.mark(b']');
    *at = inside;
    while !list.is_at_end() {
        let mut element = list.until(b",");
        list.mark(b',');
        let Some(cell) = element.number(1.0).filter(|_| element.is_at_end()) else {
            return Some(Literal::Other);
        };
        cells.push(cell);
    }
    Some(match cells.len() {
        6 if is_pose => Literal::Point(Values::Pose(cells)),
        6 => Literal::Point(Values::Joints(cells)),
        _ => Literal::Other,
    })
}

fn pose(cells: &[Cell]) -> Option<Place> {
    Place::of(Convention::RotationVector, cells)
}

/// A frame or tool, by its value or its name.
fn place(at: &mut Cursor<'_>) -> Place {
    let whole = at.rest();
    match literal(&mut at.clone()) {
        Some(Literal::Point(Values::Pose(cells))) => pose(&cells).unwrap_or(Place::Named(whole)),
        _ if whole.is_empty() => Place::unsaid(),
        _ => Place::Named(whole),
    }
}
