//! FANUC's TP programs in letters: `.ls`.
//!
//! Points stand behind `/POS`: `P[1:"name"]{ GP1: UF : 1, UT : 2, CONFIG : 'N U T, 0, 0, 0', X = 1.0 mm, … };` or
//! `J1 = 1.0 deg, …`. Each says its user frame and tool by number. The lines behind `/MN` say in which order they are gone
//! to; a point of an incremental motion is left.

use super::cursor::Cursor;
use super::edit::Cell;
use super::lexer::{self, Kind, Token};
use super::point::{Configuration, Place, Point, Values};
use super::{DEGREE, Fault, File, Found, Language, MILLIMETRE, fault};

const POSE: [&str; 6] = ["x", "y", "z", "w", "p", "r"];
const AXES: [&str; 6] = ["j1", "j2", "j3", "j4", "j5", "j6"];

pub(super) fn read(files: &[File], found: &mut Found) -> Result<(), Fault> {
    for (file, File { text, .. }) in files.iter().enumerate() {
        let tokens = lexer::tokens(text, &Language::Fanuc.style());
        let mut increments = Vec::new();
        let lines = tokens.split(|token| token.kind == Kind::Newline);
        for line in lines.take_while(|line| section(text, line).as_deref() != Some("pos")) {
            motion(Cursor::new(text, line), found, &mut increments);
        }
        let is_section = |k: &usize| section(text, &tokens[*k..]).as_deref() == Some("pos");
        let Some(start) = (0..tokens.len()).find(is_section) else { continue };
        let mut points: Vec<Token> = tokens[start + 2..].to_vec();
        points.retain(|token| token.kind != Kind::Newline);
        let mut at = Cursor::new(text, &points);
        while let Some(name) = at.word().filter(|word| word == "p") {
            let name = position(&mut at, name);
            point(file, &name, &mut at, found, &increments)?;
        }
    }
    for known in [&mut found.frames, &mut found.tools] {
        known.insert("0".to_owned(), Place::none());
    }
    Ok(())
}

/// The name of a section that a line begins: `/POS`.
fn section(text: &[u8], line: &[Token]) -> Option<String> {
    let mut at = Cursor::new(text, line);
    at.mark(b'/').then(|| at.word()).flatten()
}

/// `[1:"name"]`, as `P[1]`.
fn position(at: &mut Cursor<'_>, word: String) -> String {
    at.mark(b'[');
    let mut inside = at.until(b"]");
    at.mark(b']');
    let number = inside.until(b":").rest();
    format!("{}[{number}]", word.to_uppercase())
}

/// `1:L P[2] 100mm/sec FINE INC ;`
fn motion(mut line: Cursor<'_>, found: &mut Found, increments: &mut Vec<String>) {
    let mut names = Vec::new();
    let mut is_increment = false;
    while !line.is_at_end() {
        match line.word() {
            Some(word) if word == "p" && line.is_mark(b'[') => {
                names.push(position(&mut line, word));
            }
            Some(word) => is_increment |= word == "inc",
            None => drop(line.next()),
        }
    }
    for name in names {
        // Each point says its frame and tool itself: the order alone is of interest.
        found.uses.add(&name, Place::unsaid(), Place::unsaid(), None);
        if is_increment {
            increments.push(name);
        }
    }
}

/// `{ GP1: …, … };`
fn point(
    file: usize,
    name: &str,
    at: &mut Cursor<'_>,
    found: &mut Found,
    increments: &[String],
) -> Result<(), Fault> {
    let start = at.span();
    if !at.mark(b'{') {
        return Err(fault(file, at, "`{`", "a position is P[1]{ GP1: … };"));
    }
    let mut inside = at.until(b"}");
    if at.is_at_end() {
        return Err(fault(file, at, "`}`", "each { of a position has its }"));
    }
    at.mark(b'}');
    at.mark(b';');
    let span = start.start..at.span().start.max(start.end);
    let mut leave = |because: &str| found.leave(name, file, span.clone(), because);
    let group = (inside.word(), inside.mark(b':'));
    if group != (Some("gp1".to_owned()), true) {
        leave("it is none of motion group 1");
        return Ok(());
    }
    let mut cells: Vec<(String, Cell)> = Vec::new();
    let (mut frame, mut tool, mut turns) = (Place::unsaid(), Place::unsaid(), None);
    while let Some(key) = inside.word() {
        // The next group's axes are others.
        if key.starts_with("gp") && inside.is_mark(b':') {
            break;
        }
        let mut value = inside.clone();
        if !(value.mark(b':') || value.mark(b'=')) {
            return Err(fault(file, &value, "`:` or `=`", "write UF : 1 or X = 1.0 mm"));
        }
        inside = value.clone();
        let mut value = inside.until(b",");
        inside.mark(b',');
        match key.as_str() {
            "uf" => frame = Place::Named(value.rest()),
            "ut" => tool = Place::Named(value.rest()),
            "config" => turns = configuration(&value),
            _ => {
                let unit = if key.starts_with(['x', 'y', 'z']) { MILLIMETRE } else { DEGREE };
                let Some(cell) = value.number(unit) else {
                    leave("it is not taught: its values are no numbers");
                    return Ok(());
                };
                // A value without a comma behind it ends with its unit.
                let expected = if unit == MILLIMETRE { "mm" } else { "deg" };
                let found = value.word();
                if found.as_deref() != Some(expected) && POSE.contains(&key.as_str()) {
                    leave("its values are not in mm and deg");
                    return Ok(());
                }
                cells.push((key, cell));
            }
        }
    }
    let all = |names: [&str; 6]| {
        let one = |name: &&str| cells.iter().find(|(key, _)| key == name).map(|(_, c)| c.clone());
        names.iter().map(one).collect::<Option<Vec<Cell>>>()
    };
    let values = all(POSE).map(Values::Pose).or_else(|| all(AXES).map(Values::Joints));
    match values {
        _ if increments.iter().any(|increment| increment == name) => {
            leave("its motion is an increment (INC)");
        }
        None => leave("it gives neither X, Y, Z, W, P, R nor J1 … J6"),
        Some(values) => {
            let mut point = Point::new(name, file, values);
            (point.frame, point.tool, point.is_fixed) = (frame, tool, true);
            point.configuration = turns.map_or(Configuration::Unsaid, Configuration::Turns);
            found.points.push(point);
        }
    }
    Ok(())
}

/// The turn numbers of `'N U T, 0, 0, 0'`.
fn configuration(value: &Cursor<'_>) -> Option<[Cell; 3]> {
    let text = value.peek().filter(|token| token.kind == Kind::Text)?;
    let inside = text.span.start + 1..text.span.end.saturating_sub(1);
    let tokens: Vec<Token> = lexer::tokens(&value.text[inside.clone()], &Language::Fanuc.style());
    let mut at = Cursor::new(&value.text[inside.clone()], &tokens);
    let mut turns = Vec::new();
    while !at.is_at_end() {
        match at.number(1.0) {
            Some(Cell { value, unit, span }) => {
                let span = span.start + inside.start..span.end + inside.start;
                turns.push(Cell { value, unit, span });
            }
            None => drop(at.next()),
        }
    }
    turns.try_into().ok()
}
