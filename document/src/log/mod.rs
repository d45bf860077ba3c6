//! The document of a joint log.

mod joints;
mod notes;

use serde::Serialize;
use stiffarm_gap::log::effects::CATALOGUE;
use stiffarm_gap::log::model::Explained;
use stiffarm_gap::log::report::JointGap;
use stiffarm_gap::log::{Domain, LogDiagnosis};
use stiffarm_gap::report::{Alternative, Finding, Parameter};
use stiffarm_kernels::generic::Arm;

use super::figure::{self, LOG, Step};
use super::findings::{steps, unnamed, weighed};
use super::report::{Errors, Method, Report, explained};
use super::words::{at, capital, gathered, joined, less, named, percent, words};
use super::{Block, Cell, Document, Embedded, Row, Table, Unit};
use crate::beside::LogCheck;
use crate::text::{counted, decimals, fixed, minus, short};

/// Effects that the sentence names.
const NAMED: usize = 4;

/// How every log is diagnosed.
const METHOD: &str = "\
Samples are resampled to even steps and go, with everything that is computed from them, through one zero-phase \
low-pass. Of torques the base parameters of the rigid links are co-estimated. Effects are added one by one, each \
judged on held-out blocks of time, against a sign-flip test of whole blocks. Intervals take each block as one \
independent number. The pictures show the model that is fitted to all of the log.";

/// What the document of a log is made of.
pub struct Log<'a> {
    /// What was found.
    pub found: &'a LogDiagnosis,
    /// The prediction of another log.
    pub check: Option<&'a LogCheck>,
    /// What only a page shows.
    pub fitted: Option<Fitted<'a>>,
}

/// The model that is fitted to all of the log.
#[derive(Clone, Copy)]
pub struct Fitted<'a> {
    /// The log's rows, term by term.
    pub explained: &'a Explained,
    /// The arm of the robot file.
    pub arm: &'a Arm,
}

impl Log<'_> {
    /// What a terminal and a page have.
    pub fn document(&self) -> Document {
        let found = self.found;
        let check = self.check.map(|check| Block::Verdict(None, self.checked(check)));
        let joints = || Block::section("Each joint", vec![figure::joints(self.is_torque())]);
        let method = || Method { text: METHOD, facts: self.settings(), lists: &[] };
        let report = Report {
            robot: found.robot.clone(),
            about: "what its drives do",
            facts: format!("{}: {}", found.files.join(", "), self.facts()),
            sentence: self.sentence(),
            first: check.into_iter().collect(),
            error: self.errors(),
            rest: self.findings().into_iter().chain(self.notes()).collect(),
            page: self.fitted.map(|_| (vec![joints()], method())),
        };
        report.document()
    }

    /// What its page embeds; `whole` is the diagnosis as it is written.
    pub fn embedded(
        &self,
        fitted: &Fitted<'_>,
        whole: &impl Serialize,
    ) -> Result<Embedded, crate::PageError> {
        Embedded::new(joints::Drawing::of(self.found, fitted), whole, LOG)
    }

    fn is_torque(&self) -> bool {
        self.found.rows == Domain::Torque
    }

    /// Of what a part is given.
    fn whole(&self) -> &'static str {
        match self.is_torque() {
            true => "of the torque's standard deviation",
            false => "of the logged error",
        }
    }

    fn error(&self) -> &'static str {
        if self.is_torque() { "torque error" } else { "position error" }
    }

    /// What the rows are, how many, and how they are judged.
    fn facts(&self) -> String {
        let (found, evidence) = (self.found, &self.found.evidence);
        let rows = match (found.rows, found.torque_side) {
            (Domain::Torque, Some(side)) => {
                format!("torques, {}", format!("{side:?}").to_lowercase())
            }
            (Domain::Torque, None) => "torques".to_owned(),
            (Domain::Position, _) => "positions against commands".to_owned(),
        };
        let held = match &*evidence.held_out_by {
            "run" => format!("each of {} held out in turn", counted(evidence.folds, "run")),
            _ => format!("held out in {} folds of blocks", evidence.folds),
        };
        format!(
            "{rows}; {} in {}; below {} Hz; effective number of samples {:.0}, blocks of {} s, {held}",
            counted(found.samples, "sample"),
            counted(found.runs, "run"),
            short(found.filter.band),
            evidence.effective,
            short(evidence.block_length),
        )
    }

    /// What the model lacks, and what remains.
    fn sentence(&self) -> String {
        let found = self.found;
        let [before, after] = left(&found.gap).map(part);
        let (what, error) = (self.whole(), self.error());
        if found.findings.is_empty() {
            return format!(
                "Nothing is found: no effect that was tried reduces the rms {error}, {before} {what}, on held-out \
                 time."
            );
        }
        let mut text = format!(
            "The model {}; {} {} reduces the rms {error} from {before} to {after} {what}, mean over \
             the joints on held-out time: {}.",
            self.wrong(),
            if found.findings.iter().all(is_taken_back) { "correcting" } else { "modelling" },
            if found.findings.len() == 1 { "it" } else { "them" },
            less(&found.shrink)
        );
        if let Some(nested) = nested(&found.gap) {
            text.push_str(&format!(
                " With the search repeated without the held-out time, {} remains.",
                part(nested)
            ));
        }
        let open = found.findings.iter().filter(|f| !f.alternatives.is_empty()).count();
        if open > 0 {
            let findings = counted(open, "finding");
            text.push_str(&format!(" This log does not distinguish {findings} from others."));
        }
        text
    }

    /// `lacks Coulomb friction at joints 1 to 6 and has too much viscous friction at joint 2, beside 2 small effects`.
    fn wrong(&self) -> String {
        let [large, small] = weighed(&self.found.findings);
        let each = large.into_iter().map(|(_, f)| ((is_taken_back(f), &*f.effect), &*f.place));
        let mut kinds = gathered(each);
        let first = if kinds.len() > NAMED { NAMED - 1 } else { kinds.len() };
        let more: usize = kinds.drain(first..).map(|(_, places)| places.len()).sum();
        let [mut lacks, mut has] = [const { Vec::new() }; 2];
        for ((is_excess, effect), places) in kinds {
            let list = if is_excess { &mut has } else { &mut lacks };
            list.push(format!("{} at {}", words(effect), at(&places)));
        }
        let both = [("lacks", lacks), ("has too much", has)].into_iter();
        let both = both.filter(|(_, list)| !list.is_empty());
        let both: Vec<String> =
            both.map(|(verb, list)| format!("{verb} {}", joined(&list, " and "))).collect();
        let rest: Vec<String> = unnamed(more, small.len()).collect();
        let beside = if rest.is_empty() { "" } else { ", beside " };
        format!("{}{beside}{}", both.join(" and "), joined(&rest, " and "))
    }

    /// What remains of another log.
    fn checked(&self, check: &LogCheck) -> String {
        let [before, after] = left(&check.gap).map(part);
        format!(
            "On {} ({}) the same model, with nothing fitted, leaves an rms {} of {after} {}; without the findings {before}.",
            check.files.join(", "),
            counted(check.samples, "sample"),
            self.error(),
            self.whole(),
        )
    }

    /// The error of each joint, before and after.
    fn errors(&self) -> Errors {
        let found = self.found;
        let (size, before) = match found.rows {
            Domain::Torque => ("standard deviation", "rigid links alone"),
            Domain::Position => ("as logged", "before"),
        };
        let is_nested = found.gap.iter().all(|g| g.nested.is_some());
        let mut heads = vec!["", size, before, "with the findings"];
        heads.extend(is_nested.then_some("search repeated"));
        let row = |(joint, gap): (usize, &JointGap)| -> Row {
            let (name, factor) = shown(&gap.unit);
            let number = |x: f64| Cell::number(short(factor * x));
            let mut row: Row = vec![format!("joint {}", joint + 1).into()];
            row.push(Cell::number(format!("{} {name}", short(factor * gap.size))));
            row.extend([gap.before, gap.after].map(number));
            row.extend(gap.nested.map(number));
            row.push(Cell::number(part(gap.after / gap.size)));
            row.push(Cell::Bar(gap.after / gap.size.max(gap.before)));
            row
        };
        let table = Table {
            heads: heads.into_iter().map(str::to_owned).collect(),
            rows: found.gap.iter().enumerate().map(row).collect(),
            caption: String::new(),
        };
        Errors {
            heading: format!("{}, rms", capital(self.error())),
            table,
            steps: self.steps(),
            unit: Unit { name: "% of the joints’ own, mean", si: 0.01, decimals: Some(1) },
            caption: "In order of addition; mean over the joints of rms errors as parts of their own size, held out.",
        }
    }

    fn steps(&self) -> Vec<Step> {
        let found = self.found;
        let [before, after] = left(&found.gap);
        let first = if self.is_torque() { "rigid links alone" } else { "as logged" };
        let mut all = vec![Step::of(first, "whole", before, part(before))];
        let one = |f: &Finding| {
            let text = format!("→ {}", part(f.held_out.after()));
            Step {
                from: f.held_out.after().min(f.held_out.before()),
                ..Step::of(named(&f.effect, &f.place), "removed", f.held_out.before(), text)
            }
        };
        all.extend(steps(&found.findings, one, part));
        let mut last = Step::of("remains, held out", "left", after, part(after));
        if !found.findings.is_empty() {
            last.interval = Some(found.shrink.after_ci95());
            last.text = format!("{}, {}", last.text, less(&found.shrink));
        }
        all.push(last);
        all
    }

    fn findings(&self) -> Option<Block> {
        let found = self.found;
        let more = |a: &Alternative| format!("leaves {} more", percent(a.left.size() - 1.0));
        let [whole, _] = left(&found.gap);
        let one = |number, f: &Finding| super::Finding {
            error: format!(
                "{} → {}",
                fixed(100.0 * f.held_out.before(), 1),
                part(f.held_out.after())
            ),
            parameters: f.parameters.iter().map(parameter).collect(),
            ..super::Finding::of(number, f, whole, more)
        };
        let remark = format!("in order of addition; mean {} of the joints, held out", self.error());
        explained(&found.findings, remark, one, part, &["findings.parameters"])
    }

    fn settings(&self) -> Vec<(&'static str, String)> {
        let (found, evidence) = (self.found, &self.found.evidence);
        let given = if found.filter.band_given { "as given" } else { "estimated from the log" };
        let longest = evidence.correlation_time.iter().copied().fold(0.0, f64::max);
        let mut settings = vec![
            ("low-pass", format!("{} Hz, {given}", short(found.filter.band))),
            ("sampling period", format!("{} s", short(found.filter.period))),
            (
                "effective number of samples",
                format!("about {:.0} of {}", evidence.effective, evidence.rows),
            ),
            ("correlation time", format!("at most {} s", short(longest))),
            ("blocks", format!("{} of {} s", evidence.blocks, short(evidence.block_length))),
        ];
        if found.damaged > 0 {
            settings.push(("damaged samples", format!("{} left out", found.damaged)));
        }
        settings
    }
}

/// Mean of the joints' errors as parts of their sizes, before and after.
pub fn left(gap: &[JointGap]) -> [f64; 2] {
    // A joint that is left out has none.
    let own: Vec<&JointGap> = gap.iter().filter(|g| g.before > 0.0 || g.after > 0.0).collect();
    let mean = |of: fn(&JointGap) -> f64| {
        own.iter().map(|g| of(g) / g.size).sum::<f64>() / own.len().max(1) as f64
    };
    [mean(|g| g.before), mean(|g| g.after)]
}

/// The same of a search that has not seen the time; where it was run.
fn nested(gap: &[JointGap]) -> Option<f64> {
    let parts: Option<Vec<f64>> =
        gap.iter().map(|g| g.nested.map(|nested| nested / g.size)).collect();
    parts.map(|parts| parts.iter().sum::<f64>() / parts.len() as f64)
}

/// A part in per cent.
fn part(x: f64) -> String {
    format!("{} %", fixed(100.0 * x, 1))
}

/// In what people read position errors, and how many of it one is.
fn shown(unit: &str) -> (&str, f64) {
    match unit {
        "rad" => ("°", 180.0 / core::f64::consts::PI),
        "m" => ("mm", 1e3),
        other => (other, 1.0),
    }
}

/// `viscous 8.13 [8.01 to 8.25] N·m·s/rad`.
fn parameter(p: &Parameter) -> String {
    let half = 0.5 * (p.ci95[1] - p.ci95[0]);
    let digits = decimals(half, 2).min(decimals(p.value.abs(), 3).max(decimals(half, 1)));
    let shown = |x: f64| match (1e-4..1e5).contains(&p.value.abs()) {
        true => fixed(x, digits),
        false => minus(format!("{x:.2e}")),
    };
    let [low, high] = p.ci95.map(shown);
    format!("{} {} [{low} to {high}] {}", p.name, shown(p.value), p.unit)
}

/// Whether a finding takes back a part of what the robot file has: its amounts are negative, and no drive has less
/// than none of them.
fn is_taken_back(finding: &Finding) -> bool {
    let effect = CATALOGUE.iter().find(|effect| effect.identifier() == &*finding.effect);
    let is_amount = |name: &str| {
        effect.is_some_and(|e| e.parameters().iter().any(|p| p.key == name && p.least == 0.0))
    };
    let amounts = || finding.parameters.iter().filter(|p| is_amount(&p.name));
    amounts().next().is_some() && amounts().all(|p| p.value < 0.0)
}
