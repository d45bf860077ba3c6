//! The plan as a measurement file.

use nalgebra::Vector6;
use stiffarm_codegen::robot::Frame;
use stiffarm_gap::dexterity::design::{Design, Plan, Planned};
use stiffarm_gap::measurement::{DISPLACEMENT_NAMES, Dimension, POSE_NAMES, WRENCH_NAMES};
use stiffarm_gap::observe::{Aim, Seen};

use crate::input::source::Source;
use crate::terminal::text::quoted;

/// The measurement file, its measured columns empty.
pub fn file(source: &Source, plan: &Plan, found: &Design) -> String {
    let revolute: Vec<bool> = source.readings().iter().map(|d| *d == Dimension::Angle).collect();
    let mut heads = vec!["pose".to_owned()];
    heads.extend(source.heads());
    let loaded: Vec<usize> =
        (0..6).filter(|&k| plan.loads.iter().any(|load| load[k] != 0.0)).collect();
    heads.extend(
        loaded.iter().map(|&k| format!("{}[{}]", WRENCH_NAMES[k], if k < 3 { "N" } else { "Nm" })),
    );
    let directed = found.tests.iter().any(|test| test.direction.is_some());
    if directed {
        heads.extend((1..=revolute.len()).map(|j| format!("s{j}")));
    }
    let aims: Vec<&Aim> = plan.bench.iter().collect();
    let seen = [Seen::Point, Seen::Plane];
    let things: Vec<Seen> =
        seen.into_iter().filter(|seen| aims.iter().any(|aim| aim.seen == *seen)).collect();
    heads.extend(things.iter().map(|seen| seen.thing().to_owned()));
    let names = if found.displacements { DISPLACEMENT_NAMES } else { POSE_NAMES };
    let measured = match (aims.is_empty(), plan.noise_rotation) {
        (false, _) => 0,
        (true, None) => 3,
        (true, Some(_)) => 6,
    };
    heads.extend((0..measured).map(|k| {
        let unit = match (k < 3, found.displacements) {
            (true, _) => "mm",
            (false, true) => "mrad",
            (false, false) => "deg",
        };
        format!("{}[{unit}]", names[k])
    }));
    let (frame, axes) = match source.robot.base == Frame::default() {
        true => ("base frame", "base axes"),
        false => ("frame in which [base] stands", "that frame's axes; loads in base axes"),
    };
    let what = match found.displacements {
        true => "loaded minus unloaded, of the tool origin".to_owned(),
        false => format!("of the tool in the {frame}, before and under the load"),
    };
    let sides = match directed {
        true => "# s1 … say from which side each joint comes to rest: 1 with rising readings.\n",
        false => "",
    };
    let task = match measured {
        0 => {
            "bring the tool there, before and under the load, and put in what the joints then read"
                .to_owned()
        }
        _ => format!("fill in {} to {}, {what}, {axes}", names[0], names[measured - 1]),
    };
    let robot = source.robot.name.replace(char::is_control, " ");
    let mut text = format!("# {robot}: {task}.\n{sides}{}\n", heads.join(","));
    for (k, test) in found.tests.iter().enumerate() {
        let zero = Vector6::zeros();
        let wrenches: &[&Vector6<f64>] = match found.displacements {
            true => &[&test.wrench],
            false => &[&zero, &test.wrench],
        };
        for load in wrenches {
            let mut cells = vec![format!("{}", k + 1)];
            cells.extend(readings(test, &revolute));
            cells.extend(loaded.iter().map(|&k| plain(load[k], 6)));
            cells.extend(test.direction.iter().flatten().map(i8::to_string));
            let thing = test.thing.map(|thing| aims[thing]);
            let name =
                |seen: &Seen| thing.filter(|aim| aim.seen == *seen).map(|aim| quoted(&aim.name));
            cells.extend(things.iter().map(|seen| name(seen).unwrap_or_default()));
            cells.extend((0..measured).map(|_| String::new()));
            text.push_str(&cells.join(","));
            text.push('\n');
        }
    }
    text
}

/// To a thousandth of a degree or millimetre: finer than a controller is told.
fn readings(test: &Planned, revolute: &[bool]) -> Vec<String> {
    let shown = |(q, turns): (&f64, &bool)| plain(if *turns { q.to_degrees() } else { 1e3 * q }, 3);
    test.q.iter().zip(revolute).map(shown).collect()
}

/// With so many digits behind the point at most.
fn plain(x: f64, digits: usize) -> String {
    let text = format!("{x:.digits$}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}
