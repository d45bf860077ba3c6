//! How large the error is before and after, beside the noise, and against a tolerance or other models.

use stiffarm_gap::diagnose::{Finding, Rival};
use stiffarm_gap::gap::Statistics;
use stiffarm_gap::measurement::Kind;
use stiffarm_gap::shrink::Shrink;

use super::Campaign;
use crate::figure::Step;
use crate::findings;
use crate::report::Errors;
use crate::text::{counted, minus};
use crate::words::{capital, less, named, noise_from, percent};
use crate::{Block, Cell, Row, Table, Unit};

/// What stands beside a name in the table: position rms, 95 % and largest, rotation rms.
type Sizes = [Option<f64>; 4];

impl Campaign<'_> {
    /// The error before and after, and the noise.
    pub(super) fn errors(&self) -> Errors {
        Errors {
            heading: capital(self.error()),
            table: self.sizes(),
            steps: self.steps(),
            unit: self.main(),
            caption: "Each bar is what a finding removes, in order of addition; the line across its end is the 95 % \
                      interval of what remains, by resampling poses. All on held-out poses.",
        }
    }

    /// Of what a position's error is the size.
    fn measured(&self) -> String {
        let data = self.data.kind;
        let names: Vec<&str> = (data.names().iter().zip(data.components()).take(3))
            .filter_map(|(name, is)| is.then_some(*name))
            .collect();
        match (data, names.as_slice()) {
            (Kind::Distance, _) => "error of the distance".to_owned(),
            (Kind::Bench { lengths: 1, .. }, _) => "error of the reading".to_owned(),
            (Kind::Bench { .. }, _) => "distance from the point".to_owned(),
            (_, [_, _, _]) => "3-D distance".to_owned(),
            (_, [one]) => format!("along {one}"),
            (_, names) => format!("distance in {}", names.join(" and ")),
        }
    }

    fn sizes(&self) -> Table {
        let (gap, shown, turned) = (&self.found.gap, self.length(), self.angle());
        let (position, rotation) =
            (self.units().positions, self.data.kind.components()[3..].contains(&true));
        let mut heads = vec![String::new()];
        if position {
            let unit = if shown.name == "mil" { "mil (0.001 in)" } else { shown.name };
            heads.push(format!("rms {unit}"));
            heads.extend(["95 %", "max"].map(str::to_owned));
        }
        if rotation {
            let what = if self.units().pixels.is_some() { "" } else { "rotation " };
            heads.push(format!("{what}rms {}", turned.name));
        }
        heads.extend(position.then(|| self.measured()));
        let [whole, _] = self.rms();
        let mut rows = Vec::new();
        let mut add = |name: &str, sizes: Sizes| {
            let cell = |unit: Unit<'_>, size: Option<f64>| {
                Cell::number(size.map_or_else(String::new, |x| unit.number(x)))
            };
            let mut row: Row = vec![name.into()];
            if position {
                row.extend(sizes[..3].iter().map(|size| cell(shown, *size)));
            }
            row.extend(rotation.then(|| cell(turned, sizes[3])));
            let size = if position { sizes[0] } else { sizes[3] };
            let part = size.filter(|_| whole > 0.0).map_or(0.0, |size| size / whole);
            row.push(Cell::Bar(part));
            rows.push(row);
        };
        let all = |s: &Statistics| {
            [s.position_rms, s.position_p95, s.position_max, s.rotation_rms].map(Some)
        };
        add(self.found.before_is(), all(&gap.before));
        if !self.found.findings.is_empty() {
            let one = self.found.findings.len() == 1;
            let with = if one { "with the finding" } else { "with the findings" };
            add(&format!("{with}, held out"), all(&gap.after));
            add(&format!("{with}, on the fitted rows"), all(&gap.fitted));
        }
        if let Some(nested) = &gap.nested {
            add("search repeated without each fold", all(nested));
        }
        if let Some(in_time) = &gap.nested_in_time {
            add("search repeated without each fifth in time", all(in_time));
        }
        let noise = &gap.noise;
        let [own, turn] = [noise.position_rms, noise.rotation_rms].map(Some);
        let from = |source: &str| format!("noise, {}", noise_from(source));
        match (noise.position_from.as_deref(), noise.rotation_from.as_deref()) {
            (Some(position), Some(rotation)) if position != rotation => {
                add(&from(position), [own, None, None, None]);
                add(&from(rotation), [None, None, None, turn]);
            }
            _ => add(&from(&noise.from), [own, None, None, turn]),
        }
        let visits = [noise.visits_position_rms, None, None, noise.visits_rotation_rms];
        if visits.iter().any(Option::is_some) {
            add("of which the arm's repeatability", visits);
        }
        Table { heads, rows, caption: String::new() }
    }

    /// From the whole error, finding by finding, to the noise; small ones are one step.
    fn steps(&self) -> Vec<Step> {
        let (gap, unit, [before, after]) = (&self.found.gap, self.main(), self.rms());
        let plain =
            |label: &str, class, size: f64| Step::of(label, class, size, unit.with_unit(size));
        let taken = |finding: &Finding| {
            let held = &finding.held_out;
            let less = held.shrink().map_or_else(String::new, |s| format!(", {}", less(s)));
            Step {
                label: named(&finding.effect, &finding.place),
                class: "removed",
                from: held.after().min(held.before()),
                to: held.after().max(held.before()),
                interval: held.shrink().map(Shrink::after_ci95),
                text: format!("→ {}{less}", unit.with_unit(held.after())),
            }
        };
        let mut steps = vec![plain(self.found.before_is(), "whole", before)];
        steps.extend(findings::steps(&self.found.findings, taken, |left| unit.with_unit(left)));
        if !self.found.findings.is_empty() {
            steps.push(plain("remains, held out", "left", after));
        }
        let nested = [("search repeated", &gap.nested), ("repeated in time", &gap.nested_in_time)];
        for (label, of) in nested {
            let size = of.as_ref().map(|gap| self.units().judged(gap));
            steps.extend(size.map(|size| plain(label, "left", size)));
        }
        steps.push(plain("noise", "noise", self.noise()));
        steps
    }

    /// Whether the corrected arm is accepted; `None` where nobody asked.
    pub(super) fn acceptance(&self) -> Option<Block> {
        let judged = self.accepted?;
        let (reached, tolerance) = (judged.position_p95, judged.tolerance);
        let shown = self.units().length([reached, tolerance]);
        let of = match judged.of.as_str() {
            "held out" => "the held-out rows".to_owned(),
            file => format!("the rows of {file}"),
        };
        let verdict = if judged.accepted { "Accepted" } else { "Not accepted" };
        let text = format!(
            "{verdict}: with the findings 95 % of {of} have a position error of at most {}; the tolerance is {}.",
            shown.with_unit(reached),
            shown.with_unit(tolerance)
        );
        Some(Block::Verdict(Some(judged.accepted), text))
    }

    /// Against the predictions of other models; `None` where nobody asked.
    pub(super) fn rivals(&self) -> Option<Block> {
        let rivals = self.found.rivals.as_ref().filter(|rivals| !rivals.is_empty())?;
        let shown = self.main();
        let square =
            |si: f64| minus(format!("{:.*}", shown.decimals.unwrap_or(3), si / shown.si.powi(2)));
        let row = |r: &Rival| -> Row {
            let [low, high] = r.ci95.map(square);
            let verdict = match (r.significant, r.mean_square_gain > 0.0) {
                (true, true) => Cell::Judged(true, "significantly better".to_owned()),
                (true, false) => Cell::Judged(false, "significantly worse".to_owned()),
                (false, true) => "not significantly better".into(),
                (false, false) => "not better".into(),
            };
            vec![
                r.name.as_str().into(),
                Cell::number(shown.number(r.rms)),
                Cell::number(shown.number(r.held_out_rms)),
                format!("{} [{low} to {high}]", square(r.mean_square_gain)).into(),
                verdict,
            ]
        };
        let unit = shown.name;
        let heads = [
            String::new(),
            format!("its rms {unit}"),
            "ours, held out".to_owned(),
            format!("gain in mean square, {unit}²"),
            format!("over {} ours is", counted(self.data.poses, "pose")),
        ];
        let rows = rivals.iter().map(row).collect();
        let table = Table { heads: heads.to_vec(), rows, caption: String::new() };
        Some(Block::section("Other models", vec![Block::Table(table)]))
    }

    /// Parts of the error that go with load, direction, time and so on.
    pub(super) fn parts(&self) -> String {
        let shown = self.found.parts.iter().filter(|p| (0.01..0.995).contains(&p.share));
        let parts: Vec<String> =
            shown.map(|p| format!("{} {}", p.part, percent(p.share))).collect();
        parts.join(", ")
    }
}
