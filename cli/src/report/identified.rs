//! The page of an identification: what the springs are, and what that does to the gap.

use std::collections::BTreeMap;

use askama::Template;
use serde::Serialize;
use serde_json::Value;
use stiffarm_gap::Measurements;
use stiffarm_gap::gap::Statistics;
use stiffarm_gap::identify::measured::{Answer, Parameter};
use stiffarm_kernels::generic::Arm;

use super::corrections::{corrected, curve, shares};
use super::embedded::within_script;
use super::experiment::{Drawn, Experiment, drawn_of};
use super::forest::{Forest, Multiple, forest};
use super::page::{SCRIPT, percent};
use super::rows::{Rows, rows};
use super::scene::{Scene, scene};
use super::shape::{Shape, Shaped, shape};
use super::table::{Table, number};
use super::waterfall::{Step, Waterfall, waterfall};
use super::words::Unit;

/// How every identification is made.
const METHOD: &str = "\
Every row is compared with the robot file’s arm at static equilibrium under the row’s load and the \
links’ weight, on the loaded geometry. The compliances are found by Gauss and Newton’s steps, \
weighted by the noise; a column that the rows leave without a trace, or that is a combination of \
others, is held at the file’s value. Intervals are those of least squares with Student’s t. The gap \
after is that of folds of poses that the fit has not seen.";

/// A spring as it is said.
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

/// What a page of an identification is made of.
pub struct Identified<'a> {
    /// What was identified from.
    pub data: &'a Measurements,
    /// The arm of the robot file.
    pub arm: &'a Arm,
    /// What was found.
    pub answer: &'a Answer,
    /// What to do about it.
    pub sentence: String,
    /// All that was looked for, in the order of the answer.
    pub said: Vec<Said>,
    /// What is hidden or weak, and what would show it.
    pub advice: Vec<String>,
    /// Names and values of what it was given.
    pub facts: Vec<(&'static str, String)>,
    /// In what translations and rotations are shown.
    pub units: [Unit; 2],
    /// The whole result.
    pub json: Value,
    /// Of the program.
    pub version: &'static str,
}

#[derive(Template)]
#[template(path = "identified.html")]
struct Page<'a> {
    version: &'a str,
    robot: &'a str,
    file: &'a str,
    rows: usize,
    poses: usize,
    sentence: &'a str,
    forest: Forest,
    lines: &'a [Said],
    advice: &'a [String],
    waterfall: Waterfall,
    places: Vec<Bar>,
    poses_alone: bool,
    method: &'static str,
    facts: &'a [(&'static str, String)],
    style: &'static str,
    script: &'static str,
    data: String,
    /// Which rows are drawn, where these are not all.
    drawn: String,
}

/// A place with its share, as text and for the bar.
struct Bar {
    name: String,
    share: String,
    width: String,
}

#[derive(Serialize)]
struct Embedded<'a> {
    rows: Rows,
    scene: Scene,
    shapes: Vec<Shape>,
    tables: BTreeMap<&'static str, Table>,
    identified: &'a Value,
}

impl Identified<'_> {
    /// The page.
    ///
    /// # Errors
    /// [`askama::Error`] if the template cannot be filled.
    pub fn html(&self) -> Result<String, askama::Error> {
        let mut experiment = self.experiment();
        experiment.shares = shares(&experiment, self.answer);
        let curves: Vec<Shaped<'_>> = corrected(self.answer).map(curve).collect();
        let tables = self.tables(&experiment);
        let waterfall = waterfall(self.steps(&experiment), experiment.main_unit());
        let bars = experiment.shares.iter().filter_map(|s| {
            let share = s.share?;
            let width = format!("{:.1}", (100.0 * share).clamp(0.0, 100.0));
            Some(Bar { name: s.place.clone(), share: percent(share), width })
        });
        let places = bars.collect();
        let drawn = Drawn::of(&experiment);
        let experiment = experiment.with(&drawn);
        let embedded = Embedded {
            rows: rows(&experiment),
            scene: scene(&experiment),
            shapes: curves.iter().filter_map(|curve| shape(&experiment, curve)).collect(),
            tables,
            identified: &self.json,
        };
        let page = Page {
            version: self.version,
            robot: &self.arm.name,
            file: &self.data.file,
            rows: self.data.rows.len(),
            poses: self.data.poses,
            sentence: &self.sentence,
            forest: forest(&self.multiples()),
            lines: &self.said,
            advice: &self.advice,
            waterfall,
            places,
            drawn: drawn_of(self.data.rows.len()),
            poses_alone: !self.data.kind.is_difference(),
            method: METHOD,
            facts: &self.facts,
            style: include_str!("style.css"),
            script: SCRIPT,
            data: within_script(&embedded).map_err(askama::Error::custom)?,
        };
        page.render()
    }

    fn experiment(&self) -> Experiment<'_> {
        let [before, after] = &self.answer.gap.rows;
        Experiment {
            data: self.data,
            arm: self.arm,
            placed: self.arm,
            markers: Vec::new(),
            gaps: [before, after],
            shares: Vec::new(),
            length: &self.units[0],
            angle: &self.units[1],
        }
    }

    fn multiples(&self) -> Vec<Multiple> {
        let parameters = self.answer.parameters.iter().zip(&self.said);
        let multiple = |(p, said): (&Parameter, &Said)| {
            let interval = p.interval().filter(|_| p.usable() && p.file > 0.0);
            interval.map(|interval| Multiple {
                label: said.place.clone(),
                value: p.value / p.file,
                interval: interval.map(|end| (end / p.file).max(f64::MIN_POSITIVE)),
                text: format!("{} ×", crate::plot::number(rounded(p.value / p.file))),
            })
        };
        parameters.filter_map(multiple).collect()
    }

    fn steps(&self, experiment: &Experiment<'_>) -> Vec<Step> {
        let (gap, noise) = (&self.answer.gap, &self.answer.noise);
        let size = |s: &Statistics| {
            if experiment.has_positions() { s.position_rms } else { s.rotation_rms }
        };
        let unit = experiment.main_unit();
        let plain = |label: &str, class, from: f64, to: f64, text: String| Step {
            label: label.to_owned(),
            class,
            from,
            to,
            interval: None,
            text,
        };
        let (before, after) = (size(&gap.before), size(&gap.held_out));
        let less = if before > 0.0 { 1.0 - after / before } else { 0.0 };
        let first = if experiment.has_positions() { 0 } else { 3 };
        let measured = self.data.kind.components()[first..first + 3].iter().filter(|m| **m).count();
        let one = if first == 0 { noise.position } else { noise.rotation };
        let floor = one.unwrap_or(0.0) * (measured as f64).sqrt();
        let whole = unit.with_unit(before);
        let removed = format!("{} less", percent(less));
        let of = match noise.from {
            "option" => "noise, as given",
            "repeats" => "noise, from repeats",
            _ => "noise, from what is left",
        };
        vec![
            plain("as the robot file is", "whole", 0.0, before, whole),
            plain("springs found", "removed", after.min(before), after.max(before), removed),
            plain("left, held out", "left", 0.0, after, unit.with_unit(after)),
            plain(of, "noise", 0.0, floor, unit.with_unit(floor)),
        ]
    }

    fn tables(&self, experiment: &Experiment<'_>) -> BTreeMap<&'static str, Table> {
        let mut parameters = Table::new(&["place", "value", "low", "high", "robot_file", "held"]);
        for p in &self.answer.parameters {
            let mut row: Vec<Value> = vec![p.unknown.to_string().into()];
            let ends = p.interval().map_or([Value::Null, Value::Null], |ends| ends.map(number));
            row.push(number(p.value));
            row.extend(ends);
            row.push(number(p.file));
            row.push((!p.usable()).into());
            parameters.rows.push(row);
        }
        let heads = ["step", "position_rms[m]", "position_max[m]", "rotation_rms[rad]"];
        let mut gap = Table::new(&heads);
        let (before, held_out) = (&self.answer.gap.before, &self.answer.gap.held_out);
        for (name, s) in [("before", before), ("held_out", held_out)] {
            let mut row = vec![Value::from(name)];
            row.extend([s.position_rms, s.position_max, s.rotation_rms].map(number));
            gap.rows.push(row);
        }
        let mut places = Table::new(&["place", "share"]);
        for share in &experiment.shares {
            let part = share.share.map_or(Value::Null, number);
            places.rows.push(vec![share.place.as_str().into(), part]);
        }
        BTreeMap::from([("parameters", parameters), ("gap", gap), ("places", places)])
    }
}

/// To three digits.
fn rounded(x: f64) -> f64 {
    format!("{x:.2e}").parse().unwrap_or(x)
}
