//! The gap from before to the noise, step by step.

use askama::Template;

use super::px;
use crate::Unit;
use crate::plot::{number, ticks};

/// Width of the picture, px.
const WIDTH: f64 = 880.0;
/// Bars stand between these, px.
const LEFT: f64 = 280.0;
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
#[derive(Template)]
#[template(path = "parts/waterfall.html")]
pub struct Waterfall {
    pub bars: Vec<Bar>,
    pub marks: Vec<Mark>,
    pub unit: String,
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
pub struct Step {
    /// What is added.
    pub label: String,
    /// `whole`, `removed`, `left` or `noise`.
    pub class: &'static str,
    /// Where its bar begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// 95 % interval of where it ends.
    pub interval: Option<[f64; 2]>,
    /// What stands beside the bar.
    pub text: String,
}

impl Step {
    /// From nothing to a size.
    pub fn of(label: impl Into<String>, class: &'static str, to: f64, text: String) -> Step {
        Step { label: label.into(), class, from: 0.0, to, interval: None, text }
    }
}

/// Steps as a picture.
pub fn waterfall(steps: Vec<Step>, unit: Unit<'_>) -> Waterfall {
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
        unit: unit.name.to_owned(),
        width: WIDTH,
        height: bottom + 46.0,
        left: LEFT,
        right: RIGHT,
        bottom,
        below: bottom + 18.0,
        description,
    }
}
