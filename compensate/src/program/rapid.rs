//! RAPID, ABB's language.
//!
//! Points are values of the types robtarget, `[[x,y,z],[q1,q2,q3,q4],[cf1,cf4,cf6,cfx],[e1,…,e6]]`, and jointtarget,
//! `[[a1,…,a6],[e1,…,e6]]`: of variables, elements of arrays, assignments, and targets of move instructions. The tool and
//! work object of a point are those of the move instruction that goes to it first; their values are taken from
//! `tooldata` and `wobjdata` of the files.

use std::collections::HashMap;
use std::ops::Range;

use super::cursor::Cursor;
use super::edit::Cell;
use super::lexer::{self, Kind};
use super::point::{Configuration, Place, Point, Values};
use super::{DEGREE, Fault, File, Found, Language, MILLIMETRE, fault};
use crate::io::Convention;

/// What the names of instructions begin with that go to points, and whose last argument is the tool.
const MOTIONS: [&str; 8] = ["move", "triggl", "triggj", "triggc", "search", "arc", "spot", "disp"];

/// `[…]`, by its elements.
struct List<'t> {
    elements: Vec<Element<'t>>,
    span: Range<usize>,
}

enum Element<'t> {
    List(List<'t>),
    Number(Cell),
    Other(Cursor<'t>),
}

struct Reader<'f> {
    found: &'f mut Found,
    file: usize,
    /// Of each declared variable.
    types: HashMap<String, String>,
}

pub(super) fn read(files: &[File], found: &mut Found) -> Result<(), Fault> {
    let mut reader = Reader { found, file: 0, types: HashMap::new() };
    for (file, File { text, .. }) in files.iter().enumerate() {
        reader.file = file;
        let tokens = lexer::unbroken(text, &Language::Rapid.style());
        reader.text(Cursor::new(text, &tokens))?;
    }
    found.frames.insert("wobj0".to_owned(), Place::none());
    found.tools.insert("tool0".to_owned(), Place::none());
    Ok(())
}

impl Reader<'_> {
    fn text(&mut self, mut at: Cursor<'_>) -> Result<(), Fault> {
        while let Some(token) = at.peek() {
            if token.kind != Kind::Word {
                match at.is_mark(b'[') {
                    true => self.loose(&mut at)?,
                    false => drop(at.next()),
                }
                continue;
            }
            let shown = at.shown(token.span.clone());
            let Some(word) = at.word() else { continue };
            if MOTIONS.iter().any(|motion| word.starts_with(motion)) {
                self.motion(&shown, at.until(b";"))?;
            } else if matches!(word.as_str(), "robtarget" | "jointtarget" | "tooldata" | "wobjdata")
            {
                if let Some(name) = at.peek().filter(|token| token.kind == Kind::Word) {
                    let name = at.shown(name.span.clone()).to_lowercase();
                    self.types.insert(name, word);
                }
            } else if at.is_mark(b'{') || at.is_mark(b':') {
                let mut index = String::new();
                if at.mark(b'{') {
                    index = format!("{{{}}}", at.until(b"}").rest());
                    at.mark(b'}');
                }
                if at.marks(b":=") && at.is_mark(b'[') {
                    let list = self.list(&mut at, DEEPEST)?;
                    self.value(&shown, &index, list);
                }
            }
        }
        Ok(())
    }

    /// What is assigned to a variable.
    fn value(&mut self, name: &str, index: &str, list: List<'_>) {
        match self.types.get(&name.to_lowercase()).map(String::as_str) {
            Some("tooldata") => self.tool(name, &list),
            Some("wobjdata") => self.work_object(name, &list),
            Some("robtarget" | "jointtarget") => {
                let full = format!("{name}{index}");
                match self.point(name, &list) {
                    Some(point) => self.found.points.push(point),
                    None if list.is_array() => {
                        for element in &list.elements {
                            let Element::List(list) = element else { continue };
                            match self.point(name, list) {
                                Some(point) => self.found.points.push(point),
                                None => self.leave(&full, list.span.clone(), COMPUTED),
                            }
                        }
                    }
                    None => self.leave(&full, list.span, COMPUTED),
                }
            }
            // What is declared in a file that is not here may be a point, and looks like one.
            _ => self.found.points.extend(self.point(name, &list)),
        }
    }

    /// A list that is assigned to nothing: of an expression.
    fn loose(&mut self, at: &mut Cursor<'_>) -> Result<(), Fault> {
        let list = self.list(at, DEEPEST)?;
        if self.point("", &list).is_some() {
            self.leave("[…]", list.span, "it stands in an expression");
        }
        Ok(())
    }

    /// `MoveL p10, v100, z10, tool0 \WObj:=wobj1;`
    fn motion(&mut self, shown: &str, mut at: Cursor<'_>) -> Result<(), Fault> {
        let mut arguments = Vec::new();
        let (mut object, mut tool) = (Place::none(), None);
        loop {
            // Optional arguments stand behind a backslash, also between others.
            let mut whole = at.until(b",");
            arguments.push(whole.until(b"\\"));
            while whole.mark(b'\\') {
                let mut optional = whole.until(b"\\");
                let name = optional.word();
                let given = optional.marks(b":=").then(|| optional.rest());
                match (name.as_deref(), given) {
                    (Some("wobj"), Some(name)) => object = Place::Named(name),
                    (Some("tool"), Some(name)) => tool = Some(Place::Named(name)),
                    _ => {}
                }
            }
            if !at.mark(b',') {
                break;
            }
        }
        let last = || arguments.last().map_or_else(Place::unsaid, |last| Place::Named(last.rest()));
        let tool = tool.unwrap_or_else(last);
        for argument in &mut arguments {
            if argument.is_mark(b'[') {
                let list = self.list(argument, DEEPEST)?;
                let Some(mut point) = self.point(shown, &list) else { continue };
                (point.frame, point.tool) = (object.clone(), tool.clone());
                (point.rank, point.is_fixed) = (Some(self.found.uses.next()), true);
                self.found.points.push(point);
            } else if let Some(name) = argument.word() {
                if argument.is_at_end() || argument.is_mark(b'{') {
                    self.found.uses.add(&name, object.clone(), tool.clone(), None);
                } else {
                    while !argument.is_at_end() {
                        match argument.is_mark(b'[') {
                            true => self.loose(argument)?,
                            false => drop(argument.next()),
                        }
                    }
                }
            }
        }
        Ok(())
    }

    fn point(&self, name: &str, list: &List<'_>) -> Option<Point> {
        match &list.elements[..] {
            [Element::List(axes), Element::List(external)] if external.elements.len() == 6 => {
                let axes = axes.numbers(6, DEGREE)?;
                Some(Point::new(name, self.file, Values::Joints(axes)))
            }
            [Element::List(place), Element::List(turn), Element::List(data), Element::List(_)] => {
                let (place, turn) = (place.numbers(3, MILLIMETRE)?, turn.numbers(4, 1.0)?);
                let [one, four, six, _] = data.numbers(4, 1.0)?.try_into().ok()?;
                let values = Values::Pose([place, turn].concat());
                let configuration = Configuration::Quarters([one, four, six]);
                Some(Point { configuration, ..Point::new(name, self.file, values) })
            }
            _ => None,
        }
    }

    /// `[TRUE, [[x,y,z],[q1,q2,q3,q4]], load]`.
    fn tool(&mut self, name: &str, list: &List<'_>) {
        let place = match &list.elements[..] {
            [held, Element::List(frame), _] if held.is("true") => frame.frame(),
            _ => None,
        };
        self.found.tools.extend(place.map(|place| (name.to_lowercase(), place)));
    }

    /// `[FALSE, TRUE, "", user frame, object frame]`.
    fn work_object(&mut self, name: &str, list: &List<'_>) {
        let place = match &list.elements[..] {
            [held, fixed, _, Element::List(user), Element::List(object)]
                if held.is("false") && fixed.is("true") =>
            {
                user.frame().zip(object.frame()).and_then(|pair| match pair {
                    (Place::Is(user), Place::Is(object)) => Some(Place::Is(user * object)),
                    _ => None,
                })
            }
            _ => None,
        };
        self.found.frames.extend(place.map(|place| (name.to_lowercase(), place)));
    }

    fn leave(&mut self, name: &str, span: Range<usize>, because: &str) {
        self.found.leave(name, self.file, span, because);
    }

    fn list<'t>(&self, at: &mut Cursor<'t>, levels: usize) -> Result<List<'t>, Fault> {
        let start = at.span().start;
        at.mark(b'[');
        let mut elements = Vec::new();
        while !at.mark(b']') {
            let mut element = at.until(b",]");
            if at.is_at_end() {
                return Err(fault(self.file, at, "`]`", "each [ of a value has its ]"));
            }
            elements.push(if element.is_mark(b'[') && levels > 0 {
                Element::List(self.list(&mut element, levels - 1)?)
            } else {
                let whole = element.clone();
                let number = element.number(1.0).filter(|_| element.is_at_end());
                number.map_or(Element::Other(whole), Element::Number)
            });
            at.mark(b',');
        }
        let end = at.span().start;
        Ok(List { elements, span: start..end })
    }
}

/// Levels of brackets below a value's first: an array of robtargets has two, a work object two.
const DEEPEST: usize = 4;

const COMPUTED: &str = "its value is not written as numbers alone";

impl Element<'_> {
    fn is(&self, word: &str) -> bool {
        matches!(self, Element::Other(at) if at.rest().eq_ignore_ascii_case(word))
    }
}

impl List<'_> {
    /// Its numbers in a unit, if it has so many and nothing else.
    fn numbers(&self, count: usize, unit: f64) -> Option<Vec<Cell>> {
        let number = |element: &Element<'_>| match element {
            Element::Number(cell) => Some(Cell { unit, ..cell.clone() }),
            _ => None,
        };
        let all: Option<Vec<Cell>> = self.elements.iter().map(number).collect();
        all.filter(|all| all.len() == count)
    }

    fn frame(&self) -> Option<Place> {
        let [Element::List(place), Element::List(turn)] = &self.elements[..] else { return None };
        let cells = [place.numbers(3, MILLIMETRE)?, turn.numbers(4, 1.0)?].concat();
        Place::of(Convention::Quaternion, &cells)
    }

    /// Whether it may be an array: of lists of lists.
    fn is_array(&self) -> bool {
        let deep = |element: &Element<'_>| match element {
            Element::List(list) => matches!(list.elements.first(), Some(Element::List(_))),
            _ => false,
        };
        self.elements.iter().all(deep)
    }
}
