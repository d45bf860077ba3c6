//! A point of a program.

use std::collections::HashMap;
use std::ops::Range;

use nalgebra::Isometry3;

use super::edit::{Cell, si};
use super::notation;
use crate::io::Convention;

/// Where a frame stands in the robot's base, or a tool on its flange.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// As the program, or the language, says.
    Is(Isometry3<f64>),
    /// By a name or number whose place the files do not say.
    Named(String),
}

/// The name of a frame or a tool of which a program says nothing.
pub const DEFAULT: &str = "default";

impl Place {
    /// The robot's base itself, or its flange.
    pub fn none() -> Place {
        Place::Is(Isometry3::identity())
    }

    /// A pose that is written as numbers, if it is one.
    pub(super) fn of(convention: Convention, cells: &[Cell]) -> Option<Place> {
        notation::pose(convention, &si(cells)).map(Place::Is)
    }

    /// One of which the program says nothing.
    pub fn unsaid() -> Place {
        Place::Named(DEFAULT.to_owned())
    }
}

/// The numbers of a point.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Three coordinates, and an orientation in the convention of the language.
    Pose(Vec<Cell>),
    /// Readings of all joints.
    Joints(Vec<Cell>),
}

/// What a point says of the joint values with which its pose is reached.
#[derive(Clone, Debug, PartialEq)]
pub enum Configuration {
    /// Nothing.
    Unsaid,
    /// KRL's turn: bit k is set where axis k + 1 is negative.
    Signs {
        /// The turn.
        turn: Cell,
        /// Whether it is written as `'B110010'`.
        binary: bool,
    },
    /// RAPID's `cf1`, `cf4`, `cf6`: the quarter turn in which axes 1, 4 and 6 are, the first from 0 to 90°.
    Quarters([Cell; 3]),
    /// FANUC's turn numbers of axes 1, 4 and 6: whole turns to the nearest of which the axis is.
    Turns([Cell; 3]),
}

/// A point of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// As the program names it, or the instruction in which it stands.
    pub name: String,
    /// Which of the files.
    pub file: usize,
    /// Its bytes, from the first number to the last.
    pub span: Range<usize>,
    /// Its numbers.
    pub values: Values,
    /// The frame in which a pose stands.
    pub frame: Place,
    /// The tool that a pose is of.
    pub tool: Place,
    /// With which joint values a pose is reached.
    pub configuration: Configuration,
    /// Joint values beside the ones with which a pose is reached, rad.
    pub near: Option<Vec<f64>>,
    /// Whether the point says its frame and tool itself.
    pub(super) is_fixed: bool,
    /// When the program goes to it, of one that has no name.
    pub(super) rank: Option<usize>,
}

/// What looks like a point and is left as it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Left {
    /// As the program names it.
    pub name: String,
    /// Which of the files.
    pub file: usize,
    /// Its bytes.
    pub span: Range<usize>,
    /// Why.
    pub because: String,
}

impl Point {
    /// A point of whose use nothing is known.
    pub(super) fn new(name: &str, file: usize, values: Values) -> Point {
        let (Values::Pose(cells) | Values::Joints(cells)) = &values;
        let start = cells.iter().map(|cell| cell.span.start).min().unwrap_or_default();
        let end = cells.iter().map(|cell| cell.span.end).max().unwrap_or_default();
        Point {
            name: name.to_owned(),
            file,
            span: start..end,
            values,
            frame: Place::unsaid(),
            tool: Place::unsaid(),
            configuration: Configuration::Unsaid,
            near: None,
            is_fixed: false,
            rank: None,
        }
    }

    /// Whether its numbers are a pose.
    pub fn is_pose(&self) -> bool {
        matches!(self.values, Values::Pose(_))
    }

    /// What is left of it as it is.
    pub fn leave(&self, because: String) -> Left {
        Left { name: self.name.clone(), file: self.file, span: self.span.clone(), because }
    }
}

/// Where and when a program goes to points that have names.
#[derive(Default)]
pub(super) struct Uses {
    by_name: HashMap<String, Use>,
    next: usize,
}

/// How a program goes to a point first.
pub(super) struct Use {
    pub(super) rank: usize,
    pub(super) frame: Place,
    pub(super) tool: Place,
    /// Joint values beside which it is reached.
    pub(super) near: Option<Vec<f64>>,
    /// Another frame or tool with which it goes there later.
    pub(super) other: Option<String>,
}

impl Uses {
    /// The next instruction goes to a point without a name.
    pub(super) fn next(&mut self) -> usize {
        self.next += 1;
        self.next
    }

    /// The next instruction goes to the point of that name.
    pub(super) fn add(&mut self, name: &str, frame: Place, tool: Place, near: Option<Vec<f64>>) {
        let rank = self.next();
        let first = self.by_name.entry(name.to_lowercase()).or_insert_with(|| Use {
            rank,
            frame: frame.clone(),
            tool: tool.clone(),
            near,
            other: None,
        });
        let pairs = [("frame", &first.frame, &frame), ("tool", &first.tool, &tool)];
        let differs = pairs.into_iter().find(|(_, a, b)| a != b);
        if let (Some((what, a, b)), None) = (differs, &first.other) {
            first.other = Some(format!("{what} {} and {}", told(a), told(b)));
        }
    }

    pub(super) fn of(&self, name: &str) -> Option<&Use> {
        self.by_name.get(&name.to_lowercase())
    }
}

fn told(place: &Place) -> String {
    match place {
        Place::Named(name) => name.clone(),
        Place::Is(pose) => {
            let [x, y, z] = [0, 1, 2].map(|k| 1e3 * pose.translation.vector[k] + 0.0);
            format!("at ({x:.3}, {y:.3}, {z:.3}) mm")
        }
    }
}
