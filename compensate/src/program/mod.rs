//! Programs of robot controllers: the points that they hold, and the files with these points written anew.
//!
//! A program is read as tokens of its language. What is no point, and every byte of a point that is no number of
//! its place, stays as it is.

mod cursor;
mod edit;
mod entries;
mod fanuc;
mod krl;
mod lexer;
pub(crate) mod notation;
mod point;
mod rapid;
mod table;
mod urscript;

use std::collections::HashMap;
use std::ops::Range;

use nalgebra::Isometry3;

use crate::io::Convention;
pub use edit::{Cell, Change, edited, si};
pub use entries::{Entry, entries};
use lexer::{Kind, Style};
use point::Uses;
pub use point::{Configuration, DEFAULT, Left, Place, Point, Values};

/// Languages of programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// KUKA's: `.src`, `.dat`.
    Krl,
    /// ABB's: `.mod`, `.modx`, `.sys`, `.prg`.
    Rapid,
    /// FANUC's TP in letters: `.ls`.
    Fanuc,
    /// Universal Robots': `.script`.
    UrScript,
    /// A table of poses or joint values: `.csv`.
    Table,
}

/// A file of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct File {
    /// As the user named it.
    pub name: String,
    /// Its bytes.
    pub text: Vec<u8>,
}

/// What is wrong with a file, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Which of the files.
    pub file: usize,
    /// Which of its bytes.
    pub span: Range<usize>,
    /// What was found and expected.
    pub message: String,
    /// How to mend it.
    pub help: String,
}

/// The files of a program, and what was found in them.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// As they were given.
    pub files: Vec<File>,
    /// Their language.
    pub language: Language,
    /// In the order in which the program goes to them first, then those to which it does not go.
    pub points: Vec<Point>,
    /// What looks like a point and is left as it is.
    pub left: Vec<Left>,
}

/// What is read of a program's files.
#[derive(Default)]
struct Found {
    points: Vec<Point>,
    left: Vec<Left>,
    uses: Uses,
    /// Frames and tools that the files define, by their names.
    frames: HashMap<String, Place>,
    tools: HashMap<String, Place>,
}

const MILLIMETRE: f64 = 1e-3;
const DEGREE: f64 = core::f64::consts::PI / 180.0;

impl Language {
    /// By the end of a file's name.
    pub fn of(name: &str) -> Option<Language> {
        let (_, end) = name.rsplit_once('.')?;
        Some(match end.to_lowercase().as_str() {
            "src" | "dat" => Language::Krl,
            "mod" | "modx" | "sys" | "prg" => Language::Rapid,
            "ls" => Language::Fanuc,
            "script" => Language::UrScript,
            "csv" => Language::Table,
            _ => return None,
        })
    }

    /// How orientations are written.
    pub fn convention(self) -> Convention {
        match self {
            Language::Krl => Convention::ABC,
            Language::Rapid => Convention::Quaternion,
            Language::Fanuc => Convention::RPY,
            Language::UrScript | Language::Table => Convention::RotationVector,
        }
    }

    /// How a pose is written, as `--frame` takes it.
    pub fn pose_format(self) -> &'static str {
        match self {
            Language::Krl => "X,Y,Z,A,B,C in mm and degrees",
            Language::Rapid => "x,y,z,q1,q2,q3,q4 in mm and a quaternion",
            Language::Fanuc => "X,Y,Z,W,P,R in mm and degrees",
            Language::UrScript | Language::Table => "x,y,z,rx,ry,rz in m and rad",
        }
    }

    /// Metres and radians of the numbers of poses.
    fn units(self) -> [f64; 2] {
        match self {
            Language::Krl | Language::Fanuc => [MILLIMETRE, DEGREE],
            Language::Rapid => [MILLIMETRE, 1.0],
            Language::UrScript | Language::Table => [1.0, 1.0],
        }
    }

    fn style(self) -> Style {
        let (comment, header, sigils, quotes): (u8, Option<u8>, &[u8], &[u8]) = match self {
            Language::Krl => (b';', Some(b'&'), b"$#", b"\"'"),
            Language::Rapid => (b'!', Some(b'%'), b"", b"\""),
            Language::Fanuc => (b'!', None, b"$", b"\"'"),
            Language::UrScript | Language::Table => (b'#', None, b"", b"\""),
        };
        Style { comment, header, sigils, quotes }
    }

    /// A pose that stands in an option, by its numbers in the units of the language; names and brackets between them
    /// may stay.
    pub fn pose(self, text: &str) -> Option<Isometry3<f64>> {
        let all = lexer::tokens(text.as_bytes(), &self.style());
        let mut at = cursor::Cursor::new(text.as_bytes(), &all);
        let [length, angle] = self.units();
        let mut numbers = Vec::new();
        while !at.is_at_end() {
            let unit = if numbers.len() < 3 { length } else { angle };
            match at.number(unit) {
                Some(cell) => numbers.push(cell.si()),
                None => drop(at.next()),
            }
        }
        let sound = numbers.len() == 3 + self.convention().numbers();
        sound.then(|| notation::pose(self.convention(), &numbers)).flatten()
    }
}

impl Program {
    /// Reads the files of one program, of an arm with `joints` joints.
    ///
    /// # Errors
    /// [`Fault`]: the first thing in a point that is none of its language.
    pub fn read(files: Vec<File>, language: Language, joints: usize) -> Result<Program, Fault> {
        let mut found = Found::default();
        match language {
            Language::Krl => krl::read(&files, &mut found)?,
            Language::Rapid => rapid::read(&files, &mut found)?,
            Language::Fanuc => fanuc::read(&files, &mut found)?,
            Language::UrScript => urscript::read(&files, &mut found),
            Language::Table => table::read(&files, joints, &mut found)?,
        }
        let Found { points, left, uses, frames, tools } = found;
        let mut program = Program { files, language, points, left };
        program.place(&uses, &frames, &tools);
        Ok(program)
    }

    /// Gives each point the frame and tool of its use, and the order of it; what is used in two ways is left.
    fn place(
        &mut self,
        uses: &Uses,
        frames: &HashMap<String, Place>,
        tools: &HashMap<String, Place>,
    ) {
        let mut placed = Vec::new();
        for (k, mut point) in core::mem::take(&mut self.points).into_iter().enumerate() {
            let used = uses.of(&point.name);
            let rank = used.map_or((usize::MAX, k), |used| (used.rank, k));
            let rank = point.rank.map_or(rank, |rank| (rank, k));
            if let Some(used) = used {
                if !point.is_fixed {
                    (point.frame, point.tool) = (used.frame.clone(), used.tool.clone());
                    point.near = point.near.or_else(|| used.near.clone());
                }
                if let (Some(other), false, Values::Pose(_)) =
                    (&used.other, point.is_fixed, &point.values)
                {
                    let because = format!("the program goes to it in two ways: {other}");
                    self.left.push(point.leave(because));
                    continue;
                }
            }
            let named = |place: Place, of: &HashMap<String, Place>| match &place {
                Place::Named(name) => of.get(&name.to_lowercase()).cloned().unwrap_or(place),
                Place::Is(_) => place,
            };
            point.frame = named(point.frame, frames);
            point.tool = named(point.tool, tools);
            placed.push((rank, point));
        }
        placed.sort_by_key(|(rank, _)| *rank);
        self.points = placed.into_iter().map(|(_, point)| point).collect();
        self.left.sort_by_key(|left| (left.file, left.span.start));
    }
}

impl File {
    /// Line and column of a byte, from 1; a column is a character, or a byte of what is no UTF-8.
    pub fn line_and_column(&self, at: usize) -> (usize, usize) {
        let before = &self.text[..at.min(self.text.len())];
        let start = before.iter().rposition(|b| *b == b'\n').map_or(0, |end| end + 1);
        let column = 1 + String::from_utf8_lossy(&before[start..]).chars().count();
        (edit::line(&self.text, before.len()), column)
    }
}

impl Found {
    fn leave(&mut self, name: &str, file: usize, span: Range<usize>, because: &str) {
        let (name, because) = (name.to_owned(), because.to_owned());
        self.left.push(Left { name, file, span, because });
    }
}

/// A fault at a token.
fn fault(file: usize, at: &cursor::Cursor<'_>, expected: &str, help: &str) -> Fault {
    let found = match at.peek() {
        Some(token) if token.kind == Kind::Newline => "the end of the line".to_owned(),
        Some(token) => format!("`{}`", at.shown(token.span.clone())),
        None => "the end".to_owned(),
    };
    let message = format!("found {found}, expected {expected}");
    Fault { file, span: at.span(), message, help: help.to_owned() }
}

#[cfg(test)]
mod tests;
