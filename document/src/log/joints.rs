//! What a page's scripts draw of each joint: a segment of time, what each finding contributes, friction, residuals.

use serde::Serialize;
use serde_json::Value;
use stiffarm_gap::log::model::JointRows;
use stiffarm_gap::log::{Domain, LogDiagnosis};
use stiffarm_kernels::Motion;

use super::{Fitted, shown};
use crate::figure::residual;
use crate::words::named;

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

/// What the scripts read.
#[derive(Serialize)]
pub struct Drawing {
    /// What is explained, as axes name it.
    what: &'static str,
    joints: Vec<Joint>,
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

impl Drawing {
    pub fn of(found: &LogDiagnosis, Fitted { explained, arm }: &Fitted<'_>) -> Drawing {
        let drawn = Drawn { found, explained, arm };
        Drawing {
            what: if found.rows == Domain::Torque { "torque" } else { "error" },
            joints: (0..explained.joints.len()).map(|joint| drawn.joint(joint)).collect(),
        }
    }
}

struct Drawn<'a> {
    found: &'a LogDiagnosis,
    explained: &'a stiffarm_gap::log::model::Explained,
    arm: &'a stiffarm_kernels::generic::Arm,
}

impl Drawn<'_> {
    fn joint(&self, index: usize) -> Joint {
        let (rows, times) = (&self.explained.joints[index], &self.explained.t);
        let gap = &self.found.gap[index];
        let (unit, scale) = shown(&gap.unit);
        let turns = self.arm.joints[index].motion == Motion::Revolute;
        let (angle, speed, q) =
            if turns { ("°", "rad/s", 180.0 / core::f64::consts::PI) } else { ("mm", "m/s", 1e3) };
        let stretch = self.stretch();
        let model = |k: usize| rows.target[k] - rows.left(k);
        let drawn = |of: &dyn Fn(usize) -> f64| -> Vec<Value> {
            stretch.clone().map(|k| residual(of(k))).collect()
        };
        let part = |(k, part): &(usize, Vec<f64>)| {
            let name = self
                .found
                .findings
                .get(*k)
                .map_or_else(String::new, |f| named(&f.effect, &f.place));
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
}
