//! This campaign against a tolerance, and against the last one.

use stiffarm_gap::report::{Finding, Parameter, Word};

use super::{Screen, WIDTH, words};
use crate::diagnose::Reached;
use crate::terminal::text::{bad, bold, good, indented, wrapped};

impl Screen<'_> {
    /// Whether the corrected arm is accepted; nothing where nobody asked.
    pub(super) fn acceptance(&self) -> Option<(bool, String)> {
        let judged = self.accepted?;
        let (reached, tolerance) = (judged.position_p95, judged.tolerance);
        let shown = self.length(reached.min(tolerance), reached.max(tolerance));
        let of = match judged.of.as_str() {
            "held out" => "the rows, held out,".to_owned(),
            file => format!("the rows of {file}"),
        };
        let verdict = if judged.accepted { "Accepted" } else { "Not accepted" };
        let text = format!(
            "{verdict}: with the findings 95 % of {of} lie within {}; asked for were {}.",
            shown.with_unit(reached),
            shown.with_unit(tolerance)
        );
        Some((judged.accepted, text))
    }

    pub(super) fn verdict_on_tolerance(&self) -> String {
        let told = self.acceptance().map(|(accepted, text)| {
            let text = wrapped(&text, WIDTH, 0);
            if accepted { good(text) } else { bad(text) }
        });
        told.map_or_else(String::new, |text| format!("{text}\n"))
    }

    /// What is different from the last campaign, a sentence each; nothing where nobody asked.
    pub(super) fn changes(&self) -> Vec<String> {
        let Some(compared) = self.compared else { return Vec::new() };
        let mut lines = Vec::new();
        if compared.same_data == Some(true) {
            lines.push("both diagnoses are of the same measurements".to_owned());
        }
        if compared.same_robot == Some(false) {
            lines.push("they begin from different robot files".to_owned());
        }
        lines.push(self.reached(&compared.last, &compared.now));
        let names = |each: &[(Word, String)]| -> Vec<String> {
            each.iter().map(|(effect, place)| format!("{} at {place}", words(effect))).collect()
        };
        lines.extend(names(&compared.came).into_iter().map(|name| format!("new: {name}")));
        for ((effect, place), name) in compared.went.iter().zip(names(&compared.went)) {
            let hidden = &self.found.cannot_see;
            let hidden = hidden.iter().find(|c| c.effect == *effect && c.place == *place);
            let why = hidden.map_or_else(String::new, |c| {
                format!(" (this data could not have shown it: {})", c.because())
            });
            lines.push(format!("no longer found: {name}{why}"));
        }
        for number in &compared.numbers {
            let of = |f: &&Finding| f.effect == number.effect && f.place == number.place;
            let Some(finding) = self.found.findings.iter().find(of) else { continue };
            let named = |p: &&Parameter| p.name == number.name;
            let Some(now) = finding.parameters.iter().find(named) else { continue };
            let size = self.size(finding, now);
            let one = |k: usize| {
                let [low, high] = number.ci95[k].map(|x| size.number(x));
                format!("{} [{low} to {high}]", size.number(number.values[k]))
            };
            let verdict = if number.changed { "changed" } else { "not told apart" };
            lines.push(format!(
                "{} at {}: {} {} → {} {}, {verdict}",
                words(&number.effect),
                number.place,
                number.name,
                one(0),
                one(1),
                size.name
            ));
        }
        lines
    }

    fn reached(&self, last: &Reached, now: &Reached) -> String {
        let (least, most) = (last.after.min(now.after), last.before.max(now.before));
        let shown = match self.measures(0..3) {
            true => self.length(least, most),
            false => self.angle(least, most),
        };
        let one = |reached: &Reached| {
            let [low, high] = reached.interval().map(|x| shown.number(x));
            format!("{} [{low} to {high}]", shown.number(reached.after))
        };
        format!(
            "the gap {} → {} {unit}; with the findings {} → {} {unit}",
            shown.number(last.before),
            shown.number(now.before),
            one(last),
            one(now),
            unit = shown.name
        )
    }

    pub(super) fn campaigns(&self) -> String {
        let Some(compared) = self.compared else { return String::new() };
        let lines: Vec<String> = self
            .changes()
            .iter()
            .map(|line| wrapped(line, WIDTH - 2, 2).trim_end().to_owned())
            .collect();
        format!(
            "\n{}  since {}, then → now\n{}\n",
            bold("Changed"),
            compared.file,
            indented(&lines.join("\n"), 2)
        )
    }
}
