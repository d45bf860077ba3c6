//! The plan as a measurement file.

use nalgebra::Vector6;
use stiffarm_codegen::robot::Frame;
use stiffarm_gap::instrument::{Look, Seen};
use stiffarm_gap::io::{Columns, digits, quoted};
use stiffarm_gap::measurement::{
    DISPLACEMENT_NAMES, Dimension, PIXEL_NAMES, POSE_NAMES, WRENCH_NAMES,
};
use stiffarm_study::dexterity::design::{Design, Plan, Planned, Station};

use crate::input::source::Source;

/// The measurement file, its measured columns empty.
pub fn file(source: &Source, plan: &Plan, found: &Design) -> String {
    let mut columns: Columns<'_, Line<'_>> = Columns::default();
    columns.add("pose", |line| (line.number + 1).to_string());
    for (j, (head, reading)) in source.heads().zip(source.readings()).enumerate() {
        // To a thousandth of a degree or millimetre: finer than a controller is told.
        columns.add(head, move |line| match reading {
            Dimension::Angle => digits(line.test.q[j].to_degrees(), 3),
            _ => digits(1e3 * line.test.q[j], 3),
        });
    }
    for k in (0..6).filter(|&k| plan.loads.iter().any(|load| load[k] != 0.0)) {
        let unit = if k < 3 { "N" } else { "Nm" };
        columns.add(format!("{}[{unit}]", WRENCH_NAMES[k]), move |line| digits(line.load[k], 6));
    }
    let directed = found.tests.iter().any(|test| test.direction.is_some());
    for j in (0..source.robot.joints.len()).filter(|_| directed) {
        let side = move |line: &Line<'_>| line.test.direction.as_ref().map(|side| side[j]);
        columns.add(format!("s{}", j + 1), move |line| {
            side(line).map_or_else(String::new, |side| side.to_string())
        });
    }
    let bench = &plan.bench;
    for seen in [Seen::Point, Seen::Plane] {
        let name = move |target: &Station| match target {
            Station::Thing(aim) if aim.seen == seen => Some(aim.name.clone()),
            _ => None,
        };
        if bench.iter().any(|target| name(target).is_some()) {
            let of = move |line: &Line<'_>| line.test.thing.and_then(|thing| name(&bench[thing]));
            columns.add(seen.thing(), move |line| quoted(of(line).as_deref()));
        }
    }
    let has_boards = bench.iter().any(|target| matches!(target, Station::Board(_)));
    if has_boards {
        columns.add("camera", |line| quoted(line.corner.map(|(look, _)| &*look.camera)));
        columns.add("board", |line| quoted(line.corner.map(|(look, _)| &*look.board)));
        columns.add("marker", |line| quoted(line.corner.map(|(_, name)| name)));
        for name in PIXEL_NAMES {
            columns.add(format!("{name}[px]"), |_| String::new());
        }
    }
    let names = if found.displacements { DISPLACEMENT_NAMES } else { POSE_NAMES };
    let measured = match (bench.is_empty(), plan.noise_rotation) {
        (false, _) => 0,
        (true, None) => 3,
        (true, Some(_)) => 6,
    };
    for (k, name) in names.into_iter().enumerate().take(measured) {
        let unit = match (k < 3, found.displacements) {
            (true, _) => "mm",
            (false, true) => "mrad",
            (false, false) => "deg",
        };
        columns.add(format!("{name}[{unit}]"), |_| String::new());
    }
    let (frame, axes) = match source.robot.base == Frame::default() {
        true => ("base frame", "base axes"),
        false => ("frame in which [base] stands", "that frame's axes; loads in base axes"),
    };
    let what = match found.displacements {
        true => "loaded minus unloaded, of the tool origin".to_owned(),
        false => format!("of the tool in the {frame}, before and under the load"),
    };
    let task = match measured {
        0 if has_boards => {
            "take a picture there, before and under the load, fill in where it shows each corner, leave out those \
             that it does not show, and put in what the joints then read"
                .to_owned()
        }
        0 => {
            "bring the tool there, before and under the load, and put in what the joints then read"
                .to_owned()
        }
        _ => format!("fill in {} to {}, {what}, {axes}", names[0], names[measured - 1]),
    };
    let robot = source.robot.name.replace(char::is_control, " ");
    let sides = "s1 … say from which side each joint comes to rest: 1 with rising readings.";
    let sides = directed.then(|| sides.to_owned());
    let lines = found.tests.iter().enumerate().flat_map(|(number, test)| {
        let unloaded = (!found.displacements).then(Vector6::zeros);
        let loads = unloaded.into_iter().chain([test.wrench]);
        let board = test.thing.and_then(|thing| match &bench[thing] {
            Station::Board(look) => Some(look),
            Station::Thing(_) => None,
        });
        loads.flat_map(move |load| {
            let rows: Vec<Option<(&Look, &str)>> = match board {
                Some(look) => look.corners.iter().map(|(name, _)| Some((look, &**name))).collect(),
                None => vec![None],
            };
            rows.into_iter().map(move |corner| Line { number, test, load, corner })
        })
    });
    columns.text([format!("{robot}: {task}.")].into_iter().chain(sides), lines)
}

/// A line of the file.
struct Line<'a> {
    /// Of the pose, from 0.
    number: usize,
    test: &'a Planned,
    load: Vector6<f64>,
    /// Of a board that a picture shows.
    corner: Option<(&'a Look, &'a str)>,
}
