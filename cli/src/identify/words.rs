//! What was identified, as it is said: for the screen and for the page.

use stiffarm_gap::identify::measured::{Answer, Parameter, Status, Unknown};

use super::{is_translation, stiffness};
use crate::input::source::Source;
use crate::report::Unit;
use crate::report::identified::Said;
use crate::terminal::text::short;

/// Springs that the sentence names.
const NAMED: usize = 3;

/// Every number that was looked for, in the order of the answer.
pub fn said(source: &Source, answer: &Answer) -> Vec<Said> {
    answer.parameters.iter().map(|parameter| one(source, parameter)).collect()
}

fn one(source: &Source, parameter: &Parameter) -> Said {
    let place = parameter.unknown.to_string();
    let is_link = matches!(parameter.unknown, Unknown::Link(_));
    let (unit, size) =
        if is_translation(source, parameter.unknown) { ("N/µm", 1e6) } else { ("N·m/rad", 1.0) };
    let stiff = |c: f64| stiffness(c).map(|k| short(k / size));
    let file = match parameter.unknown {
        Unknown::Base(_) => "rigid".to_owned(),
        Unknown::Link(_) => "1".to_owned(),
        Unknown::Joint(_) => stiff(parameter.file).unwrap_or_else(|| "rigid".to_owned()),
    };
    if let Status::Held { with, .. } = &parameter.status {
        let verdict = match with[..] {
            [] => "leaves no trace".to_owned(),
            _ => format!("shows only together with {}", listing(with)),
        };
        return Said { place, found: "held".to_owned(), interval: String::new(), file, verdict };
    }
    let [low, high] = parameter.interval().unwrap_or([parameter.value; 2]);
    let (found, interval) = if is_link {
        (short(parameter.value), format!("[{} to {}]", short(low), short(high)))
    } else {
        let end = |c: f64| stiff(c).unwrap_or_else(|| "∞".to_owned());
        let found = match (stiff(parameter.value), stiff(high)) {
            (Some(k), _) => format!("{k} {unit}"),
            // Of what does not give way a bound is known.
            (None, Some(least)) => format!("at least {least} {unit}"),
            (None, None) => "compliance below zero".to_owned(),
        };
        (found, format!("[{} to {}]", end(high), end(low)))
    };
    let weak = matches!(parameter.status, Status::Weak(_));
    Said { place, found, interval, file, verdict: if weak { "weak" } else { "" }.to_owned() }
}

/// `joint 1, joint 2`.
fn listing(unknowns: &[Unknown]) -> String {
    unknowns.iter().map(Unknown::to_string).collect::<Vec<_>>().join(", ")
}

/// What would show what is hidden or weak.
pub fn advice(answer: &Answer) -> Vec<String> {
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
    lines
}

/// The springs that are not the file's, and what putting them in does to the gap.
pub fn sentence(source: &Source, answer: &Answer, unit: &Unit, positions: bool) -> String {
    let mut changed: Vec<&Parameter> =
        answer.parameters.iter().filter(|p| p.usable() && p.differs()).collect();
    let surprise = |p: &Parameter| {
        let deviation = p.spread.map_or(f64::MAX, |s| s.deviation.max(f64::MIN_POSITIVE));
        ((p.value - p.file) / deviation).abs()
    };
    changed.sort_by(|a, b| surprise(b).total_cmp(&surprise(a)));
    let gap = &answer.gap;
    let size = |s: &stiffarm_gap::gap::Statistics| {
        if positions { s.position_rms } else { s.rotation_rms }
    };
    let (before, after) = (size(&gap.before), size(&gap.held_out));
    let sizes = format!("{} → {}", unit.number(before), unit.with_unit(after));
    if changed.is_empty() {
        return format!(
            "No spring differs from the robot file by more than this data leaves open; the gap is \
             {}.",
            unit.with_unit(before)
        );
    }
    let rest = changed.len().saturating_sub(NAMED);
    let mut named: Vec<String> =
        changed.iter().take(NAMED).map(|p| difference(source, p)).collect();
    named[0].push_str(match changed[0].file {
        0.0 => " where the robot file has none",
        _ => " as the robot file says",
    });
    match rest {
        0 => {}
        1 => named.push("1 more differs".to_owned()),
        _ => named.push(format!("{rest} more differ")),
    }
    let list = match named.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, before)) => format!("{}, and {last}", before.join(", ")),
        None => String::new(),
    };
    let list = list.replacen("joint", "Joint", 1);
    if after >= before {
        return format!("{list}; but on poses that no fit has seen this does not help: {sizes}.");
    }
    let part = 100.0 * (1.0 - after / before);
    format!(
        "{list}; with the springs found, {part:.0} % of the gap goes on poses that no fit has seen, \
         {sizes}."
    )
}

/// `joint 2 1.83 times as soft`.
fn difference(source: &Source, p: &Parameter) -> String {
    let place = p.unknown.to_string();
    let ratio = p.value / p.file;
    let soft = if matches!(p.unknown, Unknown::Link(_)) { "flexible" } else { "soft" };
    match p.file {
        0.0 => format!("{place} has a spring of {}", one(source, p).found),
        _ if ratio > 1.0 => format!("{place} is {} times as {soft}", short(ratio)),
        _ => format!("{place} is {} times as stiff", short(1.0 / ratio)),
    }
}
