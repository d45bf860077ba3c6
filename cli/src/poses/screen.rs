//! The plan as it is said: what the tests will tell.

use stiffarm_document::Unit;
use stiffarm_document::text::{Align, bold, counted, dim, indented, short, table};
use stiffarm_gap::measurement::Dimension;
use stiffarm_kernels::generic::Arm;
use stiffarm_study::dexterity::design::{DEVIATIONS, Design, Expected, Plan, Planned, Purpose};

use crate::input::source::Source;

/// At most a screen.
pub fn screen(source: &Source, arm: &Arm, plan: &Plan, found: &Design) -> String {
    let least = |value: fn(&Planned) -> f64| found.tests.iter().map(value).fold(1.0, f64::min);
    let most = found.tests.iter().map(|t| t.nu_p).fold(0.0, f64::max);
    let mut text = format!(
        "{}\n{}\n\n",
        bold(&source.robot.name),
        dim(format!(
            "{}; 1/κ of {} or more with L = {} m, K_C adds {} % or less",
            counted(found.tests.len(), "posture"),
            short(least(|t| t.inverse_condition)),
            short(found.length),
            short(100.0 * most),
        ))
    );
    match plan.purpose {
        Purpose::Separate(_) => text.push_str(&apart(found)),
        _ => text.push_str(&springs(source, arm, plan, found)),
    }
    text.push_str(&format!(
        "\nas good as {} times as many random tests of the same kind\n",
        short(found.efficiency)
    ));
    text
}

fn springs(source: &Source, arm: &Arm, plan: &Plan, found: &Design) -> String {
    let mut heads = vec![bold("Expected"), dim("compliance ±"), dim("of the file's")];
    if plan.purpose == Purpose::Diagnose {
        heads.push(dim("zero ±"));
    }
    let mut rows = vec![heads];
    let readings = source.readings();
    for (expected, joint) in found.expected.iter().zip(&arm.joints) {
        rows.push(line(expected, joint.compliance, readings.get(expected.joint - 1), plan));
    }
    headed(&rows)
}

/// A table whose first row is its heading.
fn headed(rows: &[Vec<String>]) -> String {
    let lines = table(rows, &[Align::Left; 4]);
    let (head, rest) = lines.split_once('\n').unwrap_or((&lines, ""));
    format!("{}\n{}", head.replacen("  ", "    ", 1), indented(rest, 2))
}

/// From which size on each of two effects is told from the other.
fn apart(found: &Design) -> String {
    let heads = ["from a displacement of", "or from"].map(dim);
    let mut rows = vec![[vec![bold("Told from the other")], heads.to_vec()].concat()];
    for told in &found.told {
        let moved = told.smallest.map(|m| Unit::of("m", m).with_unit(m));
        let moved = moved.unwrap_or_else(|| "not in all its forms".to_owned());
        let mut before = vec![told.effect.clone(), moved];
        for (number, deviation) in &told.numbers {
            let size = deviation.map(|sd| {
                let least = DEVIATIONS * sd;
                format!("{} of {}", number.name, Unit::of(number.unit, least).with_unit(least))
            });
            before.push(size.unwrap_or_else(|| format!("{}: the same", number.name)));
            rows.push(std::mem::replace(&mut before, vec![String::new(); 2]));
        }
    }
    headed(&rows)
}

fn line(expected: &Expected, file: f64, reading: Option<&Dimension>, plan: &Plan) -> Vec<String> {
    let slides = reading == Some(&Dimension::Length);
    let unit = if slides { "µm/N" } else { "µrad/(N·m)" };
    let mut cells = vec![format!("joint {}", expected.joint)];
    match expected.compliance {
        Some(sd) => {
            cells.push(format!("{} {unit}", short(1e6 * sd)));
            let part = || format!("{} %", short(100.0 * sd / file));
            cells.push(if file > 0.0 { part() } else { dim("rigid") });
        }
        None => cells.extend(["no load shows it".to_owned(), dim("–")]),
    }
    if plan.purpose == Purpose::Diagnose {
        let unit = if slides { "µm" } else { "µrad" };
        let shown = |sd: f64| format!("{} {unit}", short(1e6 * sd));
        cells.push(expected.zero.map_or_else(|| "nothing shows it".to_owned(), shown));
    }
    cells
}
