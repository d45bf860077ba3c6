//! Numbers with their intervals, one below the other, against what was believed.

use askama::Template;

use super::px;
use crate::plot::number;

/// Width of the picture, px.
const WIDTH: f64 = 880.0;
/// The axis lies between these, px.
const LEFT: f64 = 160.0;
const RIGHT: f64 = 600.0;
/// Height of a line, px.
const STEP: f64 = 34.0;
const TOP: f64 = 10.0;

/// Beyond so many times, an end lies outside of the picture.
const MOST: f64 = 16.0;

/// A number as a multiple of what was believed.
pub struct Multiple {
    /// What it is.
    pub label: String,
    /// How many times what was believed.
    pub value: f64,
    /// Its interval; an end may be infinite.
    pub interval: [f64; 2],
    /// As it is said.
    pub text: String,
}

/// A line of the picture, px.
pub struct Line {
    pub label: String,
    pub at: String,
    pub ends: [String; 2],
    pub middle: String,
    pub baseline: String,
    pub text: String,
}

/// A mark of the axis, px.
pub struct Mark {
    pub x: String,
    pub text: String,
    /// Whether it is 1.
    pub same: bool,
}

/// The picture; its axis is logarithmic.
#[derive(Template)]
#[template(path = "parts/forest.html")]
pub struct Forest {
    pub lines: Vec<Line>,
    pub marks: Vec<Mark>,
    pub width: f64,
    pub height: f64,
    pub label: f64,
    pub right: f64,
    pub bottom: f64,
    pub below: f64,
    pub middle: f64,
    /// The same in words.
    pub description: String,
}

/// The picture of some multiples, each positive.
pub fn forest(multiples: &[Multiple]) -> Forest {
    let ends = multiples.iter().flat_map(|m| [m.value, m.interval[0], m.interval[1]]);
    let within = |x: f64| x.clamp(1.0 / MOST, MOST);
    let (low, high) =
        ends.map(within).fold((0.5, 2.0), |(low, high): (f64, f64), x| (low.min(x), high.max(x)));
    let (first, last) = (low.log2().floor(), high.log2().ceil());
    let at = |x: f64| {
        let part = (within(x).log2() - first) / (last - first);
        px(LEFT + (RIGHT - LEFT) * part)
    };
    let bottom = TOP + STEP * multiples.len() as f64;
    let marks = (first as i32..=last as i32).map(|k| Mark {
        x: at(f64::from(k).exp2()),
        text: number(f64::from(k).exp2()),
        same: k == 0,
    });
    let line = |(k, m): (usize, &Multiple)| {
        let middle = TOP + STEP * (k as f64 + 0.5);
        Line {
            label: m.label.clone(),
            at: at(m.value),
            ends: m.interval.map(at),
            middle: px(middle),
            baseline: px(middle + 4.5),
            text: m.text.clone(),
        }
    };
    Forest {
        lines: multiples.iter().enumerate().map(line).collect(),
        marks: marks.collect(),
        width: WIDTH,
        height: bottom + 46.0,
        label: LEFT - 12.0,
        right: RIGHT + 8.0,
        bottom,
        below: bottom + 18.0,
        middle: (LEFT + RIGHT) / 2.0,
        description: multiples
            .iter()
            .map(|m| format!("{}: {}", m.label, m.text))
            .collect::<Vec<_>>()
            .join("; "),
    }
}
