//! The page of a joint log: what drives the joints, what each effect takes of it, and what is left.

use std::collections::BTreeMap;

use askama::Template;
use serde::Serialize;
use serde_json::Value;
use stiffarm_gap::log::model::{Explained, JointRows};
use stiffarm_gap::log::{Domain, LogDiagnosis};
use stiffarm_gap::report::Finding;
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::embedded::within_script;
use super::page::percent;
use super::table::{Table, number, residual};
use super::waterfall::{Step, Waterfall, waterfall};
use super::words::Unit;
use crate::screen::{less, log as said};
use crate::terminal::text::short;

/// The scripts, one matter each.
const SCRIPT: &str = concat!(
    include_str!("script/data.js"),
    include_str!("script/theme.js"),
    include_str!("script/plot.js"),
    include_str!("script/logged.js"),
);

/// Rows that are drawn against time: a stretch of the log, every row of it.
const STRETCH: usize = 900;

/// Rows that are drawn as points, over the whole log.
const POINTS: usize = 1200;

/// Points of a friction curve's line.
const BINS: usize = 48;

/// What changes with the speed of a joint alone, or nearly.
const FRICTION: [&str; 6] = [
    "coulomb_friction",
    "viscous_friction",
    "friction_curve",
    "stribeck",
    "asymmetric_friction",
    "presliding",
];

/// How every log is diagnosed.
const METHOD: &str = "\
Samples come to even steps and, with everything that is computed of them, through one low-pass without \
a phase. Of torques the rigid links are fitted along as base parameters; effects are added one after the \
other, each judged on blocks of time that its fit has not seen, against what chance does by the signs of \
whole blocks. Intervals take each block as one independent number. What is drawn here is the model that is \
fitted to all of the log.";

/// What a page of a log is made of.
pub struct Logged<'a> {
    /// The diagnosis.
    pub found: &'a LogDiagnosis,
    /// The log's rows, term by term.
    pub explained: &'a Explained,
    /// The arm of the robot file.
    pub arm: &'a Arm,
    /// What is left of another log, in a sentence.
    pub check: Option<String>,
}

#[derive(Template)]
#[template(path = "logged.html")]
struct Page<'a> {
    version: &'a str,
    robot: &'a str,
    file: String,
    facts: String,
    sentence: String,
    check: Option<&'a str>,
    torque: bool,
    gaps: Vec<[String; 5]>,
    /// Of each joint what a search leaves that has not seen the time; empty where none was run.
    nested: Vec<String>,
    waterfall: Waterfall,
    findings: Vec<Found>,
    /// What the commanded motion as instrument changes.
    by_command: Option<String>,
    unexplained: Vec<String>,
    hidden: Vec<String>,
    remarks: &'a [String],
    method: &'static str,
    settings: Vec<(&'static str, String)>,
    style: &'static str,
    script: &'static str,
    data: String,
}

/// A finding.
struct Found {
    name: String,
    numbers: Vec<String>,
    takes: String,
    chance: String,
    same: Vec<String>,
    advice: Option<String>,
}

/// What the scripts read.
#[derive(Serialize)]
struct Embedded<'a> {
    /// What is explained, as axes name it.
    what: &'static str,
    joints: Vec<Joint>,
    tables: BTreeMap<&'static str, Table>,
    diagnosis: &'a LogDiagnosis,
}

/// What is drawn of one joint.
#[derive(Serialize)]
struct Joint {
    name: String,
    unit: String,
    angle: &'static str,
    speed: &'static str,
    /// A stretch of time: t, what was to be explained, the rigid links, the whole model.
    stretch: [Vec<Value>; 4],
    /// What each finding does in that stretch.
    parts: Vec<(String, Vec<Value>)>,
    /// Points: t, q, q̇, what was to be explained, before, after.
    points: Vec<[Value; 6]>,
    /// Speed and friction; the line of the model. Empty where none was found.
    friction: [Vec<[Value; 2]>; 2],
}

impl Logged<'_> {
    /// The page.
    ///
    /// # Errors
    /// [`askama::Error`] if the template cannot be filled.
    pub fn html(&self) -> Result<String, askama::Error> {
        let found = self.found;
        let torque = found.rows == Domain::Torque;
        let embedded = Embedded {
            what: if torque { "torque" } else { "error" },
            joints: (0..self.explained.joints.len()).map(|joint| self.joint(joint)).collect(),
            tables: self.tables(),
            diagnosis: found,
        };
        let unit = Unit { name: "% of the joints’ own, mean", si: 0.01, decimals: 1 };
        let page = Page {
            version: &found.stiffarm,
            robot: &found.robot,
            file: found.files.join(", "),
            facts: said::facts(found),
            sentence: said::sentence(found),
            check: self.check.as_deref(),
            torque,
            gaps: said::gaps(found),
            nested: said::nested(found),
            waterfall: waterfall(self.steps(), &unit),
            findings: found.findings.iter().map(finding).collect(),
            by_command: said::by_command(found),
            unexplained: said::unexplained(found),
            hidden: said::hidden(found),
            remarks: &found.remarks,
            method: METHOD,
            settings: self.settings(),
            style: include_str!("style.css"),
            script: SCRIPT,
            data: within_script(&embedded).map_err(askama::Error::custom)?,
        };
        page.render()
    }

    fn steps(&self) -> Vec<Step> {
        let [before, after] = said::left(&self.found.gap);
        let part = |x: f64| format!("{:.1} %", 100.0 * x);
        let step = |label: String, class, from, to, text| Step {
            label,
            class,
            from,
            to,
            interval: None,
            text,
        };
        let first =
            if self.found.rows == Domain::Torque { "rigid links alone" } else { "as logged" };
        let mut steps = vec![step(first.to_owned(), "whole", 0.0, before, part(before))];
        steps.extend(self.found.findings.iter().map(|f| {
            let (from, to) = (f.held_out.after().min(f.held_out.before()), f.held_out.before());
            step(name(f), "removed", from, to, format!("to {}", part(f.held_out.after())))
        }));
        let mut left = step("left, held out".to_owned(), "left", 0.0, after, part(after));
        if !self.found.findings.is_empty() {
            left.interval = Some(self.found.shrink.after_ci95());
            left.text = format!("{}, {}", left.text, less(&self.found.shrink));
        }
        steps.push(left);
        steps
    }

    fn joint(&self, index: usize) -> Joint {
        let (rows, times) = (&self.explained.joints[index], &self.explained.t);
        let gap = &self.found.gap[index];
        let (unit, scale) = said::shown(&gap.unit);
        let turns = self.arm.joints[index].motion == Motion::Revolute;
        let (angle, speed, q) =
            if turns { ("°", "rad/s", 180.0 / core::f64::consts::PI) } else { ("mm", "m/s", 1e3) };
        let stretch = self.stretch();
        let model = |k: usize| rows.target[k] - rows.left(k);
        let drawn = |of: &dyn Fn(usize) -> f64| -> Vec<Value> {
            stretch.clone().map(|k| residual(of(k))).collect()
        };
        let part = |(k, part): &(usize, Vec<f64>)| {
            let name = self.found.findings.get(*k).map_or_else(String::new, name);
            (name, drawn(&|row| scale * part[row]))
        };
        let counted: Vec<usize> = (0..times.len()).filter(|k| rows.counts[*k]).collect();
        let every = counted.len().div_ceil(POINTS).max(1);
        let points = counted.iter().step_by(every).map(|k| {
            let values = [
                times[*k],
                q * rows.q[*k],
                rows.qd[*k],
                scale * rows.target[*k],
                scale * rows.without(*k),
                scale * rows.left(*k),
            ];
            values.map(residual)
        });
        Joint {
            name: format!("joint {}", index + 1),
            unit: unit.to_owned(),
            angle,
            speed,
            stretch: [
                drawn(&|k| times[k]),
                drawn(&|k| scale * rows.target[k]),
                drawn(&|k| scale * rows.rigid[k]),
                drawn(&|k| scale * model(k)),
            ],
            parts: rows.parts.iter().map(part).collect(),
            points: points.collect(),
            friction: self.friction(rows, &counted, every),
        }
    }

    /// Rows behind one another, of one run.
    fn stretch(&self) -> core::ops::Range<usize> {
        let run = &self.explained.run;
        let first = run.first().copied().unwrap_or(0);
        let own = run.iter().take_while(|r| **r == first).count();
        let settled = self.explained.joints.iter().map(|j| j.counts.iter().position(|c| *c));
        let from = settled.flatten().min().unwrap_or(0);
        from..(from + STRETCH).min(own).max(from)
    }

    /// Friction against speed: what the friction's terms do and what is left, and the terms alone.
    fn friction(&self, rows: &JointRows, counted: &[usize], every: usize) -> [Vec<[Value; 2]>; 2] {
        let is_friction =
            |k: usize| self.found.findings.get(k).is_some_and(|f| FRICTION.contains(&&*f.effect));
        let terms: Vec<&Vec<f64>> =
            rows.parts.iter().filter(|(k, _)| is_friction(*k)).map(|(_, part)| part).collect();
        if terms.is_empty() {
            return [Vec::new(), Vec::new()];
        }
        let does = |k: usize| terms.iter().map(|part| part[k]).sum::<f64>();
        let point = |k: &usize| [rows.qd[*k], does(*k) + rows.left(*k)].map(residual);
        let points = counted.iter().step_by(every).map(point).collect();
        // The line is the mean of what the terms do at about the same speed, as many rows each.
        let mut by_speed = counted.to_vec();
        by_speed.sort_by(|a, b| rows.qd[*a].total_cmp(&rows.qd[*b]));
        let mean = |bin: &[usize], of: &dyn Fn(usize) -> f64| {
            bin.iter().map(|k| of(*k)).sum::<f64>() / bin.len() as f64
        };
        let at = |bin: &[usize]| [mean(bin, &|k| rows.qd[k]), mean(bin, &does)].map(residual);
        let line = by_speed.chunks(by_speed.len().div_ceil(BINS).max(1)).map(at).collect();
        [points, line]
    }

    fn settings(&self) -> Vec<(&'static str, String)> {
        let (found, evidence) = (self.found, &self.found.evidence);
        let given = if found.filter.band_given { "as given" } else { "found in the log" };
        let longest = evidence.correlation_time.iter().copied().fold(0.0, f64::max);
        let mut settings = vec![
            ("low-pass", format!("{} Hz, {given}", short(found.filter.band))),
            ("step of the log", format!("{} s", short(found.filter.period))),
            (
                "independent numbers",
                format!("about {:.0} of {} rows", evidence.effective, evidence.rows),
            ),
            ("correlation time", format!("at most {} s", short(longest))),
            ("blocks", format!("{} of {} s", evidence.blocks, short(evidence.block_length))),
        ];
        if found.damaged > 0 {
            settings.push(("damaged rows", format!("{} left out", found.damaged)));
        }
        settings
    }

    fn tables(&self) -> BTreeMap<&'static str, Table> {
        let heads = ["joint", "unit", "size", "before", "after", "searched anew"];
        let told = if self.found.gap.iter().all(|g| g.nested.is_some()) { 6 } else { 5 };
        let mut gap = Table::new(&heads[..told]);
        for (k, g) in self.found.gap.iter().enumerate() {
            let mut row = vec![Value::from(k + 1), (*g.unit).into()];
            row.extend([g.size, g.before, g.after].into_iter().chain(g.nested).map(number));
            gap.rows.push(row);
        }
        let heads = ["effect", "place", "number", "value", "low", "high", "unit", "p"];
        let mut findings = Table::new(&heads);
        for f in &self.found.findings {
            for p in &f.parameters {
                let mut row: Vec<Value> =
                    vec![(*f.effect).into(), f.place.as_str().into(), (*p.name).into()];
                row.extend([p.value, p.ci95[0], p.ci95[1]].map(number));
                row.extend([(*p.unit).into(), number(f.p_value)]);
                findings.rows.push(row);
            }
        }
        BTreeMap::from([("gap", gap), ("findings", findings)])
    }
}

/// `viscous friction at joint 2`.
fn name(finding: &Finding) -> String {
    format!("{} at {}", finding.effect.replace('_', " "), finding.place)
}

fn finding(f: &Finding) -> Found {
    let rival = |a: &stiffarm_gap::report::Alternative| {
        let more = percent(a.left.size() - 1.0);
        format!("{} at {}, which leaves {more} more", a.effect.replace('_', " "), a.place)
    };
    Found {
        name: name(f),
        numbers: f.parameters.iter().map(said::number).collect(),
        takes: format!("{:.1} → {:.1} %", 100.0 * f.held_out.before(), 100.0 * f.held_out.after()),
        chance: format!("p = {}", short(f.p_value)),
        same: f.alternatives.iter().map(rival).collect(),
        advice: f.advice().map(str::to_owned),
    }
}
