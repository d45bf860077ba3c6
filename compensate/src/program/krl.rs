//! KRL, KUKA's language: `.src` and `.dat`.
//!
//! Points are aggregates, `{X 1,Y 2,Z 3,A 4,B 5,C 6,S 2,T 10}` or `{A1 0,…,A6 0}`: values of variables of the types
//! E6POS, POS, E6AXIS and AXIS, of a FRAME to which a motion goes, and targets of motions. A point `XP1` whose FDAT
//! `FP1` is in the files has its base and tool by their numbers; another has those that are in force where the program,
//! read from top to bottom, goes to it first: `$BASE = …`, `$TOOL = …`, `BAS(#BASE, 2)`, `BAS(#TOOL, 3)`.

mod aggregate;

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use super::cursor::Cursor;
use super::lexer::{self, Kind};
use super::point::{Place, Point};
use super::{Fault, File, Found, Language};
use aggregate::{Aggregate, Value};

/// Instructions that go to points.
const MOTIONS: [&str; 7] = ["ptp", "lin", "circ", "sptp", "slin", "scirc", "spl"];

/// Types whose values are points wherever they are used.
const POINTS: [&str; 4] = ["e6pos", "pos", "e6axis", "axis"];

const IN_EXPRESSION: &str = "it stands in an expression";

struct Reader<'f> {
    found: &'f mut Found,
    file: usize,
    /// In force at this line.
    base: Place,
    tool: Place,
    /// The types of declared variables.
    types: HashMap<String, String>,
    /// FRAMEs: points if a motion goes to them.
    frames: Vec<Point>,
    /// Base, tool, and whether the tool stands still, of each FDAT.
    fdat: HashMap<String, (Place, Place, bool)>,
    /// Variables of targets that are expressions: `LIN SHIFT:XP1`.
    expressions: HashSet<String>,
}

pub(super) fn read(files: &[File], found: &mut Found) -> Result<(), Fault> {
    let mut reader = Reader {
        found,
        file: 0,
        base: Place::unsaid(),
        tool: Place::unsaid(),
        types: HashMap::new(),
        frames: Vec::new(),
        fdat: HashMap::new(),
        expressions: HashSet::new(),
    };
    // Data lists first: a program's types stand there.
    let is_data = |file: &File| file.name.to_lowercase().ends_with(".dat");
    let mut order: Vec<usize> = (0..files.len()).collect();
    order.sort_by_key(|k| !is_data(&files[*k]));
    for file in order {
        reader.file = file;
        let text = &files[file].text;
        let tokens = lexer::tokens(text, &Language::Krl.style());
        for line in tokens.split(|token| token.kind == Kind::Newline) {
            reader.line(Cursor::new(text, line))?;
        }
    }
    reader.end();
    Ok(())
}

impl Reader<'_> {
    fn line(&mut self, mut at: Cursor<'_>) -> Result<(), Fault> {
        let mut kind = None;
        loop {
            let before = at.clone();
            let Some(word) = at.word() else { return Ok(()) };
            match word.as_str() {
                "decl" | "global" | "const" => {}
                "def" | "deffct" => {
                    (self.base, self.tool) = (Place::unsaid(), Place::unsaid());
                    return Ok(());
                }
                "bas" => return self.initial(at),
                motion if MOTIONS.contains(&motion) => return self.motion(&word, at),
                relative if relative.ends_with("_rel") => {
                    let shown = word.to_uppercase();
                    return self.leave_all(
                        &shown,
                        at,
                        "its motion is relative to the point before",
                    );
                }
                _ if kind.is_none() && at.peek().is_some_and(|token| token.kind == Kind::Word) => {
                    kind = Some(word);
                }
                _ => {
                    let declared = self.assigned(kind.as_deref(), before.clone())?;
                    return match declared {
                        true => Ok(()),
                        false => self.leave_all("{…}", before, IN_EXPRESSION),
                    };
                }
            }
        }
    }

    /// `BAS(#BASE, 2)`.
    fn initial(&mut self, mut at: Cursor<'_>) -> Result<(), Fault> {
        at.mark(b'(');
        let which = at.word();
        let number = at.mark(b',').then(|| Place::Named(at.until(b")").rest()));
        match (which.as_deref(), number) {
            (Some("#base"), Some(place)) => self.base = place,
            (Some("#tool"), Some(place)) => self.tool = place,
            (Some("#frames"), _) => (self.base, self.tool) = (Place::unsaid(), Place::unsaid()),
            _ => {}
        }
        Ok(())
    }

    /// `NAME[1] = value, NAME …`; false where it is no such list.
    fn assigned(&mut self, kind: Option<&str>, mut at: Cursor<'_>) -> Result<bool, Fault> {
        loop {
            let Some(token) = at.peek().filter(|token| token.kind == Kind::Word) else {
                return Ok(false);
            };
            let shown = at.shown(token.span.clone());
            let Some(name) = at.word() else { return Ok(false) };
            let index = at.index().filter(|index| !index.is_at_end());
            let index = index.map_or_else(String::new, |index| index.rest());
            if let Some(kind) = kind {
                self.types.insert(name.clone(), kind.to_owned());
            }
            if at.mark(b'=') {
                self.value(&shown, &index, at.until(b","))?;
            }
            if !at.mark(b',') {
                return Ok(at.is_at_end());
            }
        }
    }

    fn value(&mut self, shown: &str, index: &str, at: Cursor<'_>) -> Result<(), Fault> {
        let name = shown.to_lowercase();
        match name.as_str() {
            "$base" => self.base = self.place(at)?,
            "$tool" => self.tool = self.place(at)?,
            "base_data" | "tool_data" => {
                let place = self.place(at)?;
                let into = if name == "base_data" {
                    &mut self.found.frames
                } else {
                    &mut self.found.tools
                };
                into.insert(index.to_owned(), place);
            }
            // What the controller itself defines is no program's point.
            system if system.starts_with('$') => {}
            _ if at.is_mark(b'{') => {
                let aggregate = Aggregate::read(self.file, &mut at.clone())?;
                let kind = self.types.get(&name).map(String::as_str);
                let full =
                    if index.is_empty() { shown.to_owned() } else { format!("{shown}[{index}]") };
                match kind {
                    Some("fdat") => self.fdat(&name, &aggregate),
                    Some("frame") => {
                        let point = aggregate.point(&full, self.file);
                        self.frames.extend(point.ok());
                    }
                    Some(kind) if !POINTS.contains(&kind) => {}
                    _ => self.add(&full, &aggregate, None),
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// The base or tool that is assigned.
    fn place(&self, mut at: Cursor<'_>) -> Result<Place, Fault> {
        let whole = at.rest();
        if at.is_mark(b'{') {
            let aggregate = Aggregate::read(self.file, &mut at)?;
            let pose = aggregate.place();
            let at_end = at.is_at_end();
            return Ok(pose.filter(|_| at_end).unwrap_or(Place::Named(whole)));
        }
        Ok(match at.word().as_deref() {
            Some("$nullframe") if at.is_at_end() => Place::none(),
            Some("base_data" | "tool_data") => {
                let index = at.index().filter(|_| at.is_at_end() && whole.ends_with(']'));
                Place::Named(index.map_or(whole, |index| index.rest()))
            }
            _ => Place::Named(whole),
        })
    }

    fn fdat(&mut self, name: &str, aggregate: &Aggregate) {
        let number = |key: &str| match aggregate.parts.get(key) {
            Some(Value::Number(cell)) => Place::Named(format!("{}", cell.value)),
            _ => Place::unsaid(),
        };
        let stands =
            matches!(aggregate.parts.get("ipo_frame"), Some(Value::Other(word)) if word == "#tcp");
        let frames = (number("base_no"), number("tool_no"), stands);
        self.fdat.insert(name.to_owned(), frames);
    }

    /// `PTP target`, `CIRC target, target`.
    fn motion(&mut self, motion: &str, mut at: Cursor<'_>) -> Result<(), Fault> {
        let shown = motion.to_uppercase();
        loop {
            let target = at.until(b",");
            let mut inside = target.clone();
            if inside.is_mark(b'{') {
                let aggregate = Aggregate::read(self.file, &mut inside)?;
                if inside.is_mark(b':') {
                    self.leave(&shown, aggregate.span, IN_EXPRESSION);
                    self.expression(&shown, inside)?;
                } else {
                    let rank = self.found.uses.next();
                    self.add(&shown, &aggregate, Some(rank));
                }
            } else if let Some(mut name) = inside.word() {
                if let Some(index) = inside.index() {
                    name = format!("{name}[{}]", index.rest());
                }
                if inside.is_mark(b':') {
                    self.expressions.insert(name);
                    self.expression(&shown, inside)?;
                } else {
                    self.found.uses.add(&name, self.base.clone(), self.tool.clone(), None);
                }
            }
            if !at.mark(b',') {
                return Ok(());
            }
        }
    }

    /// What stands behind the `:` of a target: variables and aggregates whose frames are others.
    fn expression(&mut self, shown: &str, mut at: Cursor<'_>) -> Result<(), Fault> {
        let mut names = at.clone();
        while !names.is_at_end() {
            match names.word() {
                Some(name) => drop(self.expressions.insert(name)),
                None if names.brackets() => {}
                None => drop(names.next()),
            }
        }
        at.mark(b':');
        self.leave_all(shown, at, IN_EXPRESSION)
    }

    fn add(&mut self, name: &str, aggregate: &Aggregate, rank: Option<usize>) {
        match aggregate.point(name, self.file) {
            Ok(mut point) => {
                if rank.is_some() {
                    (point.frame, point.tool) = (self.base.clone(), self.tool.clone());
                    (point.rank, point.is_fixed) = (rank, true);
                }
                self.found.points.push(point);
            }
            Err(because) => self.leave(name, aggregate.span.clone(), because),
        }
    }

    fn leave(&mut self, name: &str, span: Range<usize>, because: &str) {
        self.found.leave(name, self.file, span, because);
    }

    /// Leaves every aggregate of a line that would be a point.
    fn leave_all(&mut self, name: &str, mut at: Cursor<'_>, because: &str) -> Result<(), Fault> {
        while !at.is_at_end() {
            if !at.is_mark(b'{') {
                at.next();
                continue;
            }
            let aggregate = Aggregate::read(self.file, &mut at)?;
            if aggregate.point(name, self.file).is_ok() {
                self.leave(name, aggregate.span, because);
            }
        }
        Ok(())
    }

    /// What only the whole program says: FRAMEs that are points, and the FDAT of each point.
    fn end(self) {
        for point in self.frames {
            if self.found.uses.of(&point.name).is_some() {
                self.found.points.push(point);
            }
        }
        let points = core::mem::take(&mut self.found.points);
        for mut point in points {
            let name = point.name.to_lowercase();
            let of = name.strip_prefix('x').and_then(|name| self.fdat.get(&format!("f{name}")));
            let Some((base, tool, stands)) = of else {
                if self.expressions.contains(&point.name.to_lowercase()) {
                    self.found.left.push(point.leave(IN_EXPRESSION.to_owned()));
                } else {
                    self.found.points.push(point);
                }
                continue;
            };
            if *stands {
                let because = "its tool stands still and the work piece moves (#TCP)".to_owned();
                self.found.left.push(point.leave(because));
                continue;
            }
            (point.frame, point.tool, point.is_fixed) = (base.clone(), tool.clone(), true);
            self.found.points.push(point);
        }
        for known in [&mut self.found.frames, &mut self.found.tools] {
            known.entry("0".to_owned()).or_insert_with(Place::none);
        }
    }
}
