//! What became of the points of a program: a table, and its summary.

use stiffarm_compensate::points::{Moved, Unmoved};
use stiffarm_compensate::program::{Left, Point, Program};
use stiffarm_document::text::{Align, bold, counted, dim, indented, short, table, wrapped};
use stiffarm_gap::io::{Columns, quoted};

use super::rounded;
use crate::input::source::Source;
use stiffarm_gap::measurement::Dimension;

/// A point and what became of it.
pub(super) struct Outcome<'p> {
    pub(super) point: &'p Point,
    pub(super) moved: Result<Moved, Unmoved>,
}

/// Most points that the screen shows.
const SHOWN: usize = 12;

/// The width of the screen's sentences.
const WIDTH: usize = 100;

/// A row for each point, in the order of the program, then one for each that is left.
pub(super) fn moves(source: &Source, program: &Program, outcomes: &[Outcome<'_>]) -> String {
    type Row<'r> = (usize, usize, &'r str, Option<&'r Moved>, String);
    let line = |file: usize, at: usize| program.files[file].line_and_column(at).0;
    let moved = outcomes.iter().map(|Outcome { point, moved }| -> Row<'_> {
        let status = moved.as_ref().map_or_else(ToString::to_string, |_| "moved".to_owned());
        let at = line(point.file, point.span.start);
        (point.file, at, point.name.as_str(), moved.as_ref().ok(), status)
    });
    let left = program.left.iter().map(|left: &Left| -> Row<'_> {
        let at = line(left.file, left.span.start);
        (left.file, at, left.name.as_str(), None, format!("left: {}", left.because))
    });
    let mut columns: Columns<'_, Row<'_>> = Columns::default();
    columns.add("file", |row| quoted(Some(&program.files[row.0].name)));
    columns.add("line", |row| row.1.to_string());
    columns.add("point", |row| quoted(Some(row.2)));
    let by = |k: usize, scale: f64| {
        move |row: &Row<'_>| row.3.map_or_else(String::new, |m| format!("{:.6}", m.by[k] * scale))
    };
    columns.add("moved[mm]", by(0, 1e3));
    columns.add("moved[deg]", by(1, 1f64.to_degrees()));
    for (k, (head, reading)) in source.heads().zip(source.readings()).enumerate() {
        columns.add(head, move |row: &Row<'_>| match (row.3, reading) {
            (None, _) => String::new(),
            (Some(moved), Dimension::Angle) => {
                format!("{:.8}", rounded(moved.q[k].to_degrees(), 1e8))
            }
            (Some(moved), _) => format!("{:.6}", rounded(1e3 * moved.q[k], 1e6)),
        });
    }
    columns.add("status", |row| quoted(Some(&row.4)));
    columns.text(Vec::<String>::new(), moved.chain(left))
}

/// The summary: by how much, the largest moves, and what is left.
pub(super) fn screen(source: &Source, program: &Program, outcomes: &[Outcome<'_>]) -> String {
    let files: Vec<&str> = program.files.iter().map(|file| file.name.as_str()).collect();
    let all = outcomes.len() + program.left.len();
    let points = counted(all, "point");
    let head = dim(format!("{}: {points}", files.join(", ")));
    let mut text = format!("{}\n{head}\n\n", bold(&source.robot.name));
    let mut moved: Vec<(&Point, &Moved)> =
        outcomes.iter().filter_map(|o| Some((o.point, o.moved.as_ref().ok()?))).collect();
    text.push_str(&format!("  moved  {} of {all}", moved.len()));
    let largest = |k: usize| moved.iter().map(|(_, m)| m.by[k]).fold(0.0, f64::max);
    if !moved.is_empty() {
        let [far, turned] = [1e3 * largest(0), largest(1).to_degrees()];
        text.push_str(&format!(", by {} mm and {}° at most", short(far), short(turned)));
    }
    text.push('\n');
    let place = |file: usize, at: usize| {
        let line = program.files[file].line_and_column(at).0;
        match program.files.len() {
            1 => format!("line {line}"),
            _ => format!("{}:{line}", program.files[file].name),
        }
    };
    let is_cut = moved.len() > SHOWN;
    if is_cut {
        moved.sort_by(|a, b| b.1.by[0].total_cmp(&a.1.by[0]));
        moved.truncate(SHOWN);
    }
    let row = |(point, moved): &(&Point, &Moved)| {
        let mut row = vec![place(point.file, point.span.start), point.name.clone()];
        row.push(format!("{:.3} mm", 1e3 * moved.by[0]));
        row.push(format!("{:.4}°", moved.by[1].to_degrees()));
        let joints = moved.q.iter().zip(source.readings()).map(|(q, reading)| match reading {
            Dimension::Angle => format!("{:.3}", rounded(q.to_degrees(), 1e3)),
            _ => format!("{:.3}", rounded(1e3 * q, 1e3)),
        });
        row.push(format!("q {}", joints.collect::<Vec<_>>().join(", ")));
        row
    };
    let rows: Vec<Vec<String>> = moved.iter().map(row).collect();
    let aligned = [Align::Left, Align::Left, Align::Right, Align::Right, Align::Left];
    text.push_str(&indented(&table(&rows, &aligned), 4));
    if is_cut {
        text.push_str("    and others that move less\n");
    }
    let missed = outcomes.iter().filter_map(|o| Some((o.point, o.moved.as_ref().err()?)));
    let missed = missed.map(|(p, unmoved)| (p.file, p.span.start, &p.name, unmoved.to_string()));
    let left = program.left.iter().map(|l| (l.file, l.span.start, &l.name, l.because.clone()));
    let (missed, left): (Vec<_>, Vec<_>) = (missed.collect(), left.collect());
    for (head, group) in [("not corrected", missed), ("left as they are", left)] {
        if group.is_empty() {
            continue;
        }
        text.push_str(&format!("  {head}  {}\n", group.len()));
        for (file, at, name, because) in group.iter().take(SHOWN) {
            let line = format!("    {}  {name}: {because}", place(*file, *at));
            text.push_str(&wrapped(&line, WIDTH, 6));
        }
        if group.len() > SHOWN {
            text.push_str(&format!("    and {} more\n", group.len() - SHOWN));
        }
    }
    text
}
