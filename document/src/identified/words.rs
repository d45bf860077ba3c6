//! What was identified, in words.

use stiffarm_gap::identify::measured::{Answer, Parameter, Status, Unknown};
use stiffarm_kernels::generic::Arm;

use super::{is_translation, stiffness};
use crate::Unit;
use crate::text::short;
use crate::words::joined;

/// Springs that the sentence names.
const NAMED: usize = 3;

/// A spring as it is reported.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Said {
    /// `joint 2`.
    pub place: String,
    /// With its unit, or that it is held.
    pub found: String,
    /// 95 %; empty if it is held.
    pub interval: String,
    /// What the robot file has.
    pub file: String,
    /// Why it is held, or that it is weak.
    pub verdict: String,
}

/// Every parameter that was asked for, in the order of the answer.
pub fn said(arm: &Arm, answer: &Answer) -> Vec<Said> {
    answer.parameters.iter().map(|parameter| one(arm, parameter)).collect()
}

fn one(arm: &Arm, parameter: &Parameter) -> Said {
    let place = parameter.unknown.to_string();
    let is_link = matches!(parameter.unknown, Unknown::Link(_));
    let (unit, size) =
        if is_translation(arm, parameter.unknown) { ("N/µm", 1e6) } else { ("N·m/rad", 1.0) };
    let stiff = |c: f64| stiffness(c).map(|k| short(k / size));
    let file = match parameter.unknown {
        Unknown::Base(_) => "rigid".to_owned(),
        Unknown::Link(_) => "1".to_owned(),
        Unknown::Joint(_) => stiff(parameter.file).unwrap_or_else(|| "rigid".to_owned()),
    };
    if let Status::Held { with, .. } = &parameter.status {
        let verdict = match with[..] {
            [] => "has no effect on the rows".to_owned(),
            _ => format!("not distinguishable from {}", listing(with)),
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
            // Of what is not compliant a bound is known.
            (None, Some(least)) => format!("at least {least} {unit}"),
            (None, None) => "compliance below zero".to_owned(),
        };
        (found, format!("[{} to {}]", end(high), end(low)))
    };
    let weak = matches!(parameter.status, Status::Weak(_));
    Said {
        place,
        found,
        interval,
        file,
        verdict: if weak { "poorly determined" } else { "" }.to_owned(),
    }
}

/// `joint 1 and joint 2`.
fn listing(unknowns: &[Unknown]) -> String {
    joined(&unknowns.iter().map(Unknown::to_string).collect::<Vec<_>>(), " and ")
}

/// What would show what is hidden or weak.
pub fn advice(answer: &Answer) -> Vec<String> {
    let mut lines = Vec::new();
    for parameter in &answer.parameters {
        let Unknown::Joint(_) = parameter.unknown else { continue };
        let (what, pull) = match &parameter.status {
            Status::Determined => continue,
            Status::Weak(pull) => ("to determine it better", pull),
            Status::Held { pull, .. } => ("to determine it", pull),
        };
        lines.push(match pull {
            Some(pull) => format!("{}: {what}, {pull}", parameter.unknown),
            None => format!(
                "{}: no load determines it from what is measured; measure rotations, or a point off its \
                 axis",
                parameter.unknown
            ),
        });
    }
    lines
}

/// The springs that differ from the file's, and how far the error is reduced with them.
pub fn sentence(arm: &Arm, answer: &Answer, unit: Unit<'_>, error: &str) -> String {
    let mut changed: Vec<&Parameter> =
        answer.parameters.iter().filter(|p| p.usable() && p.differs).collect();
    let surprise = |p: &Parameter| {
        let deviation = p.spread.map_or(f64::MAX, |s| s.deviation.max(f64::MIN_POSITIVE));
        ((p.value - p.file) / deviation).abs()
    };
    changed.sort_by(|a, b| surprise(b).total_cmp(&surprise(a)));
    let size = |s: &stiffarm_gap::gap::Statistics| {
        if error.starts_with("position") { s.position_rms } else { s.rotation_rms }
    };
    let (before, after) = (size(&answer.gap.before), size(&answer.gap.held_out));
    if changed.is_empty() {
        return format!(
            "No spring differs significantly from the robot file; the {error} is {} rms.",
            unit.with_unit(before)
        );
    }
    let mut named: Vec<String> = changed.iter().take(NAMED).map(|p| difference(arm, p)).collect();
    named[0].push_str(match changed[0].file {
        0.0 => " where the robot file has none",
        _ => " as in the robot file",
    });
    match changed.len().saturating_sub(NAMED) {
        0 => {}
        1 => named.push("1 more differs".to_owned()),
        rest => named.push(format!("{rest} more differ")),
    }
    let list = joined(&named, ", and ").replacen("joint", "Joint", 1);
    let sizes = unit.change(before, after);
    if after >= before {
        return format!(
            "{list}; but this does not reduce the {error} on held-out poses: {sizes} rms."
        );
    }
    let part = 100.0 * (1.0 - after / before);
    format!(
        "{list}; the identified springs remove {part:.0} % of the {error} on held-out poses, {sizes} rms."
    )
}

/// `joint 2 is 1.83 times as compliant`.
fn difference(arm: &Arm, p: &Parameter) -> String {
    let place = p.unknown.to_string();
    let ratio = p.value / p.file;
    match p.file {
        0.0 => format!("{place} has a spring of {}", one(arm, p).found),
        _ if ratio > 1.0 => format!("{place} is {} times as compliant", short(ratio)),
        _ => format!("{place} is {} times as stiff", short(1.0 / ratio)),
    }
}
