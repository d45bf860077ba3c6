//! The gap from before to the noise, step by step.

use stiffarm_gap::diagnose::Finding;

use super::Report;
use crate::plot::{number, ticks};

/// Width of the picture, px.
const WIDTH: f64 = 880.0;
/// Bars stand between these, px.
const LEFT: f64 = 250.0;
const RIGHT: f64 = 600.0;
/// Height of a step, px.
const STEP: f64 = 38.0;
const TOP: f64 = 12.0;

/// A step.
pub struct Bar {
    /// What it is.
    pub label: String,
    /// `whole`, `removed`, `left` or `noise`.
    pub class: &'static str,
    /// Left edge and width, px.
    pub x: String,
    pub width: String,
    /// Top of the bar, its middle, the baseline of its text, px.
    pub y: String,
    pub middle: String,
    pub baseline: String,
    /// Ends of the interval of what is left, px.
    pub interval: Option<[String; 2]>,
    /// Its size.
    pub text: String,
}

/// A mark of the axis.
pub struct Mark {
    /// px.
    pub x: String,
    pub text: String,
}

/// The picture.
pub struct Waterfall {
    pub bars: Vec<Bar>,
    pub marks: Vec<Mark>,
    pub unit: &'static str,
    /// px.
    pub width: f64,
    pub height: f64,
    /// Left edge and right end of the area, its bottom, the baseline below it, px.
    pub left: f64,
    pub right: f64,
    pub bottom: f64,
    pub below: f64,
    /// The same in words.
    pub description: String,
}

/// What stands at a step before it is drawn, SI.
struct Step {
    label: String,
    class: &'static str,
    from: f64,
    to: f64,
    interval: Option<[f64; 2]>,
    text: String,
}

/// The waterfall of a report.
pub fn waterfall(report: &Report<'_>) -> Waterfall {
    let steps = steps(report);
    let unit = report.main_unit();
    let largest = steps.iter().map(|s| s.to.max(s.interval.map_or(0.0, |i| i[1])));
    let largest = largest.fold(0.0, f64::max);
    let largest = if largest > 0.0 { largest } else { unit.si };
    let at = |si: f64| LEFT + (RIGHT - LEFT) * (si / largest).clamp(0.0, 1.0);
    let bottom = TOP + STEP * steps.len() as f64;
    let marks = ticks([0.0, largest / unit.si], 5).into_iter();
    let marks = marks.map(|t| Mark { x: px(at(t * unit.si)), text: number(t) }).collect();
    let sentence = |s: &Step| format!("{}: {}", s.label, s.text);
    let description = steps.iter().map(sentence).collect::<Vec<_>>().join("; ");
    let bar = |(k, step): (usize, Step)| {
        let y = TOP + STEP * k as f64;
        Bar {
            x: px(at(step.from)),
            // What is there at all is to be seen.
            width: px((at(step.to) - at(step.from)).max(1.5)),
            y: px(y + 6.0),
            middle: px(y + STEP / 2.0),
            baseline: px(y + STEP / 2.0 + 4.5),
            interval: step.interval.map(|i| i.map(|end| px(at(end)))),
            label: step.label,
            class: step.class,
            text: step.text,
        }
    };
    Waterfall {
        bars: steps.into_iter().enumerate().map(bar).collect(),
        marks,
        unit: unit.name,
        width: WIDTH,
        height: bottom + 46.0,
        left: LEFT,
        right: RIGHT,
        bottom,
        below: bottom + 18.0,
        description,
    }
}

fn steps(report: &Report<'_>) -> Vec<Step> {
    let gap = &report.found.gap;
    let main = |position: f64, rotation: f64| {
        if report.has_positions() { position } else { rotation }
    };
    let before = main(gap.before.position_rms, gap.before.rotation_rms);
    let after = main(gap.after.position_rms, gap.after.rotation_rms);
    let noise = main(gap.noise.position_rms, gap.noise.rotation_rms);
    let unit = report.main_unit();
    let plain = |label: &str, class, size: f64| Step {
        label: label.to_owned(),
        class,
        from: 0.0,
        to: size,
        interval: None,
        text: unit.with_unit(size),
    };
    let first = match report.found.nuisances.is_empty() {
        true => "as the robot file is",
        false => "with the unknown frames fitted",
    };
    let mut steps = vec![plain(first, "whole", before)];
    steps.extend(report.found.findings.iter().map(|finding| taken(report, finding)));
    if !report.found.findings.is_empty() {
        steps.push(plain("left, held out", "left", after));
    }
    let from = match gap.noise.from {
        "residual" => "noise, from what is left",
        "repeats" => "noise, from repeats",
        _ => "noise, as given",
    };
    steps.push(plain(from, "noise", noise));
    steps
}

/// What a finding takes away, with the interval of what it leaves.
fn taken(report: &Report<'_>, finding: &Finding) -> Step {
    let held = &finding.held_out;
    let [low, high] = held.shrink_ci95;
    let percent = |x: f64| format!("{:.0}", 100.0 * x).replacen('-', "−", 1);
    let unit = report.main_unit();
    Step {
        label: format!("{} at {}", finding.effect.replace('_', " "), finding.place),
        class: "removed",
        from: held.after.min(held.before),
        to: held.after.max(held.before),
        interval: Some([held.before * (1.0 - high), held.before * (1.0 - low)]),
        text: format!(
            "→ {}, {} % less [{} to {}]",
            unit.with_unit(held.after),
            percent(held.shrink),
            percent(low),
            percent(high)
        ),
    }
}

/// To a tenth of a pixel.
fn px(x: f64) -> String {
    format!("{x:.1}")
}
