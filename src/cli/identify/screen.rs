//! What was identified, on one screen, in the units that people use.

use stiffarm_gap::Measurements;
use stiffarm_gap::identify::measured::{Answer, Parameter, Spread, Status, Unknown};
use stiffarm_gap::measurement::{DISPLACEMENT_NAMES, Kind, POSE_NAMES};

use super::{slides, stiffness};
use crate::cli::quantity::counted;
use crate::cli::source::Source;
use crate::cli::text::{Align, bar, bold, dim, indented, short, table};

/// Width of the bars.
const BAR: usize = 20;

/// The whole screen.
pub fn text(source: &Source, data: &Measurements, answer: &Answer) -> String {
    let mut text = head(source, data, answer);
    text.push_str(&springs(source, answer));
    text.push_str(&links(answer));
    text.push_str(&gap(answer));
    text.push_str(&advice(answer));
    text
}

fn head(source: &Source, data: &Measurements, answer: &Answer) -> String {
    let names = match data.kind {
        Kind::Pose { .. } => POSE_NAMES,
        Kind::Displacement { .. } => DISPLACEMENT_NAMES,
    };
    let measured = names.iter().zip(data.kind.components()).filter(|(_, is)| *is);
    let measured: Vec<&str> = measured.map(|(name, _)| *name).collect();
    let facts = format!(
        "{}: {} of {} at {}, held out in {}",
        data.file,
        counted(data.rows.len(), "measurement"),
        measured.join(" "),
        counted(data.poses, "pose"),
        counted(answer.gap.folds, "fold")
    );
    format!("{}\n{}\n\n", bold(&source.robot.name), dim(facts))
}

/// Joints and base: stiffnesses.
fn springs(source: &Source, answer: &Answer) -> String {
    let mut rows = vec![
        [bold("Stiffness"), dim("found"), dim("95 %"), dim("robot file"), String::new()].to_vec(),
    ];
    for parameter in &answer.parameters {
        if matches!(parameter.unknown, Unknown::Link(_)) {
            continue;
        }
        let (unit, size) =
            if slides(source, parameter.unknown) { ("N/µm", 1e6) } else { ("N·m/rad", 1.0) };
        let stiff = |c: f64| stiffness(c).map(|k| short(k / size));
        let file = match parameter.unknown {
            Unknown::Base(_) => dim("rigid"),
            _ => stiff(parameter.file).unwrap_or_else(|| dim("rigid")),
        };
        let name = parameter.unknown.to_string();
        if let Status::Held { with, .. } = &parameter.status {
            let why = match with[..] {
                [] => "leaves no trace".to_owned(),
                _ => format!("shows only together with {}", listing(with)),
            };
            rows.push(vec![name, dim("held"), String::new(), file, why]);
            continue;
        }
        let [low, high] = parameter.interval;
        let end = |c: f64| stiff(c).unwrap_or_else(|| "∞".to_owned());
        let found = match (stiff(parameter.value), stiff(high)) {
            (Some(k), _) => format!("{k} {unit}"),
            // Of what does not give way a bound is known.
            (None, Some(least)) => format!("at least {least} {unit}"),
            (None, None) => "compliance below zero".to_owned(),
        };
        let verdict = if matches!(parameter.status, Status::Weak(_)) { "weak" } else { "" };
        rows.push(vec![
            name,
            found,
            format!("[{} to {}]", end(high), end(low)),
            file,
            verdict.to_owned(),
        ]);
    }
    under_heading(&rows, &[Align::Left; 5])
}

/// `joint 1, joint 2`.
fn listing(unknowns: &[Unknown]) -> String {
    unknowns.iter().map(Unknown::to_string).collect::<Vec<_>>().join(", ")
}

fn links(answer: &Answer) -> String {
    let of_links = |p: &&Parameter| matches!(p.unknown, Unknown::Link(_));
    let mut rows = vec![vec![bold("Flexibility"), dim("× the file's"), dim("95 %")]];
    for parameter in answer.parameters.iter().filter(of_links) {
        let [low, high] = parameter.interval;
        rows.push(match &parameter.status {
            Status::Held { with, .. } => {
                let why = match with[..] {
                    [] => "leaves no trace".to_owned(),
                    _ => format!("shows only together with {}", listing(with)),
                };
                vec![parameter.unknown.to_string(), dim("held"), why]
            }
            _ => vec![
                parameter.unknown.to_string(),
                short(parameter.value),
                format!("[{} to {}]", short(low), short(high)),
            ],
        });
    }
    if rows.len() == 1 {
        return String::new();
    }
    format!("\n{}", under_heading(&rows, &[Align::Left; 3]))
}

fn gap(answer: &Answer) -> String {
    let (gap, noise) = (&answer.gap, &answer.noise);
    let mut heads = vec![bold("Gap")];
    if noise.position.is_some() {
        heads.extend(["rms mm", "max mm"].map(dim));
    }
    if noise.rotation.is_some() {
        heads.push(dim("rms mrad"));
    }
    let main = |s: &Spread| match noise.position {
        Some(_) => s.position_rms,
        None => s.rotation_rms,
    };
    let line = |name: &str, s: &Spread| {
        let mut cells = vec![name.to_owned()];
        if noise.position.is_some() {
            cells.extend([s.position_rms, s.position_max].map(|x| short(1e3 * x)));
        }
        if noise.rotation.is_some() {
            cells.push(short(1e3 * s.rotation_rms));
        }
        let whole = main(&gap.before);
        cells.push(bar(if whole > 0.0 { main(s) / whole } else { 0.0 }, BAR));
        cells
    };
    let mut last = vec![
        if noise.given { "noise of a component, as given" } else { "noise of a component, left" }
            .to_owned(),
    ];
    if let Some(sd) = noise.position {
        last.extend([short(1e3 * sd), String::new()]);
    }
    if let Some(sd) = noise.rotation {
        last.push(short(1e3 * sd));
    }
    let rows = [
        heads,
        line("as the robot file is", &gap.before),
        line("with what was found, held out", &gap.held_out),
        last,
    ];
    let align = [Align::Left, Align::Right, Align::Right, Align::Right];
    let columns = rows[1].len() - 1;
    let mut align = align[..columns].to_vec();
    align.push(Align::Left);
    format!("\n{}", under_heading(&rows, &align))
}

/// What would show what is hidden or weak.
fn advice(answer: &Answer) -> String {
    let mut lines = Vec::new();
    for parameter in &answer.parameters {
        let Unknown::Joint(_) = parameter.unknown else { continue };
        let (what, pull) = match &parameter.status {
            Status::Determined => continue,
            Status::Weak(pull) => ("to know it better", pull),
            Status::Held { pull, .. } => ("to show it", pull),
        };
        lines.push(match pull {
            Some(pull) => format!("{}: {what}, {pull}", parameter.unknown),
            None => format!(
                "{}: no load shows it in what is measured: measure rotations, or a point off its \
                 axis",
                parameter.unknown
            ),
        });
    }
    if lines.is_empty() { String::new() } else { format!("\n{}\n", lines.join("\n")) }
}

/// The heading stands out to the left of the lines below it.
fn under_heading(rows: &[Vec<String>], align: &[Align]) -> String {
    let lines = table(rows, align);
    let (head, rest) = lines.split_once('\n').unwrap_or((&lines, ""));
    format!("{}\n{}", head.replacen("  ", "    ", 1), indented(rest, 2))
}
